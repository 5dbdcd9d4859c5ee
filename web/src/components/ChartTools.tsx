// A chart's buttons: zoom without a mouse, and its picture and numbers as files.
import { useRef } from "react";
import { t } from "../i18n";
import { Download, Minus, Plus, Whole } from "./icons";

export interface ChartToolsProps {
  title: string;
  zoomed: boolean;
  /** By this factor; null shows all. */
  onZoom: (factor: number | null) => void;
  save: Record<"png" | "svg" | "csv", () => void>;
}

const FORMS = ["png", "svg", "csv"] as const;
const NAMES = { png: "PNG", svg: "SVG", csv: "CSV" };

export function ChartTools({ title, zoomed, onZoom, save }: ChartToolsProps) {
  const menu = useRef<HTMLDetailsElement>(null);
  const close = () => {
    if (menu.current) menu.current.open = false;
  };
  return (
    <div className="chart-tools">
      {zoomed && (
        <button
          type="button"
          className="icon-button"
          aria-label={t("chart.whole", { title })}
          data-testid="zoom-reset"
          onClick={() => onZoom(null)}
        >
          <Whole />
        </button>
      )}
      <button
        type="button"
        className="icon-button"
        aria-label={t("chart.farther", { title })}
        disabled={!zoomed}
        onClick={() => onZoom(2)}
      >
        <Minus />
      </button>
      <button
        type="button"
        className="icon-button"
        aria-label={t("chart.nearer", { title })}
        data-testid="zoom-in"
        onClick={() => onZoom(0.5)}
      >
        <Plus />
      </button>
      <details
        className="menu"
        ref={menu}
        onKeyDown={(event) => {
          if (event.key !== "Escape") return;
          close();
          menu.current?.querySelector("summary")?.focus();
        }}
        onBlur={(event) => {
          if (!event.currentTarget.contains(event.relatedTarget)) close();
        }}
      >
        <summary className="icon-button" aria-label={t("chart.download", { title })} data-testid="download">
          <Download />
        </summary>
        <div className="menu-items">
          {FORMS.map((form) => (
            <button
              key={form}
              type="button"
              data-testid={`download-${form}`}
              onClick={() => {
                save[form]();
                close();
              }}
            >
              {NAMES[form]}
            </button>
          ))}
        </div>
      </details>
    </div>
  );
}
