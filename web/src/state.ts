// All a trainer's page knows, in one reducer fed by the stream. Pure; the effects are in session.ts.

import { addMetric, addPoint, type CurvePoint } from "./curve";
import { type History, loaded, remember, withExecution, withOwn } from "./history";
import { skillName, t } from "./i18n";
import { inOneLine, said } from "./i18n/said";
import { ME } from "./me";
import { type Click, comesAgain } from "./outbox";
import { isOpen, type Judged, type RobotState, STILL, saying, shownRobot } from "./robots";
import { canStillUndo, wordFor } from "./selectors";
import type { Connection } from "./stream";
import { mayFinish, overtaken, showing } from "./together";
import type {
  Evaluation,
  Execution,
  Experiment,
  Feedback,
  Judge,
  MetricPoint,
  Problem,
  Proposal,
  StreamEvent,
} from "./wire";

export interface Notice {
  id: number;
  tone: "info" | "good" | "warning" | "error";
  text: string;
}

export interface TrainerState {
  connection: Connection;
  /** True once a snapshot came. */
  ready: boolean;
  bootId: string | null;
  experiment: Experiment | null;
  /** Every open proposal, in the order they opened. */
  opened: Proposal[];
  /** Who is there to judge, and at which proposal. */
  judges: Judge[];
  robots: RobotState[];
  /** The robot that someone wants to see; null: whichever is to be judged, or moves. */
  chosen: number | null;
  /** The robot that is shown, and what is known of it. */
  shown: number;
  proposal: Proposal | null;
  execution: Execution | null;
  live: number | null;
  asks: RobotState["asks"];
  finishing: RobotState["finishing"];
  undoable: Feedback | null;
  /** The robot whose motion ends that; null: any may. */
  undoableOn: number | null;
  /** Clicks that aren't acknowledged yet. */
  pending: Click[];
  /** The acknowledged clicks on the robots' newest proposals. */
  judged: Judged;
  history: History;
  /** Of this connection; 0 before there is one. */
  newestIncident: number;
  curve: CurvePoint[];
  evaluation: Evaluation | null;
  evaluationDone: number;
  /** Emergency stop asked for and not confirmed; `unreachable` once an attempt failed. */
  stopping: "no" | "asked" | "unreachable";
  notices: Notice[];
  nextNotice: number;
  /** Why the page can't be shown at all. */
  fatal: Problem | null;
}

export type Action =
  | { kind: "event"; event: StreamEvent }
  | { kind: "connection"; connection: Connection }
  | { kind: "pending"; clicks: Click[] }
  | { kind: "experiment"; experiment: Experiment }
  | { kind: "metrics"; points: MetricPoint[] }
  | { kind: "evaluation"; evaluation: Evaluation | null }
  | { kind: "past"; proposals: Proposal[]; feedback: Feedback[]; executions: Execution[] }
  | { kind: "relabelled"; feedback: Feedback }
  | { kind: "reported"; execution: Execution }
  | { kind: "backdrop"; proposal: Proposal | null }
  | { kind: "watch"; robot: number | null }
  | { kind: "stopping"; stopping: TrainerState["stopping"] }
  | { kind: "notice"; tone: Notice["tone"]; text: string }
  | { kind: "dismiss"; id: number }
  | { kind: "fatal"; problem: Problem };

export const initial: TrainerState = {
  connection: "connecting",
  ready: false,
  bootId: null,
  experiment: null,
  opened: [],
  judges: [],
  robots: [STILL],
  chosen: null,
  shown: 0,
  proposal: null,
  execution: null,
  live: null,
  asks: "no",
  finishing: null,
  undoable: null,
  undoableOn: null,
  pending: [],
  judged: {},
  history: [],
  newestIncident: 0,
  curve: [],
  evaluation: null,
  evaluationDone: 0,
  stopping: "no",
  notices: [],
  nextNotice: 1,
  fatal: null,
};

export function reduce(state: TrainerState, action: Action): TrainerState {
  const changed = step(state, action);
  if (changed === state) return state;
  const { opened, judges, experiment } = changed;
  const next = { ...changed, robots: showing(changed.robots, opened, judges, experiment) };
  const shown = shownRobot(next.robots, next.chosen, next.shown, !next.experiment?.teacher, next.judged);
  const robot = next.robots[shown] ?? STILL;
  // The video of another one's motion must not cover what is still to be judged.
  return { ...next, shown, ...robot, live: robot.finishing ? null : robot.live };
}

function step(state: TrainerState, action: Action): TrainerState {
  switch (action.kind) {
    case "event": {
      const next = onEvent(state, action.event);
      const history = remember(next.history, action.event, ME);
      return history === next.history ? next : { ...next, history };
    }
    case "past": {
      const { proposals, feedback, executions } = action;
      return { ...state, history: loaded(state.history, proposals, feedback, executions, ME) };
    }
    case "reported":
      return { ...state, history: withExecution(state.history, action.execution) };
    case "relabelled":
      return { ...state, history: withOwn(state.history, action.feedback) };
    case "connection":
      return { ...state, connection: action.connection };
    case "pending":
      return { ...state, pending: action.clicks };
    case "experiment":
      return isNews(state, action.experiment) ? withExperiment(state, action.experiment) : state;
    case "metrics":
      return { ...state, curve: action.points.reduce(addMetric, state.curve) };
    case "evaluation":
      return state.evaluation ? state : withEvaluation(state, action.evaluation, null);
    case "backdrop":
      if (!action.proposal || state.robots.some(({ proposal }) => proposal)) return state;
      return withRobot(state, action.proposal.robot, { proposal: action.proposal });
    case "watch":
      return { ...state, chosen: action.robot };
    case "stopping":
      return { ...state, stopping: state.experiment?.halted ? "no" : action.stopping };
    case "notice":
      return withNotice(state, action.tone, action.text);
    case "dismiss":
      return { ...state, notices: state.notices.filter((notice) => notice.id !== action.id) };
    case "fatal":
      return { ...state, fatal: action.problem };
  }
}

/** An answer by REST may be overtaken by the stream, which also knows the phase: it counts only where it is newer. */
function isNews(state: TrainerState, experiment: Experiment): boolean {
  return !state.experiment || Date.parse(experiment.updated_at) > Date.parse(state.experiment.updated_at);
}

function onEvent(state: TrainerState, event: StreamEvent): TrainerState {
  switch (event.type) {
    case "snapshot":
      return onSnapshot(state, event);
    case "experiment_changed":
      return withExperiment(state, event.experiment);
    case "proposal_opened":
      return onOpened(state, event.proposal);
    case "proposal_changed":
      return event.proposal.closed_at
        ? withClosed(state, event.proposal)
        : { ...state, opened: state.opened.map((each) => newer(each, event.proposal)) };
    case "proposal_closed":
      return withClosed(withOvertaken(state, event.proposal), event.proposal);
    case "judges_changed":
      return { ...state, judges: event.judges };
    case "feedback_stored": {
      const mine = event.undoable && event.feedback.trainer === ME && canStillUndo(state.experiment);
      return {
        ...(mine ? withUndoable(state, event.feedback) : state),
        pending: without(state.pending, event.feedback.click_id),
      };
    }
    case "feedback_undone":
      return {
        ...state,
        judged: except(state.judged, event.feedback.proposal_id),
        undoable: state.undoable?.id === event.feedback.id ? null : state.undoable,
      };
    case "feedback_relabelled":
      return state; // counters come by themselves; the verdict stays
    case "execution_started":
      return withRobot(endUndo(state, event.execution.robot), event.execution.robot, {
        execution: event.execution,
        live: event.execution.id,
      });
    case "execution_ended":
      return onExecutionEnded(state, event.execution, event.violations);
    case "metrics_added":
      return { ...state, curve: addMetric(state.curve, event.point) };
    case "worker_changed":
      return onWorker(state, event);
    case "evaluation_changed":
      return withEvaluation(state, event.evaluation, event.done);
    case "acknowledged":
      return onAcknowledged(state, event.request_id, event.feedback ?? null);
    case "refused":
      return onRefused(state, event.request_id, event.problem);
    case "incident_kept":
      return { ...state, newestIncident: event.incident_id };
    case "robot_told": // it is the telling's
    case "attendance_changed":
    case "resumed":
    case "pong":
      return state;
    default:
      return state; // of a service that is newer than this page: nothing that it needs to know
  }
}

type SnapshotEvent = Extract<StreamEvent, { type: "snapshot" }>;

function onSnapshot(state: TrainerState, event: SnapshotEvent): TrainerState {
  const restarted = state.bootId !== null && state.bootId !== event.boot_id;
  const robots = Array.from({ length: event.experiment.num_envs }, (_, robot): RobotState => {
    const { proposal: last, live } = state.robots[robot] ?? STILL;
    const execution = event.executions.find((each) => each.robot === robot) ?? null;
    const closed: Proposal | null =
      last && isOpen(last) ? { ...last, closed_at: event.server_time, close_reason: "interrupted" } : last;
    const finishing = event.finishing?.robot === robot ? event.finishing : null;
    const proposal = finishing ? { ...finishing, closed_at: null, close_reason: null } : closed;
    return { ...STILL, proposal, finishing, execution, live: execution?.id ?? live };
  });
  const next: TrainerState = {
    ...state,
    ready: true,
    bootId: event.boot_id,
    opened: event.proposals,
    judges: event.judges,
    robots,
    undoable: event.undoable ?? null,
    undoableOn: null,
    judged: {}, // may have been undone meanwhile; a second click on the same proposal is the service's to refuse
  };
  const synced = withExperiment(next, event.experiment);
  return restarted ? withNotice(synced, "info", t("notice.service")) : synced;
}

function withRobot(state: TrainerState, robot: number, change: Partial<RobotState>): TrainerState {
  const robots = [...state.robots];
  robots[robot] = { ...(robots[robot] ?? STILL), ...change };
  return { ...state, robots };
}

/** What was said is remembered as long as it is asked: an undo may bring this one back. */
function onOpened(state: TrainerState, proposal: Proposal): TrainerState {
  const others = state.opened.filter(({ id }) => id !== proposal.id);
  const asked = new Set(others.map(({ id }) => id));
  const gone = Object.keys(state.judged)
    .map(Number)
    .filter((id) => !asked.has(id));
  return { ...state, opened: [...others, proposal], judged: except(state.judged, proposal.id, ...gone) };
}

const newer = (one: Proposal, other: Proposal): Proposal => (one.id === other.id ? other : one);

function except(judged: Judged, ...ids: (number | undefined)[]): Judged {
  return Object.fromEntries(Object.entries(judged).filter(([id]) => !ids.includes(Number(id))));
}

/** The click that an undo would take back, and the robot that it is about, as long as that is known. */
function withUndoable(state: TrainerState, undoable: Feedback): TrainerState {
  const open = state.opened.find(({ id }) => id === undoable.proposal_id);
  const on = open?.robot ?? state.robots.findIndex(({ proposal }) => proposal?.id === undoable.proposal_id);
  return { ...state, undoable, undoableOn: on >= 0 ? on : null };
}

/** This robot's scene isn't the one any more on which a click on its proposal was made. */
function endUndo(state: TrainerState, robot: number): TrainerState {
  return state.undoableOn === null || state.undoableOn === robot ? { ...state, undoable: null } : state;
}

function withExperiment(state: TrainerState, experiment: Experiment): TrainerState {
  const { feedback, successes } = experiment.counters;
  return {
    ...state,
    experiment,
    undoable: canStillUndo(experiment) ? state.undoable : null,
    stopping: experiment.halted ? "no" : state.stopping,
    curve: addPoint(state.curve, { feedback, successes }),
  };
}

/** A proposal closed without a verdict: a reset or a death ends its episode, and an undo has nothing more to undo. */
function withClosed(before: TrainerState, proposal: Proposal): TrainerState {
  const { robot, close_reason: reason } = proposal;
  const state = { ...before, opened: before.opened.filter(({ id }) => id !== proposal.id) };
  if (proposal.id !== state.robots[robot]?.proposal?.id) return state;
  if (mayFinish(proposal, state.judges)) return withRobot(state, robot, { finishing: proposal });
  const dropped = reason === "withdrawn" || reason === "interrupted";
  return withRobot(dropped ? endUndo(state, robot) : state, robot, { proposal });
}

/** Somebody's approval of another proposal has closed this one: nobody's look or click is just gone. */
function withOvertaken(state: TrainerState, proposal: Proposal): TrainerState {
  const approved = state.history.find((entry) => entry.proposal.id === proposal.superseded_by)?.proposal;
  const here = state.robots[proposal.robot]?.proposal?.id === proposal.id;
  const seen = !here ? "no" : mayFinish(proposal, state.judges) ? "finishing" : "seen";
  const text = overtaken(proposal, approved ?? null, state.judged[proposal.id], seen);
  return text === null ? state : withNotice(state, "info", text);
}

function onExecutionEnded(state: TrainerState, execution: Execution, violations: string[]): TrainerState {
  const { robot } = execution;
  const say = (text: string) => saying(state.robots, robot, text);
  let next = state;
  if (state.robots[robot]?.execution?.id === execution.id)
    next = withRobot(state, robot, { execution: null });
  if (execution.task_success) next = withNotice(next, "good", say(t("notice.solved")));
  for (const violation of violations)
    next = withNotice(next, "error", say(t("notice.violation", { violation })));
  if (execution.outcome === "interrupted")
    next = withNotice(next, "warning", say(t("notice.interrupted", { skill: skillName(execution.skill) })));
  return next;
}

type WorkerEvent = Extract<StreamEvent, { type: "worker_changed" }>;

function onWorker(state: TrainerState, { worker, robot, status, detail }: WorkerEvent): TrainerState {
  const of =
    state.robots.length > 1 ? t("notice.robotNumber", { robot: (robot ?? 0) + 1 }) : t("notice.robot");
  const name = worker === "robot" ? of : t("notice.learner");
  if (status === "died")
    return withNotice(state, "warning", t("notice.died", { worker: name, detail }).trim());
  if (status === "restarted")
    return withNotice(state, "info", t("notice.restarted", { worker: name, detail }).trim());
  return state;
}

function onAcknowledged(state: TrainerState, requestId: string, feedback: Feedback | null): TrainerState {
  const pending = without(state.pending, requestId);
  // The answer to an undo carries the undone click: that proposal is to be judged again.
  const click = feedback?.click_id === requestId ? feedback : null;
  const judged = click ? { ...state.judged, [click.proposal_id]: click.value } : state.judged;
  const next = { ...state, pending, judged };
  if (feedback?.status === "practice") return withNotice(next, "info", t("notice.practice"));
  // Nobody was told that this click closed anything: others are still asked, and it can be taken back.
  if (feedback?.status === "stored" && click && pending !== state.pending && canStillUndo(state.experiment))
    return withUndoable(next, feedback);
  if (feedback?.status === "overtaken" && click) return withNotice(next, "info", t("notice.overtaken"));
  if (feedback?.status !== "late") return next;
  const late = t("notice.late", { word: wordFor(feedback.value) });
  const because = feedback.late_because && said(feedback.late_because);
  return withNotice(next, "warning", because ? `${late} ${t("notice.lateBecause", { because })}` : late);
}

function onRefused(state: TrainerState, requestId: string | null, problem: Problem): TrainerState {
  // A fault of the service (disk full, ...) keeps the click, as does one that came too fast: it is sent again.
  const pending =
    requestId && !comesAgain(problem.status) ? without(state.pending, requestId) : state.pending;
  return withNotice({ ...state, pending }, "error", inOneLine(problem));
}

function withEvaluation(
  state: TrainerState,
  evaluation: Evaluation | null,
  done: number | null,
): TrainerState {
  return { ...state, evaluation, evaluationDone: done ?? (evaluation?.ended_at ? evaluation.rollouts : 0) };
}

function withNotice(state: TrainerState, tone: Notice["tone"], text: string): TrainerState {
  const others = state.notices.filter((notice) => notice.text !== text).slice(-3);
  return {
    ...state,
    notices: [...others, { id: state.nextNotice, tone, text }],
    nextNotice: state.nextNotice + 1,
  };
}

function without(clicks: Click[], clickId: string): Click[] {
  return clicks.some((click) => click.click_id === clickId)
    ? clicks.filter((click) => click.click_id !== clickId)
    : clicks;
}
