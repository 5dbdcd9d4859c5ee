// What the service computes on demand, asked for again whenever `key` changes, but not more often than is worth drawing.
import { useEffect, useEffectEvent, useRef, useState } from "react";

const LEAST_MS = 1000;

export function useLatest<T>(ask: () => Promise<T>, key: string): T | null {
  const [value, setValue] = useState<T | null>(null);
  const asked = useRef(Number.NEGATIVE_INFINITY);
  const shown = useRef(Number.NEGATIVE_INFINITY);
  const fetchIt = useEffectEvent(() => {
    const at = performance.now();
    asked.current = at;
    ask().then(
      (answer) => {
        if (at < shown.current) return; // a later question was answered first
        shown.current = at;
        setValue(answer);
      },
      () => undefined, // what is shown stays until the next change
    );
  });
  // biome-ignore lint/correctness/useExhaustiveDependencies: the key stands for everything that `ask` depends on
  useEffect(() => {
    const timer = setTimeout(fetchIt, Math.max(0, asked.current + LEAST_MS - performance.now()));
    return () => clearTimeout(timer);
  }, [key]);
  return value;
}
