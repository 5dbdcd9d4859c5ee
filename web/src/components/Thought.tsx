// What the agent thinks: the next subgoal, the feedback it expects, how likely each skill was.
import type { Proposal } from "../wire";
import { signed } from "./Calibration";

const bound = (value: number) => Math.max(-1, Math.min(1, value));
const along = (value: number) => 50 + 50 * bound(value);

function Gauge({ value, uncertainty }: { value: number; uncertainty: number | null }) {
  const bounded = bound(value);
  const half = Math.abs(bounded) * 50;
  const [low, high] = [along(value - (uncertainty ?? 0)), along(value + (uncertainty ?? 0))];
  return (
    <div className="gauge-row">
      <span className="soft">Expects</span>
      <meter
        className="sr-only"
        aria-label="Predicted feedback, from −1 bad to +1 good"
        min={-1}
        max={1}
        value={bounded}
      />
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
          <span className="soft" data-testid="uncertainty" title="How far the critics disagree">
            {` ± ${uncertainty.toFixed(2)}`}
          </span>
        )}
      </span>
    </div>
  );
}

export function Thought({ proposal }: { proposal: Proposal | null }) {
  if (!proposal)
    return (
      <section className="card" aria-label="Agent">
        <h2>Agent</h2>
        <p className="soft">Its expectation shows here with the first proposal.</p>
      </section>
    );
  const skills = Object.entries(proposal.skill_probabilities);
  return (
    <section className="card" aria-label="Agent">
      <div className="thought">
        {proposal.subgoal && (
          <div>
            <h2>Next</h2>
            <p data-testid="subgoal">{proposal.subgoal}</p>
          </div>
        )}
        <div>
          <h2>
            Predicted feedback <abbr title="The human critic's estimate of your click">Ĥ</abbr>
          </h2>
          <Gauge value={proposal.predicted_feedback} uncertainty={proposal.uncertainty} />
          {proposal.uncertainty === null && (
            <p className="hint" data-testid="uncertainty-unknown">
              How sure it is isn't known: that takes two critics or more.
            </p>
          )}
        </div>
        {skills.length > 0 && (
          <div>
            <h2>Skill probabilities</h2>
            {skills.map(([skill, probability]) => (
              <div className="bar-row" key={skill}>
                <span className={skill === proposal.skill ? "" : "soft"}>{skill}</span>
                <div className="track">
                  <i style={{ left: 0, width: `${100 * probability}%` }} />
                </div>
                <b>{`${Math.round(100 * probability)} %`}</b>
              </div>
            ))}
          </div>
        )}
      </div>
    </section>
  );
}
