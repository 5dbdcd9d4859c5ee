// What the agent thinks: the next subgoal, the feedback it expects, how likely each skill was.
import { skillName, t } from "../i18n";
import { decimal, percent, signed } from "../i18n/numbers";
import type { Proposal } from "../wire";

const bound = (value: number) => Math.max(-1, Math.min(1, value));
const along = (value: number) => 50 + 50 * bound(value);

function Gauge({ value, uncertainty }: { value: number; uncertainty: number | null }) {
  const bounded = bound(value);
  const half = Math.abs(bounded) * 50;
  const [low, high] = [along(value - (uncertainty ?? 0)), along(value + (uncertainty ?? 0))];
  return (
    <div className="gauge-row">
      <span className="soft">{t("agent.expects")}</span>
      <meter className="sr-only" aria-label={t("agent.meter")} min={-1} max={1} value={bounded} />
      <div className="track centred" aria-hidden="true">
        <i
          data-tone={bounded < 0 ? "bad" : "good"}
          style={{ left: `${bounded < 0 ? 50 - half : 50}%`, width: `${half}%` }}
        />
        {uncertainty !== null && <i className="reach" style={{ left: `${low}%`, width: `${high - low}%` }} />}
      </div>
      <span className="number">
        <b data-testid="predicted-feedback">{signed(value)}</b>
        {uncertainty !== null && (
          <span className="soft" data-testid="uncertainty" title={t("agent.uncertainty")}>
            {` ± ${decimal(uncertainty)}`}
          </span>
        )}
      </span>
    </div>
  );
}

export function Thought({ proposal }: { proposal: Proposal | null }) {
  if (!proposal)
    return (
      <section className="card" aria-label={t("agent.label")}>
        <h2>{t("agent.label")}</h2>
        <p className="soft">{t("agent.empty")}</p>
      </section>
    );
  const skills = Object.entries(proposal.skill_probabilities);
  return (
    <section className="card" aria-label={t("agent.label")}>
      <div className="thought">
        {proposal.subgoal && (
          <div>
            <h2>{t("agent.next")}</h2>
            <p data-testid="subgoal">{proposal.subgoal}</p>
          </div>
        )}
        <div>
          <h2>
            {t("agent.predicted")} <abbr title={t("agent.critic")}>Ĥ</abbr>
          </h2>
          <Gauge value={proposal.predicted_feedback} uncertainty={proposal.uncertainty} />
          {proposal.uncertainty === null && (
            <p className="hint" data-testid="uncertainty-unknown">
              {t("agent.uncertaintyUnknown")}
            </p>
          )}
        </div>
        {skills.length > 0 && (
          <div>
            <h2>{t("agent.skills")}</h2>
            {skills.map(([skill, probability]) => (
              <div className="bar-row" key={skill}>
                <span className={skill === proposal.skill ? "" : "soft"}>{skillName(skill)}</span>
                <div className="track">
                  <i style={{ left: 0, width: `${100 * probability}%` }} />
                </div>
                <b>{percent(probability)}</b>
              </div>
            ))}
          </div>
        )}
      </div>
    </section>
  );
}
