// A chart as an SVG document of its own, to be put into a paper: what is on the page, in colours that don't need it.
import { type Drawn, extent, type Picture, powers, rangeOf, ticks } from "./charting";

export interface Look {
  ink: string;
  soft: string;
  grid: string;
  background: string;
  font: string;
  colors: string[];
}

const WIDTH = 720;
const HEIGHT = 420;
const LEFT = 64;
const RIGHT = 20;
const TOP = 44;
const BOTTOM = 52;
const LINE = 18;

const safe = (text: string) =>
  text.replace(
    /[&<>"]/g,
    (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign] ?? sign,
  );
const short = (value: number) => Number(value.toFixed(2));

/** window: what of the x axis is looked at; null: all. */
export function svgOf(
  picture: Picture,
  lines: Drawn[],
  window: [number, number] | null,
  look: Look,
  format: (value: number) => string,
): string {
  const legend = lines.filter((line) => !line.behind);
  const height = HEIGHT + Math.ceil(legend.length / 3) * LINE;
  const bottom = HEIGHT - BOTTOM;
  const log = picture.logarithmic ?? false;
  const [x0, x1] = window ?? extent(lines.flatMap((line) => line.x.filter((x) => !log || x > 0))) ?? [0, 1];
  const within = lines.flatMap((line) =>
    [line.y, line.low ?? [], line.high ?? []].flatMap((column) =>
      column.filter((_, index) => (line.x[index] ?? 0) >= x0 && (line.x[index] ?? 0) <= x1),
    ),
  );
  const [y0, y1] = rangeOf(picture, extent(within));
  const along = (x: number) =>
    log ? Math.log(Math.max(x, x0) / x0) / (Math.log(x1 / x0) || 1) : (x - x0) / (x1 - x0 || 1);
  const px = (x: number) => short(LEFT + along(x) * (WIDTH - LEFT - RIGHT));
  const py = (y: number) => short(bottom - ((y - y0) / (y1 - y0 || 1)) * (bottom - TOP));
  const text = (x: number, y: number, words: string, more = "") =>
    `<text x="${x}" y="${y}" fill="${look.soft}" font-size="12" ${more}>${safe(words)}</text>`;
  const grid = ticks(y0, y1, 5).flatMap((y) => [
    `<path d="M${LEFT} ${py(y)}H${WIDTH - RIGHT}" stroke="${look.grid}"/>`,
    text(LEFT - 8, py(y) + 4, format(y), 'text-anchor="end"'),
  ]);
  const below = (log ? powers(x0, x1) : ticks(x0, x1, 6)).map((x) =>
    text(px(x), bottom + 18, x.toLocaleString("en"), 'text-anchor="middle"'),
  );
  const curves = lines.flatMap((line) => {
    const color = look.colors[line.color] ?? look.ink;
    const path = pathOf(line.x, line.y, px, py);
    const band = line.low && line.high ? bandOf(line.x, line.low, line.high, px, py) : "";
    return [
      band && `<path d="${band}" fill="${color}" fill-opacity="0.18"/>`,
      `<path d="${path}" fill="none" stroke="${color}" stroke-width="${line.behind ? 1 : 2}" stroke-linejoin="round"${line.behind ? ' stroke-opacity="0.3"' : ""}${line.dashed ? ' stroke-dasharray="6 5"' : ""}/>`,
    ];
  });
  const keys = legend.map((line, index) => {
    const x = LEFT + (index % 3) * ((WIDTH - LEFT - RIGHT) / 3);
    const y = HEIGHT + Math.floor(index / 3) * LINE;
    return `<path d="M${x} ${y - 4}h18" stroke="${look.colors[line.color] ?? look.ink}" stroke-width="3"${line.dashed ? ' stroke-dasharray="5 4"' : ""}/>${text(x + 24, y, line.label)}`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${height}" viewBox="0 0 ${WIDTH} ${height}" font-family="${safe(look.font)}">
<rect width="100%" height="100%" fill="${look.background}"/>
<text x="${LEFT}" y="26" fill="${look.ink}" font-size="15" font-weight="600">${safe(picture.title)}</text>
<clipPath id="area"><rect x="${LEFT}" y="${TOP - 2}" width="${WIDTH - LEFT - RIGHT}" height="${bottom - TOP + 4}"/></clipPath>
${[...grid, ...below].join("\n")}
<g clip-path="url(#area)">${curves.filter(Boolean).join("\n")}</g>
${text((LEFT + WIDTH - RIGHT) / 2, bottom + 38, picture.axis, 'text-anchor="middle"')}
${keys.join("\n")}
</svg>`;
}

type Place = (value: number) => number;

function pathOf(x: number[], y: (number | null)[], px: Place, py: Place): string {
  const points = x.flatMap((at, index) => {
    const value = y[index];
    return value === null || value === undefined ? [] : [`${px(at)} ${py(value)}`];
  });
  if (points.length === 1) return `M${points[0]}h0.01`; // a single point is a dot by its line's round end
  return points.length > 0 ? `M${points.join("L")}` : "";
}

function bandOf(x: number[], low: (number | null)[], high: (number | null)[], px: Place, py: Place): string {
  const ends = x.flatMap((at, index) => {
    const [below, above] = [low[index], high[index]];
    return below == null || above == null ? [] : [{ at: px(at), below: py(below), above: py(above) }];
  });
  if (ends.length < 2) return "";
  const over = ends.map(({ at, above }) => `${at} ${above}`);
  const under = ends.toReversed().map(({ at, below }) => `${at} ${below}`);
  return `M${[...over, ...under].join("L")}Z`;
}
