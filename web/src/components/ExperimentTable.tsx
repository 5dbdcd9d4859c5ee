// The experiments as a table: press a column's name to order by it, tick rows to compare them.
import { t } from "../i18n";
import { type Sort, sortedBy, sortOf } from "../listing";
import type { Experiment } from "../wire";
import { ExperimentRow, type ExperimentRowProps } from "./ExperimentRow";

const COLUMNS: { sort: Sort; label: () => string; className?: string }[] = [
  { sort: "name", label: () => t("list.sort_name"), className: "what" },
  { sort: "feedback", label: () => t("counters.feedback") },
  { sort: "good_share", label: () => t("counters.goodShare") },
  { sort: "successes", label: () => t("counters.successes") },
  { sort: "violations", label: () => t("list.violations") },
  { sort: "updated", label: () => t("list.sort_updated"), className: "when" },
];

export interface ExperimentTableProps
  extends Omit<ExperimentRowProps, "experiment" | "selected" | "onSelect"> {
  experiments: Experiment[];
  listing: URLSearchParams;
  selected: ReadonlySet<number>;
  onSelect: (id: number, selected: boolean) => void;
  onListing: (listing: URLSearchParams) => void;
}

export function ExperimentTable(props: ExperimentTableProps) {
  const { experiments, listing, selected, onSelect, onListing, ...row } = props;
  const now = sortOf(listing);
  return (
    <table className="experiments">
      <caption className="sr-only">{t("experiments.title")}</caption>
      <thead>
        <tr>
          <th scope="col" className="pick">
            <span className="sr-only">{t("list.selected")}</span>
          </th>
          {COLUMNS.map(({ sort, label, className }) => (
            <th
              key={sort}
              scope="col"
              className={className}
              aria-sort={now.sort === sort ? (now.order === "asc" ? "ascending" : "descending") : "none"}
            >
              <button
                type="button"
                data-testid={`sort-${sort}`}
                onClick={() => onListing(sortedBy(listing, sort))}
              >
                {label()}
                <span aria-hidden="true">{now.sort === sort ? (now.order === "asc" ? "↑" : "↓") : ""}</span>
              </button>
            </th>
          ))}
          <th scope="col">
            <span className="sr-only">{t("list.acts")}</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {experiments.map((experiment) => (
          <ExperimentRow
            key={experiment.id}
            experiment={experiment}
            selected={selected.has(experiment.id)}
            onSelect={(on) => onSelect(experiment.id, on)}
            {...row}
          />
        ))}
      </tbody>
    </table>
  );
}
