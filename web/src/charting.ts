// From an experiment's curves to the lines of a chart: names, colours, smoothing, and one axis for all of them.
import { known, skillName, t } from "./i18n";
import type { ChartInfo, CurveInfo } from "./wire";

export interface Line {
  label: string;
  /** Number of the theme's curve colour. */
  color: number;
  dashed?: boolean;
  x: number[];
  y: (number | null)[];
  low?: (number | null)[] | null;
  high?: (number | null)[] | null;
}

export interface Picture {
  /** For file names and tests. */
  name: string;
  title: string;
  about: string;
  axis: string;
  lines: Line[];
  /** Shares are shown in per cent, from 0 to 1. */
  share: boolean;
  /** Some lines would be squeezed to nothing by the longest: the x axis is logarithmic, and has no 0. */
  logarithmic?: boolean;
  /** Whether smoothing means something: counts that only grow stay as they are. */
  smoothable: boolean;
}

const SHARES = new Set(["success_rate", "good_share", "violation_ratio", "skills"]);
const UNSMOOTHED = new Set(["successes", "success_rate"]);
const COLORS = 7;

const AXES = {
  feedback: "chart.axisFeedback",
  low_level_steps: "chart.axisSteps",
  proposals: "chart.axisProposals",
  decisions: "chart.axisDecisions",
} as const;

export const axisName = (axis: ChartInfo["axis"]): string => t(AXES[axis]);

/** A metric's name in words; a foreign algorithm's is called what it calls it. */
export function measureName(name: string): string {
  return known(`chart.title_${name}`) ? t(`chart.title_${name as "successes"}`) : name.replaceAll("_", " ");
}

function lineName(chart: string, curve: CurveInfo): string {
  if (chart === "skills") return skillName(curve.name);
  return known(`chart.line_${curve.name}`)
    ? t(`chart.line_${curve.name as "successes"}`)
    : curve.name.replaceAll("_", " ");
}

export function pictureOf(chart: ChartInfo): Picture {
  const { name } = chart;
  return {
    name,
    title: measureName(name),
    about: known(`chart.about_${name}`) ? t(`chart.about_${name as "successes"}`) : "",
    axis: axisName(chart.axis),
    share: SHARES.has(name),
    smoothable: !UNSMOOTHED.has(name),
    lines: chart.curves.map((curve, index) => ({
      label: lineName(name, curve),
      color: index % COLORS,
      x: curve.x,
      y: curve.y,
      low: curve.low,
      high: curve.high,
    })),
  };
}

/** An exponential moving average that isn't drawn to 0 at its start, as TensorBoard's. weight: 0 leaves all as it is. */
export function smoothed(y: (number | null)[], weight: number): (number | null)[] {
  if (weight <= 0) return y;
  let last = 0;
  let seen = 0;
  return y.map((value) => {
    if (value === null || !Number.isFinite(value)) return value;
    last = last * weight + (1 - weight) * value;
    seen += 1;
    return last / (1 - weight ** seen);
  });
}

export interface Drawn extends Line {
  /** What a smoothed line was before; it stays faint behind it. */
  behind?: boolean;
}

/** With smoothing each line comes after what it was. */
export function drawn(picture: Picture, weight: number): Drawn[] {
  if (!picture.smoothable || weight <= 0) return picture.lines;
  return picture.lines.flatMap((line) => [
    { ...line, behind: true },
    { ...line, y: smoothed(line.y, weight), low: null, high: null },
  ]);
}

/** All columns over the union of their points, null where one has none: x, then y, low and high of each line. */
export function aligned(lines: Line[], logarithmic = false): (number | null)[][] {
  const points = [...new Set(lines.flatMap((line) => line.x))]
    .filter((x) => !logarithmic || x > 0)
    .sort((a, b) => a - b);
  const column = (x: number[], y: (number | null)[]) => {
    const at = new Map(x.map((each, index) => [each, y[index] ?? null]));
    return points.map((each) => at.get(each) ?? null);
  };
  return [
    points,
    ...lines.flatMap(({ x, y, low, high }) => [
      column(x, y),
      ...(low && high ? [column(x, low), column(x, high)] : []),
    ]),
  ];
}

/** Least and greatest of what is drawn. */
export function extent(values: Iterable<number | null | undefined>): [number, number] | null {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const value of values) {
    if (value === null || value === undefined || !Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low <= high ? [low, high] : null;
}

/** The y axis: shares from 0 to what there is, counts from 0, anything else with a little room. */
export function rangeOf(picture: Picture, found: [number, number] | null): [number, number] {
  const [low, high] = found ?? [0, 1];
  if (picture.share) return [0, Math.min(1.02, Math.max(0.1, high * 1.08))];
  if (low >= 0) return [0, high > 0 ? high * 1.08 : 1];
  const room = (high - low || 1) * 0.06;
  return [low - room, high + room];
}

/** How many times further than another a line may go before the axis is logarithmic. */
const FAR = 4;

export function isLogarithmic(lines: Line[]): boolean {
  const ends = lines.map((line) => line.x.at(-1) ?? 0).filter((end) => end > 0);
  return ends.length > 0 && Math.max(...ends) > FAR * Math.min(...ends);
}

/** Powers of ten from low to high, and the ends where there are fewer than two. */
export function powers(low: number, high: number): number[] {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const found = Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => 10 ** (first + index));
  return found.length < 2 ? [low, high] : found;
}

/** About `count` round numbers from low to high. */
export function ticks(low: number, high: number, count: number): number[] {
  const span = high - low;
  if (!(span > 0)) return [low];
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((each) => each * power >= rough) ?? 10) * power;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, index) =>
    Number(((first + index) * step).toPrecision(12)),
  );
}

/** The picture's numbers as a table, as a spreadsheet reads it. */
export function csvOf(picture: Picture): string {
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const heads = picture.lines.flatMap((line) => [
    line.label,
    ...(line.low && line.high ? [`${line.label} −`, `${line.label} +`] : []),
  ]);
  const columns = aligned(picture.lines);
  const rows = (columns[0] ?? []).map((_, index) => columns.map((column) => column[index] ?? "").join(","));
  return `${[[picture.axis, ...heads].map(quoted).join(","), ...rows].join("\n")}\n`;
}
