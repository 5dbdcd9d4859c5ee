// A trainer's own pace in this tab: labels a minute, the run without a pause, and when a rest is due.

/** Times are ms, as in `Date.now()`. */
export interface Pace {
  /** Of the newest clicks, oldest first. */
  clicks: number[];
  /** The first click since the last rest. */
  since: number | null;
  /** Clicks since the last pause of a minute or more. */
  streak: number;
  /** When a rest was proposed last. */
  proposed: number | null;
}

export const FRESH: Pace = { clicks: [], since: null, streak: 0, proposed: null };

const MINUTE = 60_000;
const WINDOW = 5 * MINUTE;
/** Nobody who came back after this long needs to be told to rest. */
const REST = 3 * MINUTE;

export function clicked(pace: Pace, at: number): Pace {
  const last = pace.clicks.at(-1);
  const paused = last === undefined || at - last > MINUTE;
  const rested = last === undefined || at - last > REST;
  return {
    clicks: [...pace.clicks.filter((time) => at - time < WINDOW), at],
    since: rested ? at : pace.since,
    streak: paused ? 1 : pace.streak + 1,
    proposed: rested ? null : pace.proposed,
  };
}

/** Over the last five minutes, or as long as there was something to judge in them; null before there is a rate. */
export function perMinute({ clicks }: Pace, now: number): number | null {
  const recent = clicks.filter((time) => now - time < WINDOW);
  const [first] = recent;
  if (first === undefined || recent.length < 3) return null;
  return (recent.length - 1) / Math.max((now - first) / MINUTE, 1 / 60);
}

/** Whether to propose a rest now, once for every `after` minutes of judging; 0 minutes: never. */
export function restDue({ since, proposed }: Pace, now: number, after: number): boolean {
  return after > 0 && since !== null && now - (proposed ?? since) >= after * MINUTE;
}
