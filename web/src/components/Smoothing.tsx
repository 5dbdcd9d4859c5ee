// How much the charts are smoothed; remembered in this browser.
import { useId, useState } from "react";
import { t } from "../i18n";
import { decimal } from "../i18n/numbers";

const KEPT = "seed.smoothing";
const MOST = 0.99;

function kept(): number {
  try {
    const value = Number(localStorage.getItem(KEPT) ?? 0);
    return value >= 0 && value <= MOST ? value : 0;
  } catch {
    return 0; // without storage nothing is smoothed at first
  }
}

export function useSmoothing(): [number, (value: number) => void] {
  const [value, setValue] = useState(kept);
  const change = (next: number) => {
    setValue(next);
    try {
      localStorage.setItem(KEPT, String(next));
    } catch {
      // Without storage it lasts as long as the page.
    }
  };
  return [value, change];
}

export function Smoothing({ value, onChange }: { value: number; onChange: (value: number) => void }) {
  const id = useId();
  return (
    <div className="smoothing">
      <label htmlFor={id}>{t("chart.smoothing")}</label>
      <input
        id={id}
        type="range"
        min={0}
        max={MOST}
        step={0.01}
        value={value}
        data-testid="smoothing"
        onChange={(event) => onChange(Number(event.target.value))}
      />
      <output htmlFor={id} className="number">
        {decimal(value)}
      </output>
    </div>
  );
}
