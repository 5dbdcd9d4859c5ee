// Keeps a trainer's pace, and proposes a rest when one is due.
import { useEffect, useEffectEvent, useState } from "react";
import { t } from "./i18n";
import { clicked, FRESH, type Pace, restDue } from "./pace";

export function usePace(
  restAfter: number,
  notify: (text: string) => void,
): { pace: Pace; click: () => void } {
  const [pace, setPace] = useState(FRESH);
  const last = pace.clicks.at(-1);
  const propose = useEffectEvent(() => {
    const now = Date.now();
    if (!restDue(pace, now, restAfter)) return;
    setPace((before) => ({ ...before, proposed: now }));
    notify(t("pace.rest", { count: restAfter }));
  });
  // It is proposed after a click, never in the middle of looking.
  useEffect(() => {
    if (last !== undefined) propose();
  }, [last]);
  return { pace, click: () => setPace((before) => clicked(before, Date.now())) };
}
