// When the drawn proposal appeared: how long it was there before a press, and the time from a click until it came.
import { useLayoutEffect, useRef } from "react";
import { announce } from "./cues";

export interface DrawnClock {
  /** How long (ms) what is drawn now had been there at `time` (ms, as in `Event.timeStamp`); negative before it. */
  age: (time: number) => number;
  clicked: (time: number) => void;
}

/** Marks `seed:click`, and measures `seed:click-to-drawn` once the next proposal is painted. */
export function useDrawnAt(drawnId: number | null): DrawnClock {
  const drawnAt = useRef(Number.POSITIVE_INFINITY);
  const clickedAt = useRef<number | null>(null);
  useLayoutEffect(() => {
    if (drawnId === null) {
      drawnAt.current = Number.POSITIVE_INFINITY;
      return;
    }
    drawnAt.current = performance.now();
    performance.mark("seed:drawn", { detail: { proposal: drawnId } });
    announce();
    const start = clickedAt.current;
    clickedAt.current = null;
    if (start === null) return;
    // The frame that holds it is painted right after this callback.
    const frame = requestAnimationFrame(() =>
      performance.measure("seed:click-to-drawn", {
        start,
        end: performance.now(),
        detail: { proposal: drawnId },
      }),
    );
    return () => cancelAnimationFrame(frame);
  }, [drawnId]);
  return {
    age: (time) => time - drawnAt.current,
    clicked: (time) => {
      clickedAt.current = time;
      performance.mark("seed:click", { startTime: time });
    },
  };
}
