// For whoever keeps the robot safe: its state in words and figures, a new episode by hand, and what went wrong.
import { useState } from "react";
import { activity } from "../activity";
import { t, taskWords } from "../i18n";
import type { Session } from "../session";
import type { TrainerState } from "../state";
import type { Experiment, TaskInfo } from "../wire";
import { AtTheRobot } from "./AtTheRobot";
import { Dialog, type Question } from "./Dialog";
import { Incidents } from "./Incidents";
import { ReadOuts } from "./ReadOuts";
import { TogetherPanel } from "./Together";

export interface OperatorPanelProps {
  state: TrainerState;
  experiment: Experiment;
  session: Session;
  task: TaskInfo | null;
  simulated: boolean;
  onAsk: (question: Question) => void;
}

export function ResetDialog(props: {
  task: TaskInfo | null;
  simulated: boolean;
  onReset: () => void;
  onClose: () => void;
}) {
  const { task, simulated } = props;
  return (
    <Dialog title={t("operator.reset")} onClose={props.onClose}>
      {simulated ? (
        <p className="soft">{t("operator.resetSimulated")}</p>
      ) : (
        <ol className="by-hand">
          <li>{t("operator.resetStop")}</li>
          <li data-testid="by-hand">
            {task?.by_hand ? taskWords(task.by_hand) : t("operator.resetUnknown")}
          </li>
          <li>{t("operator.resetAway")}</li>
        </ol>
      )}
      <div className="actions">
        <button type="button" className="button" data-first onClick={props.onClose}>
          {t("common.cancel")}
        </button>
        <button
          type="button"
          className="button primary"
          data-testid="reset-confirm"
          onClick={() => {
            props.onClose();
            props.onReset();
          }}
        >
          {simulated ? t("operator.resetNow") : t("operator.resetDone")}
        </button>
      </div>
    </Dialog>
  );
}

export function NeedsHand({ onOpen }: { onOpen: () => void }) {
  return (
    <div className="banner" role="alert" data-testid="needs-hand">
      <div>
        <b>{t("operator.needsHand")}</b> {t("operator.needsHandWhat")}
      </div>
      <button type="button" className="button" onClick={onOpen}>
        {t("operator.needsHandHow")}
      </button>
    </div>
  );
}

export function OperatorPanel(props: OperatorPanelProps) {
  const { state, experiment, session, task, simulated } = props;
  const [resetting, setResetting] = useState(false);
  const resettable = ["running", "paused"].includes(experiment.lifecycle) && !experiment.halted;
  return (
    <details className="card operator" data-testid="operator">
      <summary>
        <h2>{t("operator.title")}</h2>
        <span className="soft" data-testid="robot-state">
          {activity(state, true).text}
        </span>
      </summary>
      {!simulated && <AtTheRobot session={session} experiment={experiment} />}
      <ReadOuts telling={session.telling} robot={state.shown} />
      <button
        type="button"
        className="button"
        disabled={!resettable}
        data-testid="reset"
        onClick={() => setResetting(true)}
      >
        {t("operator.resetAsk")}
      </button>
      {!experiment.teacher && (
        <TogetherPanel
          experiment={experiment}
          judges={state.judges}
          opened={state.opened}
          session={session}
          onAsk={props.onAsk}
        />
      )}
      <Incidents id={experiment.id} newest={state.newestIncident} />
      {resetting && (
        <ResetDialog
          task={task}
          simulated={simulated}
          onReset={() => void session.act("reset")}
          onClose={() => setResetting(false)}
        />
      )}
    </details>
  );
}
