// From a scenario's curves to what the chart draws.

import type uPlot from "uplot";
import { t } from "./i18n";
import type { StudyScenario } from "./wire";

export interface ChartLine {
  /** null: a line that belongs to the one before it. */
  label: string | null;
  kind: "mean" | "sem" | "paper";
  /** Number of the theme's curve colour. */
  color: number;
  x: number[];
  y: (number | null)[];
}

/** The same algorithm has the same colour everywhere; others take what is left. */
const COLORS: Record<string, number> = {
  seed: 0,
  "maple-aff": 1,
  tamer: 2,
  "seed-recommended": 3,
  maple: 4,
  sac: 6,
};
const COUNT = 7;
/** How many times further than another a curve may go before the axis is logarithmic. */
const FAR = 4;

/** A curve's name, and of how many seeds it is: those far behind the others aren't in it yet. */
function labelOf(curve: StudyScenario["curves"][number]): string {
  const { title, seeds, planned } = curve;
  return seeds < planned
    ? t("studies.legendSeedsOf", { title, seeds, count: planned })
    : t("studies.legendSeeds", { title, count: planned });
}

/** The paper's first, so that ours lie above them. */
export function linesOf(scenario: StudyScenario): ChartLine[] {
  const told = new Set<string>();
  const lines: ChartLine[] = scenario.paper.map((curve) => {
    const label = told.has(curve.algorithm) ? null : t("studies.legendPaper", { title: curve.title });
    told.add(curve.algorithm);
    return { label, kind: "paper", color: COLORS[curve.algorithm] ?? COUNT - 1, x: curve.x, y: curve.y };
  });
  scenario.curves.forEach((curve, index) => {
    const color = COLORS[curve.algorithm] ?? index % COUNT;
    const label = labelOf(curve);
    const shifted = (sign: number) =>
      curve.mean.map((mean, at) => (curve.sem[at] == null ? null : mean + sign * Number(curve.sem[at])));
    if (curve.seeds > 1) {
      lines.push({ label: null, kind: "sem", color, x: curve.x, y: shifted(1) });
      lines.push({ label: null, kind: "sem", color, x: curve.x, y: shifted(-1) });
    }
    lines.push({ label, kind: "mean", color, x: curve.x, y: curve.mean });
  });
  return lines;
}

/** Whether some lines would be squeezed to nothing by the longest. */
export function isLogarithmic(lines: ChartLine[]): boolean {
  const ends = lines.map((line) => line.x.at(-1) ?? 0).filter((end) => end > 0);
  return ends.length > 0 && Math.max(...ends) > FAR * Math.min(...ends);
}

/** In words, what the chart can't show: points without a place on its axis, and lines that lie under others. */
export function notesOf(scenario: StudyScenario): string[] {
  const notes: string[] = [];
  if (isLogarithmic(linesOf(scenario))) {
    const hidden = scenario.curves.filter((curve) => curve.x.every((x) => x === 0)).map(labelOf);
    notes.push(t("studies.noteLogarithmic"));
    if (hidden.length > 0) notes.push(t("studies.noteOnlyAtZero", { titles: hidden.join(", ") }));
  }
  const alike = new Map<string, string[]>();
  for (const curve of scenario.paper) {
    const line = JSON.stringify([curve.x, curve.y]);
    alike.set(line, [...(alike.get(line) ?? []), curve.title]);
  }
  for (const titles of alike.values()) {
    if (titles.length > 1) notes.push(t("studies.noteOneLine", { titles: titles.join(", ") }));
  }
  return notes;
}

/** All lines over the union of their points; null where a line has none. A logarithmic axis has no 0. */
export function chartData(lines: ChartLine[]): uPlot.AlignedData {
  const logarithmic = isLogarithmic(lines);
  const points = [...new Set(lines.flatMap((line) => line.x))]
    .filter((x) => !logarithmic || x > 0)
    .sort((a, b) => a - b);
  const columns = lines.map((line) => {
    const at = new Map(line.x.map((x, index) => [x, line.y[index] ?? null]));
    return points.map((x) => at.get(x) ?? null);
  });
  return [points, ...columns];
}
