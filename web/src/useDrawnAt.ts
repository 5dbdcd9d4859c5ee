// When the drawn proposal appeared: presses from before it don't count, and the time since the click is measured.
import { useLayoutEffect, useRef } from "react";

export interface DrawnClock {
  /** Whether something pressed at `time` (ms, as in `Event.timeStamp`) could have seen what is drawn now. */
  sawIt: (time: number) => boolean;
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
    sawIt: (time) => time >= drawnAt.current,
    clicked: (time) => {
      clickedAt.current = time;
      performance.mark("seed:click", { startTime: time });
    },
  };
}
