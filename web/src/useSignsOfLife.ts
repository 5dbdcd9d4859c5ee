// Tells that somebody is at the page: while they move the mouse, touch, type, or come back to it.
import { useEffect } from "react";

const SIGNS = ["pointermove", "pointerdown", "keydown", "wheel", "touchstart"] as const;

/** `tell` must stay the same function between renders, and may be called at any rate. */
export function useSignsOfLife(tell: () => void): void {
  useEffect(() => {
    const shown = () => {
      if (document.visibilityState === "visible") tell();
    };
    for (const sign of SIGNS) window.addEventListener(sign, tell, { passive: true });
    document.addEventListener("visibilitychange", shown);
    return () => {
      for (const sign of SIGNS) window.removeEventListener(sign, tell);
      document.removeEventListener("visibilitychange", shown);
    };
  }, [tell]);
}
