// Zooming keeps what is pointed at in its place, and strokes of a finger mean what they look like.
import { describe, expect, it } from "vitest";
import { forProposal, pan, swipeOf, WHOLE, zoomAt } from "../src/zoom";

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

describe("a new proposal", () => {
  const corner = zoomAt(WHOLE, 4, 0, 0); // the left upper quarter of either side
  const chosen = { zoom: corner, kept: null };
  const away = { zoom: WHOLE, kept: corner };

  it("is shown as its picture was zoomed, if it is in sight there", () => {
    expect(forProposal(chosen, [[0.1, 0.2]])).toEqual(chosen);
    expect(forProposal(chosen, [])).toEqual(chosen); // letting go happens nowhere
    expect(
      forProposal(chosen, [
        [0.1, 0.1],
        [1.4, 0.1],
      ]),
    ).toEqual(chosen); // the whole picture hasn't that either
  });

  it("is shown on the whole picture otherwise, and the next one as chosen again", () => {
    expect(forProposal(chosen, [[0.5, 0.2]])).toEqual(away);
    expect(
      forProposal(chosen, [
        [0.1, 0.2],
        [0.1, 0.3],
      ]),
    ).toEqual(away);
    expect(forProposal(chosen, [[0.249, 0.1]])).toEqual(away); // on the very edge
    expect(forProposal(away, [[0.6, 0.6]])).toEqual(away);
    expect(forProposal(away, [[0.1, 0.1]])).toEqual(chosen);
  });

  it("changes nothing where nothing is zoomed", () => {
    const whole = { zoom: WHOLE, kept: null };
    expect(forProposal(whole, [[0.001, 1]])).toEqual(whole);
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
