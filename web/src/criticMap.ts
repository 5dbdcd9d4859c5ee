// The critic's map as a picture from above: metres to pixels, and a value's colour.
import type { CriticMap, SceneInfo } from "./wire";

export interface Frame {
  width: number;
  height: number;
  px: (x: number) => number;
  py: (y: number) => number;
  cell: [number, number];
}

const EDGE = { left: 58, right: 12, top: 12, bottom: 40 };
const WIDE = 520;

function ends(values: number[]): [number, number, number] {
  const low = values[0] ?? 0;
  const high = values.at(-1) ?? 1;
  return [low, high, values.length > 1 ? (high - low) / (values.length - 1) : 1];
}

/** x to the right, y upwards, both equally long for a metre. */
export function frameOf({ x, y }: Pick<CriticMap, "x" | "y">): Frame {
  const [x0, x1, dx] = ends(x);
  const [y0, y1, dy] = ends(y);
  const scale = (WIDE - EDGE.left - EDGE.right) / (x1 - x0 + dx);
  const height = EDGE.top + EDGE.bottom + (y1 - y0 + dy) * scale;
  return {
    width: WIDE,
    height,
    px: (at) => EDGE.left + (at - x0 + dx / 2) * scale,
    py: (at) => EDGE.top + (y1 + dy / 2 - at) * scale,
    cell: [dx * scale, dy * scale],
  };
}

/** How strongly a value speaks, from −1 to 1: beyond what a label can be there is nothing more to see. */
export const strength = (value: number): number => Math.max(-1, Math.min(1, value));

/** As CSS mixes it: bad and good are orange and blue, which everybody tells apart. */
export function colorOf(value: number): string {
  const share = Math.round(100 * Math.abs(strength(value)));
  return `color-mix(in oklab, var(${value < 0 ? "--map-bad" : "--map-good"}) ${share}%, var(--map-neutral))`;
}

export interface Thing {
  name: string;
  x: number;
  y: number;
}

/** The scene's objects where this state has them; those that it doesn't tell of, where they stand. */
export function thingsIn(scene: SceneInfo | null, state: number[]): Thing[] {
  return (scene?.objects ?? []).flatMap(({ name, state_at, fixed }) => {
    const [x, y] = state_at === null ? (fixed ?? []) : state.slice(state_at, state_at + 2);
    return x === undefined || y === undefined ? [] : [{ name, x, y }];
  });
}

/** The nearest cell's value. */
export function valueAt(map: CriticMap, x: number, y: number): number | null {
  const column = Math.round((x - ends(map.x)[0]) / ends(map.x)[2]);
  const row = Math.round((y - ends(map.y)[0]) / ends(map.y)[2]);
  return map.values[row]?.[column] ?? null;
}
