// What is going on now, in words.
import { isOpen } from "./robots";
import { pendingFor, type TrainerState, wordFor } from "./state";

export interface Activity {
  tone: "you" | "moving" | "busy" | "still" | "stopped";
  text: string;
}

const still = (text: string): Activity => ({ tone: "still", text });
const busy = (text: string): Activity => ({ tone: "busy", text });

/** `drawn`: whether the newest proposal is on the screen with its pictures. */
export function activity(state: TrainerState, drawn: boolean): Activity {
  const { experiment } = state;
  if (!experiment)
    return busy(state.connection === "lost" ? "The service doesn't answer. Trying again." : "Loading");
  if (experiment.halted) return { tone: "stopped", text: "Emergency stop. Nothing moves until you re-arm." };
  const { phase, lifecycle } = experiment;
  // A pause lets a skill that moves end: until then the page may not say that nothing does.
  if (lifecycle !== "running" && phase !== "evaluating" && (state.execution || phase === "executing"))
    return { tone: "moving", text: `Finishing ${state.execution?.skill ?? "the skill"}, then ${lifecycle}` };
  switch (lifecycle) {
    case "created":
      return phase === "evaluating" ? evaluating(state) : still("Not started yet");
    case "paused":
      return phase === "evaluating" ? evaluating(state) : still("Paused. Nothing moves.");
    case "finished":
      return phase === "evaluating" ? evaluating(state) : still("Finished");
    case "failed":
      return { tone: "stopped", text: "Failed. The message at the top says why." };
    case "archived":
      return still("Archived");
    case "running":
      return running(state, drawn);
  }
}

function running(state: TrainerState, drawn: boolean): Activity {
  const { execution, proposal, experiment } = state;
  if (execution) {
    const critic = proposal?.id === execution.proposal_id && proposal.verdict_source === "critic";
    const why = critic ? ", approved by the critic" : "";
    return { tone: "moving", text: `Executing ${execution.skill}${why}, live video` };
  }
  if (experiment?.phase === "evaluating") return evaluating(state);
  if (proposal && isOpen(proposal) && proposal.purpose !== "evaluation") return waiting(state, drawn);
  switch (experiment?.phase) {
    case "starting":
      return busy("Starting the robot and the learner");
    case "learning":
      return busy("Learning from your feedback");
    case "deciding":
      return busy("Checking whether it may move");
    case "executing":
      return { tone: "moving", text: "Executing, live video" };
    case "observing":
      return busy("Looking at the scene");
    default:
      return busy("Thinking of a proposal");
  }
}

function waiting(state: TrainerState, drawn: boolean): Activity {
  if (state.experiment?.teacher) return busy(`The ${state.experiment.teacher} teacher is judging`);
  const pending = state.proposal ? pendingFor(state, state.proposal.id) : null;
  if (!drawn) return busy("Loading the pictures");
  if (pending === null) return { tone: "you", text: "Waiting for you" };
  return busy(
    state.connection === "open"
      ? `Sending “${wordFor(pending)}”`
      : `“${wordFor(pending)}” is kept until the connection is back`,
  );
}

function evaluating(state: TrainerState): Activity {
  const rollouts = state.evaluation?.rollouts;
  return busy(rollouts ? `Evaluating: ${state.evaluationDone} of ${rollouts} rollouts` : "Evaluating");
}
