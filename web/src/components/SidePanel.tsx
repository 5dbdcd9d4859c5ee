// What stands beside the views: counters, what the agent thinks, mode, evaluation.

import { useEffect, useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import type { Pace } from "../pace";
import type { Session } from "../session";
import { useSettings } from "../settings";
import type { TrainerState } from "../state";
import type { Experiment, Mode, Proposal } from "../wire";
import { AutoApprovalPanel } from "./AutoApproval";
import { Counters } from "./Counters";
import type { Question } from "./Dialog";
import { EvaluationPanel } from "./Evaluation";
import { ModeSwitch } from "./ModeSwitch";
import { OwnPace } from "./OwnPace";
import { SceneView } from "./SceneView";
import { Thought } from "./Thought";
import { TourOffer } from "./Tour";

const ROLLOUTS = 10; // as in the paper's evaluations

/** Whether the adapter is a simulator; unknown counts as no. */
function useSimulated(adapter: string): boolean {
  const [simulated, setSimulated] = useState(false);
  useEffect(() => {
    let gone = false;
    http.adapterList().then(
      (adapters) => gone || setSimulated(adapters.some((each) => each.name === adapter && each.simulated)),
      () => undefined, // the panel just stays away
    );
    return () => {
      gone = true;
    };
  }, [adapter]);
  return simulated;
}

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
  onTour: () => void;
}

export function SidePanel(props: SidePanelProps) {
  const { state, experiment, proposal, session, onAsk } = props;
  const { scene } = useSettings();
  const simulated = useSimulated(experiment.adapter);
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
      {scene && <SceneView task={experiment.task} proposal={proposal} overlay={props.overlay} />}
      <Thought proposal={proposal} />
      <OwnPace id={experiment.id} feedback={experiment.counters.feedback} pace={props.pace} />
      <Counters counters={experiment.counters} />
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
