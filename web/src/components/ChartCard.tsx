// One chart: zoomed by dragging over it or by its buttons, smoothed, read off under the pointer, and downloaded.
import { useEffect, useMemo, useRef, useState } from "react";
import type uPlot from "uplot";
import { aligned, csvOf, type Drawn, drawn, extent, type Picture, rangeOf } from "../charting";
import { type Look, svgOf } from "../chartSvg";
import { download, pngOf } from "../downloading";
import { t } from "../i18n";
import { compact, percent } from "../i18n/numbers";
import { onThemeChange, themeColor, themeFont } from "../theme";
import { ChartTools } from "./ChartTools";
import { useLibrary } from "./Curve";

const HEIGHT = 240;
const COLORS = [0, 1, 2, 3, 4, 5, 6];
type Span = [number, number];

export interface ChartCardProps {
  picture: Picture;
  /** Weight of the moving average, 0 to below 1. */
  smoothing: number;
  /** Begins the names of downloaded files. */
  fileName: string;
  height?: number;
}

function lookOf(): Look {
  return {
    ink: themeColor("--ink"),
    soft: themeColor("--ink-soft"),
    grid: themeColor("--edge"),
    background: themeColor("--raised"),
    font: "system-ui, sans-serif",
    colors: COLORS.map((color) => themeColor(`--curve-${color}`)),
  };
}

interface Setting {
  width: number;
  height: number;
  picture: Picture;
  lines: Drawn[];
  format: (value: number) => string;
  onSpan: (span: Span | null) => void;
  onRead: (index: number | null) => void;
}

function options({ width, height, picture, lines, format, onSpan, onRead }: Setting): uPlot.Options {
  const axis = {
    stroke: themeColor("--ink-soft"),
    font: `11px ${themeFont()}`,
    grid: { stroke: themeColor("--edge"), width: 1 },
    ticks: { show: false },
  };
  const bands: uPlot.Band[] = [];
  const series: uPlot.Series[] = [{}];
  for (const line of lines) {
    const stroke = themeColor(`--curve-${line.color}`);
    series.push({
      stroke,
      width: line.behind ? 1 : 2,
      alpha: line.behind ? 0.28 : 1,
      spanGaps: true,
      points: { show: line.x.length < 2 || Boolean(line.low), size: 6, fill: stroke },
      ...(line.dashed ? { dash: [6, 5] } : {}),
    });
    if (line.low && line.high) {
      const edge = { stroke: "transparent", width: 0, points: { show: false }, spanGaps: true };
      series.push(edge, edge);
      const fill = stroke.replace(/^rgb\((.*)\)$/, "rgba($1, 0.18)");
      bands.push({ series: [series.length - 1, series.length - 2], fill });
    }
  }
  return {
    width,
    height,
    padding: [10, 18, 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: true, y: false, dist: 6 }, points: { size: 7 } },
    scales: {
      x: picture.logarithmic ? { time: false, distr: 3 } : { time: false },
      y: { range: (_u, low, high) => rangeOf(picture, low === null ? null : [low, high]) },
    },
    axes: [
      {
        ...axis,
        grid: { show: false },
        size: 28,
        values: (_u, values) => values.map((value) => (value == null ? "" : compact(value))),
      },
      {
        ...axis,
        size: 52,
        values: (_u, values) => values.map((value) => (value == null ? "" : format(value))),
      },
    ],
    series,
    bands,
    hooks: {
      setCursor: [(u) => onRead(u.cursor.idx ?? null)],
      setScale: [
        (u, key) => {
          const { min, max } = u.scales.x ?? {};
          const all = extent(u.data[0] ?? []);
          if (key !== "x" || min == null || max == null || !all) return;
          onSpan(min > all[0] || max < all[1] ? [min, max] : null);
        },
      ],
    },
  };
}

/** The chart itself, built anew when its lines' number or the colours change; new numbers only are set. */
function usePlot(picture: Picture, lines: Drawn[], height: number, format: (value: number) => string) {
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const [span, setSpan] = useState<Span | null>(null);
  const [read, setRead] = useState<number | null>(null);
  const library = useLibrary();
  const data = useMemo(() => aligned(lines, picture.logarithmic) as uPlot.AlignedData, [lines, picture]);
  const shape = JSON.stringify([
    picture.logarithmic,
    lines.map(({ color, dashed, behind, low, label }) => [color, dashed, behind, !low, label]),
  ]);
  const newest = useRef({ picture, lines, data });
  newest.current = { picture, lines, data };
  useEffect(() => {
    const chart = plot.current;
    if (!chart) return;
    const { min, max } = chart.scales.x ?? {};
    const before = extent(chart.data[0] ?? []);
    chart.setData(data, false);
    const all = extent(data[0] ?? []);
    const zoomed = before && min != null && max != null && (min > before[0] || max < before[1]);
    // what somebody zoomed into stays; what grows at its end is followed
    if (all) chart.setScale("x", zoomed ? { min, max } : { min: all[0], max: all[1] });
  }, [data]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: built anew for another shape, not for other numbers
  useEffect(() => {
    const element = box.current;
    if (!library || !element) return;
    const build = () => {
      plot.current?.destroy();
      const setting = {
        ...newest.current,
        width: element.clientWidth,
        height,
        format,
        onSpan: setSpan,
        onRead: setRead,
      };
      plot.current = new library(options(setting), newest.current.data, element);
    };
    build();
    const unwatch = onThemeChange(build);
    const resized = new ResizeObserver(() => plot.current?.setSize({ width: element.clientWidth, height }));
    resized.observe(element);
    return () => {
      unwatch();
      resized.disconnect();
      plot.current?.destroy();
      plot.current = null;
    };
  }, [library, shape, height]);
  const zoom = (factor: number | null) => {
    const all = extent(data[0] ?? []);
    if (!plot.current || !all) return;
    const [from, to] = span ?? all;
    const middle = (from + to) / 2;
    const half = factor === null ? Number.POSITIVE_INFINITY : ((to - from) / 2) * factor;
    plot.current.setScale("x", {
      min: Math.max(all[0], middle - half),
      max: Math.min(all[1], middle + half),
    });
  };
  return { box, span, read, data, zoom };
}

export function ChartCard({ picture, smoothing, fileName, height = HEIGHT }: ChartCardProps) {
  const format = (value: number) => (picture.share ? percent(value) : compact(value));
  const lines = useMemo(() => drawn(picture, smoothing), [picture, smoothing]);
  const { box, span, read, data, zoom } = usePlot(picture, lines, height, format);
  const file = `${fileName}-${picture.name}`;
  const svg = () => svgOf(picture, lines, span, lookOf(), format);
  const save = {
    csv: () => download(`${file}.csv`, new Blob([csvOf(picture)], { type: "text/csv" })),
    svg: () => download(`${file}.svg`, new Blob([svg()], { type: "image/svg+xml" })),
    png: () => void pngOf(svg()).then((blob) => download(`${file}.png`, blob)),
  };
  const words = picture.lines.map((line) => {
    const last = line.y.findLast((value) => value !== null);
    return t("chart.ends", {
      line: line.label,
      value: last === undefined || last === null ? "–" : format(last),
    });
  });
  return (
    <section className="card chart-card" aria-label={picture.title} data-testid={`chart-${picture.name}`}>
      <div className="chart-head">
        <h2>{picture.title}</h2>
        <ChartTools title={picture.title} zoomed={span !== null} onZoom={zoom} save={save} />
      </div>
      {picture.about && <p className="about">{picture.about}</p>}
      <div
        className="plot"
        role="img"
        aria-label={t("chart.words", { title: picture.title, lines: words.join("; ") })}
        data-points={data[0]?.length ?? 0}
        data-zoomed={span !== null}
        style={{ minHeight: height }}
        ref={box}
      />
      <Legend lines={lines} data={data} read={read} format={format} axis={picture.axis} />
    </section>
  );
}

interface LegendProps {
  lines: Drawn[];
  data: uPlot.AlignedData;
  read: number | null;
  format: (value: number) => string;
  axis: string;
}

/** Which line is whose; and its value under the pointer, or else its last one. */
function Legend({ lines, data, read, format, axis }: LegendProps) {
  const x = read === null ? null : data[0]?.[read];
  const told = (line: Drawn) => {
    if (x == null) return line.y.findLast((value) => value !== null);
    const upto = line.x.findLastIndex((each) => each <= x);
    return upto < 0 ? null : line.y[upto];
  };
  return (
    <div className="chart-foot">
      <ul className="legend">
        {lines
          .filter((line) => !line.behind)
          .map((line) => {
            const value = told(line);
            return (
              <li key={line.label}>
                <i
                  className={line.dashed ? "dashed" : ""}
                  style={{ borderColor: `var(--curve-${line.color})` }}
                />
                {line.label}
                <b className="number">{value == null ? "–" : format(value)}</b>
              </li>
            );
          })}
      </ul>
      <span className="axis-name">{x == null ? axis : t("chart.at", { x: compact(x), axis })}</span>
    </div>
  );
}
