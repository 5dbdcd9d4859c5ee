// The live chart: successes over the number of feedbacks. uPlot is loaded apart, so that the page opens without it.

import { useEffect, useRef, useState } from "react";
import type uPlot from "uplot";
import type { CurvePoint } from "../curve";
import { t } from "../i18n";
import { onThemeChange, themeColor, themeFont } from "../theme";

const HEIGHT = 190;

function options(width: number): uPlot.Options {
  const axis = {
    stroke: themeColor("--ink-soft"),
    font: `11px ${themeFont()}`,
    grid: { stroke: themeColor("--edge"), width: 1 },
    ticks: { show: false },
    // counts: no fractions of a click
    incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000],
  };
  return {
    width,
    height: HEIGHT,
    padding: [8, 8, 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false } },
    scales: {
      x: { time: false, range: (_u, low, high) => [low, Math.max(high, low + 10)] },
      y: { range: (_u, _low, high) => [0, Math.max(high * 1.08, 2)] },
    },
    axes: [
      { ...axis, grid: { show: false }, size: 26 },
      { ...axis, size: 34 },
    ],
    series: [
      {},
      { stroke: themeColor("--good"), fill: themeColor("--good-soft"), width: 2, points: { show: false } },
    ],
  };
}

function dataOf(curve: CurvePoint[]): uPlot.AlignedData {
  return [curve.map((point) => point.feedback), curve.map((point) => point.successes)];
}

/** The library, once it is here. */
export function useLibrary(): typeof uPlot | null {
  const [library, setLibrary] = useState<{ plot: typeof uPlot } | null>(null);
  useEffect(() => {
    let gone = false;
    Promise.all([import("uplot"), import("uplot/dist/uPlot.min.css")]).then(
      ([module]) => gone || setLibrary({ plot: module.default }),
      (error: unknown) => console.error("The chart's code can't be loaded", error),
    );
    return () => {
      gone = true;
    };
  }, []);
  return library?.plot ?? null;
}

function Chart({ curve }: { curve: CurvePoint[] }) {
  const box = useRef<HTMLDivElement>(null);
  const chart = useRef<uPlot | null>(null);
  const newest = useRef(curve);
  const library = useLibrary();
  useEffect(() => {
    newest.current = curve;
    chart.current?.setData(dataOf(curve));
  }, [curve]);
  useEffect(() => {
    const element = box.current;
    if (!library || !element) return;
    const build = () => {
      chart.current?.destroy();
      chart.current = new library(options(element.clientWidth), dataOf(newest.current), element);
    };
    build();
    const unwatch = onThemeChange(build);
    const resized = new ResizeObserver(() =>
      chart.current?.setSize({ width: element.clientWidth, height: HEIGHT }),
    );
    resized.observe(element);
    return () => {
      unwatch();
      resized.disconnect();
      chart.current?.destroy();
      chart.current = null;
    };
  }, [library]);
  return <div ref={box} />;
}

export function Curve({ curve }: { curve: CurvePoint[] }) {
  const last = curve.at(-1);
  const drawable = curve.length > 1;
  const summary = last
    ? t("curve.summary", { successes: last.successes, feedback: last.feedback })
    : t("curve.none");
  return (
    <section className="card" aria-label={t("curve.label")}>
      <h2>{t("curve.title")}</h2>
      <div className="curve" role="img" aria-label={summary} data-testid="curve" data-points={curve.length}>
        {drawable ? <Chart curve={curve} /> : <p className="empty-chart">{t("curve.empty")}</p>}
      </div>
    </section>
  );
}
