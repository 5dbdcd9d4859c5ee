// Zooming keeps what is pointed at in its place, and strokes of a finger mean what they look like.
import { describe, expect, it } from "vitest";
import { pan, swipeOf, WHOLE, zoomAt } from "../src/zoom";

describe("zoom", () => {
  it("keeps the point under the pointer where it is", () => {
    const zoom = zoomAt(WHOLE, 2, 0.25, 0.75);
    expect(zoom.scale).toBe(2);
    expect(zoom.x + 0.25 * zoom.scale).toBeCloseTo(0.25);
    expect(zoom.y + 0.75 * zoom.scale).toBeCloseTo(0.75);
  });

  it("never shows anything but the picture", () => {
    expect(pan(zoomAt(WHOLE, 2, 0.5, 0.5), 9, 9)).toEqual({ scale: 2, x: 0, y: 0 });
    expect(pan(zoomAt(WHOLE, 2, 0.5, 0.5), -9, -9)).toEqual({ scale: 2, x: -1, y: -1 });
    expect(pan(WHOLE, 0.3, 0.3)).toEqual(WHOLE);
    expect(zoomAt(WHOLE, 0.1)).toEqual(WHOLE);
    expect(zoomAt(WHOLE, 1000).scale).toBe(8);
  });
});

describe("a stroke", () => {
  it("goes right, left or up", () => {
    expect([swipeOf(90, 10), swipeOf(-90, 10), swipeOf(10, -90)]).toEqual(["right", "left", "up"]);
  });

  it("that is short, askew or downwards means nothing", () => {
    expect([swipeOf(40, 0), swipeOf(90, 80), swipeOf(0, 90), swipeOf(-70, -70)]).toEqual(Array(4).fill(null));
  });
});
