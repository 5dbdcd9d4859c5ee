// Something of the service that changes by itself: asked for again and again while the page is looked at.
import { useCallback, useEffect, useState } from "react";
import * as http from "./http";
import type { Problem } from "./wire";

export interface Polled<T> {
  /** The newest answer; it stays while a later request fails. */
  value: T | null;
  problem: Problem | null;
  refresh: () => void;
}

/** `ask` must stay the same function between renders. */
export function usePolled<T>(ask: () => Promise<T>, everyMs: number): Polled<T> {
  const [value, setValue] = useState<T | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const load = useCallback(async () => {
    try {
      setValue(await ask());
      setProblem(null);
    } catch (error) {
      setProblem(http.problemOf(error));
    }
  }, [ask]);
  useEffect(() => {
    const tick = () => {
      if (document.visibilityState === "visible") void load();
    };
    void load();
    const timer = setInterval(tick, everyMs);
    document.addEventListener("visibilitychange", tick);
    return () => {
      clearInterval(timer);
      document.removeEventListener("visibilitychange", tick);
    };
  }, [load, everyMs]);
  return { value, problem, refresh: () => void load() };
}
