// The newest proposals with what one said of them and what came of it. Pure; kept by the reducer, fed by the stream.
import type { Execution, Feedback, Proposal, StreamEvent } from "./wire";

export const KEPT = 50;

interface Parts {
  proposal: Proposal;
  /** One's own click, as it counts now. */
  own: Feedback | null;
  execution: Execution | null;
}

export interface Entry extends Parts {
  /** What was heard of it since the newest snapshot; anything else may have changed while nothing was heard. */
  heard: readonly (keyof Parts)[];
}

/** Newest first. */
export type History = Entry[];

export type Filter = "all" | "good" | "bad" | "executed" | "violation";
export const FILTERS: Filter[] = ["all", "good", "bad", "executed", "violation"];

const PASSES: Record<Filter, (entry: Entry) => boolean> = {
  all: () => true,
  good: ({ own }) => own?.label === 1,
  bad: ({ own }) => own?.label === -1,
  executed: ({ execution }) => execution !== null,
  violation: ({ execution }) => (execution?.violations.length ?? 0) > 0,
};

/** Whether it is learned from: it wasn't taken back, and came in time, or while its trainer could finish. */
export function counts({ undone_at, status }: Feedback): boolean {
  return !undone_at && (status === "stored" || status === "overtaken");
}

/** A robot's newest motion that has ended. */
export function lastMotion(history: History, robot: number): Entry | null {
  return history.find(({ execution }) => execution?.robot === robot && execution.outcome !== null) ?? null;
}

export const shown = (history: History, filter: Filter): History => history.filter(PASSES[filter]);

/** What REST told since the newest snapshot, under what the stream has told meanwhile. */
export function loaded(
  history: History,
  proposals: Proposal[],
  feedback: Feedback[],
  executions: Execution[],
  me: string,
): History {
  const own = new Map(
    feedback.filter((each) => each.trainer === me && counts(each)).map((each) => [each.proposal_id, each]),
  );
  const ran = new Map(executions.map((each) => [each.proposal_id, each]));
  const known = new Map(history.map((entry) => [entry.proposal.id, entry]));
  const training = proposals.filter(({ purpose }) => purpose === "training");
  const told = training.map((proposal): Entry => {
    const entry = known.get(proposal.id);
    const heard = entry?.heard ?? [];
    const execution = ran.get(proposal.id) ?? entry?.execution ?? null; // none is ever taken back
    const rest = { proposal, own: own.get(proposal.id) ?? null, execution, heard };
    return { ...rest, ...Object.fromEntries(heard.map((part) => [part, entry?.[part]])) };
  });
  const newest = new Map([...history, ...told].map((entry) => [entry.proposal.id, entry]));
  return newestFirst([...newest.values()]);
}

export function remember(history: History, event: StreamEvent, me: string): History {
  switch (event.type) {
    case "snapshot":
      return event.proposals.reduce(
        withProposal,
        history.map((entry) => ({ ...entry, heard: [] })),
      );
    case "proposal_opened":
    case "proposal_closed":
      return withProposal(history, event.proposal);
    case "feedback_stored":
    case "feedback_relabelled":
      return event.feedback.trainer === me ? withOwn(history, event.feedback) : history;
    case "acknowledged":
      return event.feedback ? withOwn(history, event.feedback) : history;
    case "feedback_undone":
      return event.feedback.trainer === me
        ? with_(history, event.feedback.proposal_id, { own: null })
        : history;
    case "execution_started":
    case "execution_ended":
      return withExecution(history, event.execution);
    default:
      return history;
  }
}

function withProposal(history: History, proposal: Proposal): History {
  if (proposal.purpose !== "training") return history;
  if (history.some((entry) => entry.proposal.id === proposal.id))
    return with_(history, proposal.id, { proposal });
  return newestFirst([{ proposal, own: null, execution: null, heard: ["proposal"] }, ...history]);
}

function newestFirst(entries: Entry[]): History {
  return entries.sort((one, other) => other.proposal.id - one.proposal.id).slice(0, KEPT);
}

/** One that was taken back, or came too late, is none. */
export function withOwn(history: History, feedback: Feedback): History {
  return with_(history, feedback.proposal_id, { own: counts(feedback) ? feedback : null });
}

export function withExecution(history: History, execution: Execution): History {
  return with_(history, execution.proposal_id, { execution });
}

function with_(history: History, proposalId: number, change: Partial<Parts>): History {
  const at = history.findIndex(({ proposal }) => proposal.id === proposalId);
  const entry = history[at];
  if (!entry) return history;
  const heard = [...new Set([...entry.heard, ...(Object.keys(change) as (keyof Parts)[])])];
  return [...history.slice(0, at), { ...entry, ...change, heard }, ...history.slice(at + 1)];
}
