// The live chart: successes over the number of feedbacks. uPlot is loaded apart, so that the page opens without it.
import { useEffect, useRef, useState } from "react";
import type uPlot from "uplot";
import type { CurvePoint } from "../state";

const HEIGHT = 190;

function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function options(width: number): uPlot.Options {
  const axis = {
    stroke: color("--ink-soft"),
    font: `11px ${color("--font")}`,
    grid: { stroke: color("--edge"), width: 1 },
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
    series: [{}, { stroke: color("--good"), fill: color("--good-soft"), width: 2, points: { show: false } }],
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
    const scheme = matchMedia("(prefers-color-scheme: light)");
    scheme.addEventListener("change", build);
    const resized = new ResizeObserver(() =>
      chart.current?.setSize({ width: element.clientWidth, height: HEIGHT }),
    );
    resized.observe(element);
    return () => {
      scheme.removeEventListener("change", build);
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
  const summary = last ? `${last.successes} successes after ${last.feedback} feedback` : "no feedback yet";
  return (
    <section className="card" aria-label="Successes">
      <h2>Successes over feedback</h2>
      <div
        className="curve"
        role="img"
        aria-label={`Chart: ${summary}`}
        data-testid="curve"
        data-points={curve.length}
      >
        {drawable ? (
          <Chart curve={curve} />
        ) : (
          <p className="empty-chart">The curve starts with your first clicks.</p>
        )}
      </div>
    </section>
  );
}
