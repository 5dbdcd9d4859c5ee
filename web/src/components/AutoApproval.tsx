// Letting the critic approve by itself, in simulation only: on or off, what it has approved, how trainers agreed.
import * as http from "../http";
import { lastRule, rememberRule } from "../lastRule";
import { useLatest } from "../useLatest";
import type { AutoApproval, AutoApprovalRecord, Experiment } from "../wire";
import { signed } from "./Calibration";
import type { Question } from "./Dialog";

const percent = (share: number) => `${Math.round(100 * share)} %`;

/** How trainers judged what the critic would have approved. */
export function agreementIn({ audited, agreed, interval }: AutoApprovalRecord): string {
  if (audited === 0) return "Not checked by a trainer yet.";
  const [low, high] = interval;
  return `Trainers agreed with ${agreed} of ${audited} checked (95 % interval ${percent(low)} to ${percent(high)}).`;
}

/** Why it can't be turned on, or null. */
export function obstacleTo(experiment: Experiment): string | null {
  const critics = experiment.settings.critics;
  return typeof critics === "number" && critics >= 2
    ? null
    : "Needs two critics or more, which tell by their agreement how sure they are (preset “recommended”).";
}

export interface AutoApprovalProps {
  experiment: Experiment;
  onAsk: (question: Question) => void;
  /** A rule, or null to turn it off. */
  onSet: (rule: AutoApproval | null) => void;
}

/** As the service's own defaults. */
const FIRST_RULE: Required<AutoApproval> = {
  predicted_at_least: 0.9,
  uncertainty_at_most: 0.1,
  after_feedback: 50,
  audit_every: 10,
  agreement_at_least: 0.9,
};

/** What the rule says, in words. */
export function ruleIn(rule: AutoApproval): string {
  const { predicted_at_least, uncertainty_at_most, after_feedback, audit_every } = { ...FIRST_RULE, ...rule };
  return (
    `Approves what is predicted ${signed(predicted_at_least)} or more, ±\u00a0${uncertainty_at_most.toFixed(2)} or less, ` +
    `once ${after_feedback} feedbacks are stored. One in ${audit_every} of those waits for a trainer.`
  );
}

function turnOn({ experiment, onSet }: AutoApprovalProps): Question {
  const rule = { ...FIRST_RULE, ...(experiment.auto_approval ?? lastRule(experiment.id)) };
  return {
    title: "Let the critic approve by itself?",
    text:
      `The simulated robot then moves without your click. ${ruleIn(rule)} If you agree with it too rarely, this ends ` +
      "by itself. Nothing is learned from the critic's own approvals, and Stop works as ever.",
    yes: "Let it approve",
    testId: "auto-approval-confirm",
    act: () => onSet(rule),
  };
}

export function AutoApprovalCard(props: AutoApprovalProps & { record: AutoApprovalRecord | null }) {
  const { experiment, record, onAsk, onSet } = props;
  const suspended = experiment.auto_approval_suspended;
  const on = Boolean(experiment.auto_approval) && !suspended;
  const obstacle = obstacleTo(experiment);
  const approved = experiment.counters.auto_approved;
  return (
    <section className="card" aria-label="Auto-approval">
      <h2>Auto-approval</h2>
      <div className="evaluation">
        <div className="result" data-testid="auto-approval" data-on={on}>
          {on || suspended || approved > 0 ? (
            <>
              <b className="number">{`${approved} ${approved === 1 ? "motion" : "motions"} approved by the critic`}</b>
              {record && <div className="soft">{agreementIn(record)}</div>}
            </>
          ) : (
            <span className="soft">Off: every proposal waits for a trainer</span>
          )}
        </div>
        {on ? (
          <button
            type="button"
            className="button"
            data-testid="auto-approval-off"
            onClick={() => {
              if (experiment.auto_approval) rememberRule(experiment.id, experiment.auto_approval);
              onSet(null);
            }}
          >
            Turn off
          </button>
        ) : (
          <button
            type="button"
            className="button"
            data-testid="auto-approval-on"
            disabled={obstacle !== null}
            onClick={() => onAsk(turnOn(props))}
          >
            {suspended ? "Turn on again" : "Turn on"}
          </button>
        )}
      </div>
      {suspended && (
        <p className="warning-text" role="status" data-testid="auto-approval-suspended">
          {`Suspended: ${suspended}.`}
        </p>
      )}
      {on && experiment.auto_approval && <p className="hint">{ruleIn(experiment.auto_approval)}</p>}
      {obstacle && !on && <p className="hint">{obstacle}</p>}
    </section>
  );
}

export function AutoApprovalPanel(props: AutoApprovalProps) {
  const { id, counters, auto_approval, auto_approval_suspended } = props.experiment;
  const key = [
    id,
    counters.feedback,
    counters.auto_approved,
    Boolean(auto_approval),
    auto_approval_suspended,
  ];
  const record = useLatest(() => http.autoApproval(id), key.join(":"));
  return <AutoApprovalCard {...props} record={record} />;
}
