// Zooming and panning a picture: where it lies in its frame. Pure; the gestures are in useZoom.ts.

export interface Zoom {
  scale: number;
  /** How far the picture's top left corner is from the frame's, as shares of the frame's width and height. */
  x: number;
  y: number;
}

export const WHOLE: Zoom = { scale: 1, x: 0, y: 0 };
const MOST = 8;

/** The picture always covers its frame. */
function within({ scale, x, y }: Zoom): Zoom {
  const bounded = (at: number) => Math.min(0, Math.max(1 - scale, at));
  return { scale, x: bounded(x), y: bounded(y) };
}

/** Nearer or farther by a factor, so that what is at (px, py), shares of the frame, stays there. */
export function zoomAt(zoom: Zoom, factor: number, px = 0.5, py = 0.5): Zoom {
  const scale = Math.min(MOST, Math.max(1, zoom.scale * factor));
  const by = scale / zoom.scale;
  return within({ scale, x: px - (px - zoom.x) * by, y: py - (py - zoom.y) * by });
}

export function pan(zoom: Zoom, dx: number, dy: number): Zoom {
  return within({ ...zoom, x: zoom.x + dx, y: zoom.y + dy });
}

/** A point of a picture, as shares of its width and height. */
export type Share = readonly [x: number, y: number];

/** How near to the frame's edge, as a share of it, a mark is half hidden. */
const EDGE = 0.03;

/** Whether these points are in the frame, those left out that aren't in the picture itself. */
function inSight({ scale, x, y }: Zoom, points: readonly Share[]): boolean {
  const within = (at: number, edge: number) => at >= edge && at <= 1 - edge;
  return points
    .filter(([px, py]) => within(px, 0) && within(py, 0))
    .every(([px, py]) => within(x + px * scale, EDGE) && within(y + py * scale, EDGE));
}

/** How a picture is zoomed, and how it was chosen to be: `kept` for as long as that would hide what is to be judged. */
export interface Zoomed {
  zoom: Zoom;
  kept: Zoom | null;
}

/** For a new proposal with marks at `points`: as chosen, or the whole picture where the marks would be out of sight. */
export function forProposal({ zoom, kept }: Zoomed, points: readonly Share[]): Zoomed {
  const chosen = kept ?? zoom;
  return chosen.scale === 1 || inSight(chosen, points)
    ? { zoom: chosen, kept: null }
    : { zoom: WHOLE, kept: chosen };
}

export type Swipe = "left" | "right" | "up";

const LEAST_PX = 60;

/** The direction of a stroke that was meant as one: long enough, and not askew. */
export function swipeOf(dx: number, dy: number): Swipe | null {
  if (Math.abs(dx) > LEAST_PX && Math.abs(dx) > 1.6 * Math.abs(dy)) return dx > 0 ? "right" : "left";
  return dy < -LEAST_PX && -dy > 1.6 * Math.abs(dx) ? "up" : null;
}
