// What is going on now, in words.
import { skillName, t } from "./i18n";
import { whole } from "./i18n/numbers";
import { ME, may } from "./me";
import { isOpen } from "./robots";
import { chosenFor, pendingFor, wordFor } from "./selectors";
import type { TrainerState } from "./state";
import type { Experiment } from "./wire";

export interface Activity {
  tone: "you" | "moving" | "busy" | "still" | "stopped";
  text: string;
}

const still = (text: string): Activity => ({ tone: "still", text });
const busy = (text: string): Activity => ({ tone: "busy", text });

/** `drawn`: whether the newest proposal is on the screen with its pictures. */
export function activity(state: TrainerState, drawn: boolean): Activity {
  const { experiment } = state;
  if (!experiment) return busy(state.connection === "lost" ? t("activity.noAnswer") : t("activity.loading"));
  if (experiment.halted) return { tone: "stopped", text: t("activity.halted") };
  const { phase, lifecycle } = experiment;
  // A pause lets a skill that moves end: until then the page may not say that nothing does.
  if (lifecycle !== "running" && phase !== "evaluating" && (state.execution || phase === "executing"))
    return {
      tone: "moving",
      text: t("activity.finishing", {
        skill: state.execution ? skillName(state.execution.skill) : t("activity.theSkill"),
        lifecycle: t(`lifecycle.${lifecycle}`),
      }),
    };
  switch (lifecycle) {
    case "created":
      return phase === "evaluating" ? evaluating(state) : still(t("activity.notStarted"));
    case "paused":
      return phase === "evaluating" ? evaluating(state) : still(t("activity.paused"));
    case "finished":
      return phase === "evaluating" ? evaluating(state) : still(t("activity.finished"));
    case "failed":
      return { tone: "stopped", text: t("activity.failed") };
    case "archived":
      return still(t("activity.archived"));
    case "running":
      return running(state, drawn);
  }
}

function running(state: TrainerState, drawn: boolean): Activity {
  const { execution, proposal, experiment } = state;
  if (state.finishing && proposal && chosenFor(state, proposal.id) === null)
    return { tone: "you", text: t("activity.finishIt") };
  if (execution) {
    const critic = proposal?.id === execution.proposal_id && proposal.verdict_source === "critic";
    const skill = skillName(execution.skill);
    return {
      tone: "moving",
      text: critic ? t("activity.executingByCritic", { skill }) : t("activity.executingSkill", { skill }),
    };
  }
  if (experiment?.phase === "evaluating") return evaluating(state);
  if (proposal && isOpen(proposal) && proposal.purpose !== "evaluation") return waiting(state, drawn);
  switch (experiment?.phase) {
    case "starting":
      return busy(catchingUp(experiment.catching_up) ?? t("activity.starting"));
    case "learning":
      return busy(t("activity.learning"));
    case "deciding":
      return busy(t("activity.deciding"));
    case "executing":
      return { tone: "moving", text: t("activity.executing") };
    case "observing":
      return busy(t("activity.observing"));
    default:
      return busy(t("activity.busy"));
  }
}

/** How far a learner that has started anew is with many stored labels; null where it has them all. */
export function catchingUp(progress: Experiment["catching_up"]): string | null {
  return progress ? t("activity.catchingUp", { taken: whole(progress.taken), of: whole(progress.of) }) : null;
}

function waiting(state: TrainerState, drawn: boolean): Activity {
  if (state.experiment?.teacher) return busy(t("activity.teacher", { teacher: state.experiment.teacher }));
  const pending = state.proposal ? pendingFor(state, state.proposal.id) : null;
  if (!drawn) return busy(t("activity.pictures"));
  if (pending === null) return asking(state);
  const word = wordFor(pending);
  return busy(state.connection === "open" ? t("activity.sending", { word }) : t("activity.kept", { word }));
}

/** The open proposal is on the screen: whether it waits for this trainer, or for others. */
function asking(state: TrainerState): Activity {
  const { proposal } = state;
  if (!may("trainer")) return busy(t("people.onlyLooks"));
  if (proposal && (proposal.heard.includes(ME) || chosenFor(state, proposal.id) !== null))
    return busy(t("activity.others"));
  return state.asks === "no" ? busy(t("activity.notYours")) : { tone: "you", text: t("activity.you") };
}

function evaluating(state: TrainerState): Activity {
  const rollouts = state.evaluation?.rollouts;
  return busy(
    rollouts
      ? t("activity.evaluatingCount", { done: state.evaluationDone, rollouts })
      : t("activity.evaluating"),
  );
}
