// Letting the critic approve by itself, in simulation only: on or off, what it has approved, how trainers agreed.
import * as http from "../http";
import { useLatest } from "../useLatest";
import type { AutoApprovalRecord, Experiment } from "../wire";
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
  onSet: (on: boolean) => void;
}

const turnOn = (onSet: AutoApprovalProps["onSet"]): Question => ({
  title: "Let the critic approve by itself?",
  text:
    "Once 50 feedbacks are stored, a proposal moves the simulated robot without your click if the critics predict " +
    "+0.90 or more and disagree by ± 0.10 or less. One in ten of them waits for you anyway; if you agree too rarely, " +
    "this ends by itself. Nothing is learned from the critic's own approvals, and Stop works as ever.",
  yes: "Let it approve",
  testId: "auto-approval-confirm",
  act: () => onSet(true),
});

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
              <b className="number">{`${approved} approved by the critic`}</b>
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
            onClick={() => onSet(false)}
          >
            Turn off
          </button>
        ) : (
          <button
            type="button"
            className="button"
            data-testid="auto-approval-on"
            disabled={obstacle !== null}
            onClick={() => onAsk(turnOn(onSet))}
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
