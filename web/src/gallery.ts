// What the gallery shows, as its address says it; and what a proposal's label adds up to in one word.
import { labelKey } from "./components/History";
import { counts } from "./history";
import type { HistoryEntry } from "./wire";

export const CHOICES = {
  verdict: ["good", "neutral", "bad", "none"],
  label: ["good", "neutral", "bad", "cant_tell"],
  executed: ["true", "false"],
  violation: ["true", "false"],
  purpose: ["training", "evaluation"],
} as const;
export type Choice = keyof typeof CHOICES;

/** What of an address narrows the gallery; values that there aren't are left out. */
export function narrowedIn(search: string): URLSearchParams {
  const narrowed = new URLSearchParams();
  for (const [key, value] of new URLSearchParams(search)) {
    const values: readonly string[] | undefined = CHOICES[key as Choice];
    if (values?.includes(value) || (key === "skill" && value)) narrowed.set(key, value);
  }
  return narrowed;
}

/** What was said of it by now, by whoever clicked last and counts; nobody judges an evaluation's proposals. */
export function labelOf({ proposal, feedback }: HistoryEntry): ReturnType<typeof labelKey> {
  if (proposal.purpose === "evaluation") return "none";
  const counted = feedback.filter(counts);
  return labelKey(counted.at(-1)?.label);
}

export const stepPath = (id: number, { proposal }: HistoryEntry): string =>
  `/experiments/${id}/episodes/${proposal.episode}?proposal=${proposal.number}`;
