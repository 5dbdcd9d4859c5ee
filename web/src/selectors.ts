// What the page asks of its state. Pure.
import { t } from "./i18n";
import { isOpen } from "./robots";
import type { TrainerState } from "./state";
import type { Experiment, Value } from "./wire";

/** The click made for a proposal and not acknowledged yet. */
export function pendingFor(state: TrainerState, proposalId: number): Value | null {
  return state.pending.find((click) => click.proposal_id === proposalId)?.value ?? null;
}

/** What this page said about a proposal, acknowledged or not. */
export function chosenFor(state: TrainerState, proposalId: number): Value | null {
  return pendingFor(state, proposalId) ?? state.judged[proposalId] ?? null;
}

/** Whether a click now may judge the proposal that is drawn on the screen. */
export function judgeable(state: TrainerState, drawnId: number | null): boolean {
  const { proposal, experiment } = state;
  return (
    proposal !== null &&
    experiment !== null &&
    isOpen(proposal) &&
    proposal.id === drawnId &&
    proposal.purpose !== "evaluation" &&
    !experiment.teacher &&
    experiment.lifecycle === "running" &&
    !experiment.halted &&
    state.asks !== "no" &&
    chosenFor(state, proposal.id) === null
  );
}

/** Whether the overlay says something true about what happens next. */
export function overlayWanted(state: TrainerState): boolean {
  const { proposal, experiment } = state;
  if (!proposal || state.live !== null) return false;
  return isOpen(proposal) || (proposal.close_reason === "judged" && experiment?.lifecycle === "running");
}

/** As the service rules: undo is for an experiment that runs, on the scene that was judged. */
export function canStillUndo(experiment: Experiment | null): boolean {
  if (experiment?.lifecycle !== "running" || experiment.halted) return false;
  if (experiment.num_envs > 1) return true; // the phase says nothing of a single robot
  return experiment.phase !== "starting" && experiment.phase !== "observing";
}

export function wordFor(value: Value): string {
  if (value === "cant_tell") return t("judge.word.cantTell");
  return t(value > 0 ? "judge.word.good" : value < 0 ? "judge.word.bad" : "judge.word.neutral");
}
