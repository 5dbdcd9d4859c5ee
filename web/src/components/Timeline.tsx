// The shown proposals along a line, oldest at the left: above it what was good, below it what was bad.
import { labelOf, stepPath } from "../gallery";
import { t } from "../i18n";
import { navigate } from "../router";
import type { HistoryEntry } from "../wire";

const WIDTH = 1000;
const HEIGHT = 44;
const PLACES = { good: [4, 18], neutral: [19, 6], cantTell: [19, 6], bad: [22, 18], none: [21, 2] } as const;

export function Timeline({ id, entries }: { id: number; entries: HistoryEntry[] }) {
  const line = entries.toReversed();
  const step = WIDTH / Math.max(line.length, 40);
  const good = line.filter((entry) => labelOf(entry) === "good").length;
  const bad = line.filter((entry) => labelOf(entry) === "bad").length;
  return (
    <svg
      className="timeline"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={t("gallery.timeline", { good, bad, count: line.length })}
      data-testid="timeline"
    >
      <path d={`M0 ${HEIGHT / 2}H${WIDTH}`} />
      {line.map((entry, index) => {
        const label = labelOf(entry);
        const [top, height] = PLACES[label];
        return (
          // biome-ignore lint/a11y/noStaticElementInteractions: the pictures below lead to the same places by keyboard
          <g key={entry.proposal.id} onClick={() => navigate(stepPath(id, entry))}>
            <rect
              data-label={label}
              x={index * step + step * 0.1}
              y={top}
              width={step * 0.8}
              height={height}
            />
            {entry.execution && (
              <rect
                data-label={entry.execution.violations.length > 0 ? "violation" : "executed"}
                x={index * step + step * 0.1}
                y={0}
                width={step * 0.8}
                height={3}
              />
            )}
          </g>
        );
      })}
    </svg>
  );
}
