// One scenario's curves: ours as lines with their standard errors as thin ones, the paper's dashed behind them.

import { useEffect, useRef } from "react";
import type uPlot from "uplot";
import { t } from "../i18n";
import { decimal } from "../i18n/numbers";
import { type ChartLine, chartData, isLogarithmic, linesOf } from "../studyLines";
import { onThemeChange, themeColor, themeFont } from "../theme";
import type { StudyScenario } from "../wire";
import { useLibrary } from "./Curve";

const HEIGHT = 280;
const LABELS = { low_level_steps: "studies.axisSteps", decisions: "studies.axisDecisions" } as const;

function options(width: number, scenario: StudyScenario, lines: ChartLine[]): uPlot.Options {
  const axis = {
    stroke: themeColor("--ink-soft"),
    font: `11px ${themeFont()}`,
    labelFont: `12px ${themeFont()}`,
    grid: { stroke: themeColor("--edge"), width: 1 },
    ticks: { show: false },
    labelSize: 18,
  };
  const rate = scenario.measure === "success_rate";
  const logarithmic = isLogarithmic(lines);
  return {
    width,
    height: HEIGHT,
    padding: [8, 30, 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false } },
    scales: {
      x: logarithmic ? { time: false, distr: 3 } : { time: false },
      y: { range: (_u, _low, high) => [0, rate ? 1.04 : Math.max(high * 1.08, 2)] },
    },
    axes: [
      { ...axis, label: t(LABELS[scenario.axis]), size: 30 },
      { ...axis, label: rate ? t("studies.rate") : t("studies.whileTraining"), size: 44 },
    ],
    series: [
      {},
      ...lines.map((line) => ({
        stroke: themeColor(`--curve-${line.color}`),
        width: line.kind === "mean" ? 2.5 : 1.5,
        alpha: line.kind === "mean" ? 1 : line.kind === "paper" ? 0.65 : 0.35,
        spanGaps: true,
        points: { show: line.x.length === 1, size: 7 },
        ...(line.kind === "paper" ? { dash: [6, 5] } : {}),
      })),
    ],
  };
}

export function StudyChart({ scenario }: { scenario: StudyScenario }) {
  const box = useRef<HTMLDivElement>(null);
  const library = useLibrary();
  useEffect(() => {
    const element = box.current;
    if (!library || !element) return;
    const lines = linesOf(scenario);
    let chart: uPlot | null = null;
    const build = () => {
      chart?.destroy();
      chart = new library(options(element.clientWidth, scenario, lines), chartData(lines), element);
    };
    build();
    const unwatch = onThemeChange(build);
    const resized = new ResizeObserver(() => chart?.setSize({ width: element.clientWidth, height: HEIGHT }));
    resized.observe(element);
    return () => {
      unwatch();
      resized.disconnect();
      chart?.destroy();
    };
  }, [library, scenario]);
  const told = scenario.curves.map((curve) => `${curve.title} ${decimal(curve.mean.at(-1) ?? 0)}`).join(", ");
  return (
    <div
      className="study-chart"
      role="img"
      aria-label={
        told
          ? t("studies.chart", { title: scenario.title, curves: told })
          : t("studies.chartEmpty", { title: scenario.title })
      }
      data-testid="study-chart"
      data-curves={scenario.curves.length}
      data-points={Math.max(0, ...scenario.curves.map((curve) => curve.x.length))}
      style={{ minHeight: HEIGHT }}
      ref={box}
    />
  );
}

/** Which line is whose. */
export function StudyLegend({ scenario }: { scenario: StudyScenario }) {
  const named = linesOf(scenario).filter((line) => line.label !== null);
  return (
    <ul className="legend">
      {named.map((line) => (
        <li key={line.label}>
          <i
            className={line.kind === "paper" ? "dashed" : ""}
            style={{ borderColor: `var(--curve-${line.color})` }}
          />
          {line.label}
        </li>
      ))}
    </ul>
  );
}
