// The curve of successes over feedback: points in order, one for each amount of feedback. Pure.
import type { MetricPoint } from "./wire";

export interface CurvePoint {
  feedback: number;
  successes: number;
}

export function addMetric(curve: CurvePoint[], point: MetricPoint): CurvePoint[] {
  const successes = point.values.successes;
  return successes === undefined ? curve : addPoint(curve, { feedback: point.feedback, successes });
}

/** Sorted by feedback, one point each, the newest word on an amount of feedback wins. */
export function addPoint(curve: CurvePoint[], point: CurvePoint): CurvePoint[] {
  let at = curve.length;
  while (at > 0 && (curve[at - 1]?.feedback ?? 0) > point.feedback) at -= 1;
  const same = at > 0 ? curve[at - 1] : undefined;
  if (same?.feedback !== point.feedback) return [...curve.slice(0, at), point, ...curve.slice(at)];
  if (same.successes === point.successes) return curve;
  return [...curve.slice(0, at - 1), point, ...curve.slice(at)];
}
