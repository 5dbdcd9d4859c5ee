// What stands beside the views: counters, what the agent thinks, mode, evaluation.

import { catchingUp } from "../activity";
import { t } from "../i18n";
import type { Pace } from "../pace";
import type { Session } from "../session";
import { useSettings } from "../settings";
import type { TrainerState } from "../state";
import type { Experiment, Mode, Proposal, TaskInfo } from "../wire";
import { AutoApprovalPanel } from "./AutoApproval";
import { Counters } from "./Counters";
import type { Question } from "./Dialog";
import { EvaluationPanel } from "./Evaluation";
import { ModeSwitch } from "./ModeSwitch";
import { OperatorPanel } from "./OperatorPanel";
import { OwnPace } from "./OwnPace";
import { SceneView } from "./SceneView";
import { Thought } from "./Thought";
import { TourOffer } from "./Tour";

const ROLLOUTS = 10; // as in the paper's evaluations

function obstacleTo(experiment: Experiment): string | null {
  if (experiment.halted) return t("evaluation.halted");
  if (experiment.lifecycle === "running") return t("evaluation.running");
  return ["created", "paused", "finished"].includes(experiment.lifecycle) ? null : t("evaluation.impossible");
}

export interface SidePanelProps {
  state: TrainerState;
  experiment: Experiment;
  proposal: Proposal | null;
  session: Session;
  onAsk: (question: Question) => void;
  /** Whether what it proposes is drawn. */
  overlay: boolean;
  pace: Pace;
  task: TaskInfo | null;
  simulated: boolean | null;
  onTour: () => void;
}

export function SidePanel(props: SidePanelProps) {
  const { state, experiment, proposal, session, onAsk, task } = props;
  const simulated = props.simulated ?? false; // unknown counts as no
  const { scene } = useSettings();
  const recalled = catchingUp(experiment.catching_up);
  const changeMode = (mode: Mode) => {
    if (mode === "propose_only") void session.setMode(mode);
    else
      onAsk({
        title: t("mode.ask"),
        text: t("mode.asked"),
        yes: t("mode.execute_approved"),
        testId: "mode-confirm",
        act: () => void session.setMode(mode),
      });
  };
  return (
    <aside className="side" aria-label={t("title.side")}>
      <TourOffer onTour={props.onTour} />
      {scene && <SceneView scene={task?.scene ?? null} proposal={proposal} overlay={props.overlay} />}
      <Thought proposal={proposal} />
      <OwnPace id={experiment.id} feedback={experiment.counters.feedback} pace={props.pace} />
      <Counters counters={experiment.counters} />
      {recalled && (
        <p className="note" data-testid="catching-up">
          {recalled}
        </p>
      )}
      <OperatorPanel
        state={state}
        experiment={experiment}
        session={session}
        task={task}
        simulated={simulated}
        onAsk={onAsk}
      />
      <ModeSwitch mode={experiment.mode} onChange={changeMode} />
      {simulated && (
        <AutoApprovalPanel
          experiment={experiment}
          onAsk={onAsk}
          onSet={(rule) => void session.setAutoApproval(rule)}
        />
      )}
      {simulated && (
        <EvaluationPanel
          evaluation={state.evaluation}
          done={state.evaluationDone}
          running={experiment.phase === "evaluating"}
          obstacle={obstacleTo(experiment)}
          onEvaluate={() => void session.evaluate(ROLLOUTS)}
        />
      )}
    </aside>
  );
}
