// What moves and zooms a picture, and what doesn't.
import { act, useRef } from "react";
import { describe, expect, it } from "vitest";
import { useZoom } from "../src/useZoom";
import { byTestId, press, show } from "./render";

function View() {
  const frame = useRef<HTMLElement>(null);
  const { zoom, nearer } = useZoom(frame, null);
  return (
    <figure ref={frame} data-testid="view" data-zoom={JSON.stringify(zoom)}>
      <button type="button" data-testid="nearer" onClick={nearer} />
    </figure>
  );
}

const zoom = () => JSON.parse(byTestId("view").dataset.zoom ?? "{}");

/** A view 400 px wide and 300 px high. */
async function opened(): Promise<void> {
  await show(<View />);
  byTestId("view").getBoundingClientRect = () => new DOMRect(0, 0, 400, 300);
  byTestId("view").setPointerCapture = () => undefined;
}

const nearer = () => act(async () => byTestId("nearer").click());

const point = (type: string, clientX: number, more: PointerEventInit = {}) =>
  act(async () => {
    const where = { clientX, clientY: 150, pointerId: 1, pointerType: "mouse", buttons: 1, bubbles: true };
    byTestId("view").dispatchEvent(new PointerEvent(type, { ...where, ...more }));
  });

describe("a picture", () => {
  it("follows the mouse only while its button is held, also where that was let go outside", async () => {
    await opened();
    await point("pointerdown", 200); // nothing is zoomed, so the view doesn't hear of it when it is lifted elsewhere
    await nearer();
    const before = zoom();
    await point("pointermove", 260, { buttons: 0 });
    expect(zoom()).toEqual(before);
    const finger = { pointerId: 2, pointerType: "touch" };
    await point("pointerdown", 100, finger);
    await point("pointermove", 120, finger);
    expect(zoom().scale).toBe(before.scale); // one finger pans; a second one would zoom
    expect(zoom().x).toBeCloseTo(before.x + 20 / 400);
    await point("pointerup", 120, finger);
    await point("pointerdown", 200);
    await point("pointermove", 180);
    expect(zoom().x).toBeCloseTo(before.x);
  });

  it("is zoomed by + and -, and leaves the browser its own zoom", async () => {
    await opened();
    await press("+", {}, byTestId("view"));
    const { scale } = zoom();
    expect(scale).toBeGreaterThan(1);
    for (const held of ["ctrlKey", "metaKey", "altKey"])
      for (const key of ["+", "-", "0"]) await press(key, { [held]: true }, byTestId("view"));
    expect(zoom().scale).toBe(scale);
    await press("0", {}, byTestId("view"));
    expect(zoom().scale).toBe(1);
  });
});
