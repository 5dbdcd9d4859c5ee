// What the agent would do with its other skills, asked for when somebody looks at them: no proposal waits for it.
import { useEffect, useState, useSyncExternalStore } from "react";
import * as http from "./http";
import type { ConsideredList, Overlay } from "./wire";

export type Considered = ConsideredList["items"][number];

/** The one that is looked at, drawn faintly over the views of its proposal. */
interface LookedAt {
  proposalId: number;
  overlays: Record<string, Overlay>;
}

const listeners = new Set<() => void>();
let lookedAt: LookedAt | null = null;

export function lookAt(next: LookedAt | null): void {
  lookedAt = next;
  for (const listener of listeners) listener();
}

function subscribe(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** The overlay of the looked-at choice on one camera's picture of this proposal. */
export function useLookedAt(proposalId: number | null, camera: string): Overlay | null {
  const now = useSyncExternalStore(subscribe, () => lookedAt);
  return now && now.proposalId === proposalId ? (now.overlays[camera] ?? null) : null;
}

/** Asks once for a proposal, as soon as `wanted`; null until then, and where the agent can't tell. */
export function useConsidered(proposalId: number, wanted: boolean): Considered[] | null {
  const [told, setTold] = useState<ConsideredList | null>(null);
  useEffect(() => {
    if (!wanted) return;
    let gone = false;
    http.considered(proposalId).then(
      (list) => {
        if (!gone) setTold(list);
      },
      () => undefined, // then there are the skills and their probabilities, as before
    );
    return () => {
      gone = true;
    };
  }, [proposalId, wanted]);
  return told?.proposal_id === proposalId ? told.items : null;
}
