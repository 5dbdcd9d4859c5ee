// What is known of one moment of an episode: no more than was known then.
import { labelOf } from "../gallery";
import { skillName, t, taskWords } from "../i18n";
import { decimal, moment, percent, signed } from "../i18n/numbers";
import { type Moment, STAGES } from "../replaying";
import { called } from "../together";
import { LABELS } from "./History";

export function StageLine({ moment: { entry, stage } }: { moment: Moment }) {
  const at = STAGES.indexOf(stage);
  return (
    <ol className="stages" aria-label={t("episode.stages")}>
      {STAGES.map((each, index) => (
        <li
          key={each}
          data-past={index < at}
          data-skipped={each === "executed" && !entry.execution}
          aria-current={each === stage ? "step" : undefined}
        >
          {t(`episode.stage_${each}`)}
        </li>
      ))}
    </ol>
  );
}

function Proposed({ entry }: Pick<Moment, "entry">) {
  const { proposal } = entry;
  const likely = Object.entries(proposal.skill_probabilities).sort(([, one], [, other]) => other - one);
  return (
    <>
      <dl className="facts-list">
        <dt>{t("episode.subgoal")}</dt>
        <dd>{taskWords(proposal.subgoal ?? "") || "–"}</dd>
        <dt>{t("episode.call")}</dt>
        <dd>
          <b>{skillName(proposal.skill)}</b>{" "}
          <code>
            {Object.entries(proposal.parameters)
              .map(([name, value]) => `${name} ${decimal(value, 3)}`)
              .join("  ")}
          </code>
        </dd>
        <dt>{t("agent.predicted")}</dt>
        <dd className="number">
          {signed(proposal.predicted_feedback)}
          {proposal.uncertainty !== null && ` ± ${decimal(proposal.uncertainty)}`}
        </dd>
        <dt>{t("episode.version")}</dt>
        <dd className="number">{proposal.policy_version}</dd>
      </dl>
      <ul className="likely" aria-label={t("agent.choices")}>
        {likely.map(([skill, share]) => (
          <li key={skill}>
            <span>{skillName(skill)}</span>
            <i style={{ inlineSize: `${100 * share}%` }} />
            <span className="number">{percent(share)}</span>
          </li>
        ))}
      </ul>
    </>
  );
}

function Judged({ entry }: Pick<Moment, "entry">) {
  const { proposal, feedback } = entry;
  const label = labelOf(entry);
  return (
    <div className="verdict" data-label={proposal.verdict ?? "none"} data-testid="replay-verdict">
      <b>{t(proposal.verdict ? `gallery.verdict_${proposal.verdict}` : "gallery.verdict_none")}</b>
      <ul>
        {feedback.map((each) => {
          const said = LABELS.find(({ value }) => value === each.label)?.key;
          const notes = [
            each.undone_at && t("episode.undone"),
            each.status !== "stored" && t(`episode.status_${each.status}`),
            each.label !== each.value && t("episode.corrected"),
          ];
          return (
            <li key={each.id}>
              {[called(each.trainer), said && t(`judge.word.${said}`), moment(each.received_at), ...notes]
                .filter(Boolean)
                .join(" · ")}
            </li>
          );
        })}
      </ul>
      {label === "none" && feedback.length === 0 && proposal.close_reason && (
        <p className="soft">{t(`episode.closed_${proposal.close_reason}`)}</p>
      )}
      {proposal.gate && !proposal.gate.allowed && (
        <p className="soft">{t("episode.gate", { reason: proposal.gate.reason })}</p>
      )}
    </div>
  );
}

function Executed({ entry: { execution } }: Pick<Moment, "entry">) {
  if (!execution) return null;
  return (
    <div className="verdict" data-testid="replay-execution">
      <b>
        {execution.outcome ? t(`history.outcome_${execution.outcome}`) : t("episode.running")}
        {execution.task_success && ` · ${t("episode.solved")}`}
      </b>
      <p className="soft">
        {[execution.end_reason, t("episode.steps", { count: execution.low_level_steps })]
          .filter(Boolean)
          .join(" · ")}
      </p>
      {execution.violations.map(({ kind, detail }) => (
        <p key={kind + detail} className="error">
          {t("notice.violation", { violation: detail })}
        </p>
      ))}
    </div>
  );
}

export function StepFacts({ moment: here }: { moment: Moment }) {
  return (
    <div className="step-facts">
      <Proposed entry={here.entry} />
      {here.stage !== "proposed" && <Judged entry={here.entry} />}
      {here.stage === "executed" && <Executed entry={here.entry} />}
    </div>
  );
}
