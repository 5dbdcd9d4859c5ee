// What the agent thinks: the next subgoal, the feedback it expects, how likely each skill was.
import type { Proposal } from "../wire";

function signed(value: number): string {
  const digits = Math.abs(value).toFixed(2);
  if (digits === "0.00") return digits;
  return value < 0 ? `−${digits}` : `+${digits}`;
}

function Gauge({ value }: { value: number }) {
  const bounded = Math.max(-1, Math.min(1, value));
  const half = Math.abs(bounded) * 50;
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
      </div>
      <b data-testid="predicted-feedback">{signed(value)}</b>
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
          <Gauge value={proposal.predicted_feedback} />
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
