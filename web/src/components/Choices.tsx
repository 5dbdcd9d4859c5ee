// The skills by their probability, the likeliest first: what the agent would rather have done, how much rather, and, for
// whoever points at one, with which parameters and where.
import { useEffect, useState } from "react";
import { lookAt, useConsidered } from "../considering";
import { skillName, t } from "../i18n";
import { decimal, percent, signed } from "../i18n/numbers";
import { useSettings } from "../settings";
import type { Proposal } from "../wire";

export function Choices({ proposal }: { proposal: Proposal }) {
  const [skill, setSkill] = useState<string | null>(null);
  const [wanted, setWanted] = useState(false);
  const { estimate } = useSettings();
  const considered = useConsidered(proposal.id, wanted && !proposal.closed_at);
  const chosen = considered?.find((each) => each.skill === skill) ?? null;
  useEffect(() => {
    lookAt(chosen && !chosen.proposed ? { proposalId: proposal.id, overlays: chosen.overlays } : null);
    return () => lookAt(null);
  }, [chosen, proposal.id]);
  const skills = Object.entries(proposal.skill_probabilities).sort(([, one], [, other]) => other - one);
  if (skills.length === 0) return null;
  const look = (name: string) => {
    setWanted(true);
    setSkill(name);
  };
  const parameters = (chosen ? Object.entries(chosen.parameters) : []).map(
    ([name, value]) => `${name} ${decimal(value, 3)}`,
  );
  return (
    <div>
      <h2>{t("agent.choices")}</h2>
      <ol className="choices">
        {skills.map(([name, probability], rank) => (
          <li key={name} data-chosen={name === proposal.skill}>
            <button
              type="button"
              className="bar-row"
              data-testid="choice"
              data-skill={name}
              aria-expanded={chosen?.skill === name}
              title={t("agent.considerWhat")}
              onPointerEnter={() => look(name)}
              onPointerLeave={() => setSkill(null)}
              onFocus={() => look(name)}
              onBlur={() => setSkill(null)}
              onClick={() => look(name)}
            >
              <span className="rank">{rank + 1}</span>
              <span className={name === proposal.skill ? "" : "soft"}>{skillName(name)}</span>
              <span className="track">
                <i style={{ left: 0, width: `${100 * probability}%` }} />
              </span>
              <b>{percent(probability)}</b>
            </button>
          </li>
        ))}
      </ol>
      <div className="considered number" role="status" data-testid="considered">
        {chosen
          ? [...parameters, estimate && t("agent.considered", { value: signed(chosen.predicted_feedback) })]
              .filter(Boolean)
              .join(" · ")
          : t("agent.consider")}
      </div>
    </div>
  );
}
