// An episode as a row of moments: proposed, judged, and executed where it ran; stepped through from the database alone.
import type { HistoryEntry } from "./wire";

export const STAGES = ["proposed", "judged", "executed"] as const;
export type Stage = (typeof STAGES)[number];

export interface Moment {
  entry: HistoryEntry;
  stage: Stage;
  /** What the cameras saw afterwards, as far as the next proposal was drawn on it. */
  after: HistoryEntry | null;
}

/** In their order; a robot's next proposal shows what its last motion did. */
export function momentsOf(entries: HistoryEntry[]): Moment[] {
  return entries.flatMap((entry, index) => {
    const stages: Stage[] = entry.execution ? [...STAGES] : ["proposed", "judged"];
    const after = entries[index + 1] ?? null;
    return stages.map((stage) => ({ entry, stage, after: stage === "executed" ? after : null }));
  });
}

/** Where a proposal's first moment is; 0 where it isn't in the episode. */
export function momentOf(moments: Moment[], proposalNumber: number): number {
  return Math.max(
    0,
    moments.findIndex(({ entry }) => entry.proposal.number === proposalNumber),
  );
}
