// A value that is taken over once it has stayed the same for a moment: a slider asks once, not at every pixel.
import { useEffect, useState } from "react";

const MOMENT_MS = 150;

export function useDelayed<T>(value: T, moment = MOMENT_MS): T {
  const [kept, setKept] = useState(value);
  useEffect(() => {
    const timer = setTimeout(() => setKept(value), moment);
    return () => clearTimeout(timer);
  }, [value, moment]);
  return kept;
}
