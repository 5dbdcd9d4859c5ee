// Letting the critic approve by itself, in simulation only: on or off, what it has approved, how trainers agreed.

import * as http from "../http";
import { t } from "../i18n";
import { decimal, percent, signed } from "../i18n/numbers";
import { lastRule, rememberRule } from "../lastRule";
import { useLatest } from "../useLatest";
import type { AutoApproval, AutoApprovalRecord, Experiment } from "../wire";
import type { Question } from "./Dialog";

/** How trainers judged what the critic would have approved. */
export function agreementIn({ audited, agreed, interval }: AutoApprovalRecord): string {
  if (audited === 0) return t("autoApproval.unchecked");
  const [low, high] = interval;
  return t("autoApproval.agreed", { agreed, audited, low: percent(low), high: percent(high) });
}

/** Why it can't be turned on, or null. */
export function obstacleTo(experiment: Experiment): string | null {
  const critics = experiment.settings.critics;
  return typeof critics === "number" && critics >= 2 ? null : t("autoApproval.critics");
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
  return t("autoApproval.rule", {
    predicted: signed(predicted_at_least),
    uncertainty: decimal(uncertainty_at_most),
    feedback: after_feedback,
    every: audit_every,
  });
}

function turnOn({ experiment, onSet }: AutoApprovalProps): Question {
  const rule = { ...FIRST_RULE, ...(experiment.auto_approval ?? lastRule(experiment.id)) };
  return {
    title: t("autoApproval.ask"),
    text: t("autoApproval.asked", { rule: ruleIn(rule) }),
    yes: t("autoApproval.yes"),
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
    <section className="card" aria-label={t("autoApproval.title")}>
      <h2>{t("autoApproval.title")}</h2>
      <div className="evaluation">
        <div className="result" data-testid="auto-approval" data-on={on}>
          {on || suspended || approved > 0 ? (
            <>
              <b className="number">{t("autoApproval.approved", { count: approved })}</b>
              {record && <div className="soft">{agreementIn(record)}</div>}
            </>
          ) : (
            <span className="soft">{t("autoApproval.off")}</span>
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
            {t("autoApproval.turnOff")}
          </button>
        ) : (
          <button
            type="button"
            className="button"
            data-testid="auto-approval-on"
            disabled={obstacle !== null}
            onClick={() => onAsk(turnOn(props))}
          >
            {suspended ? t("autoApproval.turnOnAgain") : t("autoApproval.turnOn")}
          </button>
        )}
      </div>
      {suspended && (
        <p className="warning-text" role="status" data-testid="auto-approval-suspended">
          {t("autoApproval.suspended", { reason: suspended })}
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
