// What is compared, as the address says it, and how it lies in one picture with the paper's own curves.
import { axisName, isLogarithmic, type Line, measureName, type Picture } from "./charting";
import { t } from "./i18n";
import type { Comparison, Measure, PaperFigures } from "./wire";

export const MEASURES: Measure[] = [
  "successes",
  "success_rate",
  "good_share",
  "violation_ratio",
  "critic_loss",
  "estimate_error",
];
export const GROUPINGS = ["task", "algorithm", "preset", "adapter", "teacher", "tag"] as const;
export type Grouping = (typeof GROUPINGS)[number];
export type PaperFigure = PaperFigures["figures"][number];

export interface Compared {
  experiments: number[];
  measure: Measure;
  by: Grouping[];
  /** A scenario of the paper; empty: none of its curves. */
  paper: string;
}

const SHARES = new Set<Measure>(["success_rate", "good_share", "violation_ratio"]);
const COLORS = 7;

export function comparedIn(search: string): Compared {
  const query = new URLSearchParams(search);
  const ids = query.getAll("experiment").map(Number);
  return {
    experiments: [...new Set(ids.filter((id) => Number.isSafeInteger(id) && id > 0))],
    measure: MEASURES.find((each) => each === query.get("measure")) ?? "successes",
    by: GROUPINGS.filter((each) => query.getAll("by").includes(each)),
    paper: query.get("paper") ?? "",
  };
}

export function searchOf({ experiments, measure, by, paper }: Compared): URLSearchParams {
  return new URLSearchParams([
    ...experiments.map((id) => ["experiment", String(id)]),
    ["measure", measure],
    ...by.map((each) => ["by", each]),
    ...(paper ? [["paper", paper]] : []),
  ]);
}

/** The figures of the paper that show this measure. */
export const figuresOf = (paper: PaperFigures | null, measure: Measure): PaperFigure[] =>
  (paper?.figures ?? []).filter((each) => each.measure === measure && each.curves.length > 0);

export function pictureOfComparison(comparison: Comparison, figure: PaperFigure | undefined): Picture {
  const ours: Line[] = comparison.curves.map((curve, index) => {
    const shifted = (sign: number) =>
      curve.mean.map((mean, at) => {
        const sem = curve.sem[at];
        return sem == null ? null : mean + sign * sem;
      });
    const count = curve.experiments.length;
    return {
      label: count > 1 ? t("compare.runs", { label: curve.label, count }) : curve.label,
      color: index % COLORS,
      x: curve.x,
      y: curve.mean,
      ...(count > 1 ? { low: shifted(-1), high: shifted(1) } : {}),
    };
  });
  const theirs: Line[] = (figure?.curves ?? []).map((curve, index) => ({
    label:
      curve.trial === null
        ? t("compare.paper", { title: curve.title })
        : t("compare.paperTrial", { title: curve.title, trial: curve.trial }),
    color: (ours.length + index) % COLORS,
    dashed: true,
    x: curve.x,
    y: curve.y,
  }));
  const lines = [...theirs, ...ours];
  const logarithmic = isLogarithmic(lines);
  return {
    name: comparison.measure,
    title: measureName(comparison.measure),
    about: logarithmic ? t("studies.noteLogarithmic") : "",
    logarithmic,
    axis: axisName(comparison.axis),
    share: SHARES.has(comparison.measure),
    smoothable: false,
    lines,
  };
}

/** The settings in which these differ, and each one's value, for the table below the chart. */
export function differing(settings: Record<string, unknown>[]): string[] {
  const names = [...new Set(settings.flatMap((each) => Object.keys(each)))];
  return names.filter((name) => new Set(settings.map((each) => JSON.stringify(each[name]))).size > 1);
}
