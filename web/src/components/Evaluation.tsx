import type { Evaluation } from "../wire";

export interface EvaluationProps {
  evaluation: Evaluation | null;
  done: number;
  running: boolean;
  /** Why it can't be started now, or null. */
  obstacle: string | null;
  onEvaluate: () => void;
}

/** Ten rollouts of the deterministic policy, their progress and their result. */
export function EvaluationPanel({ evaluation, done, running, obstacle, onEvaluate }: EvaluationProps) {
  const going = running && evaluation !== null && !evaluation.ended_at;
  const share = evaluation ? (100 * done) / Math.max(1, evaluation.rollouts) : 0;
  return (
    <section className="card" aria-label="Evaluation">
      <h2>Evaluation</h2>
      <div className="evaluation">
        <div className="result" data-testid="evaluation">
          {evaluation?.ended_at ? (
            <>
              <b className="number">{`${Math.round(100 * evaluation.success_rate)} % success`}</b>
              <div className="soft">{`${evaluation.successes} of ${evaluation.rollouts}, after ${evaluation.feedback} feedback`}</div>
            </>
          ) : going ? (
            <span className="number">{`${done} of ${evaluation.rollouts} rollouts`}</span>
          ) : (
            <span className="soft">Not evaluated yet</span>
          )}
        </div>
        {!going && (
          <button
            type="button"
            className="button"
            data-testid="evaluate"
            disabled={obstacle !== null}
            onClick={onEvaluate}
          >
            Evaluate
          </button>
        )}
        {going && (
          <div
            className="track"
            role="progressbar"
            aria-label="Rollouts"
            aria-valuemin={0}
            aria-valuemax={evaluation.rollouts}
            aria-valuenow={done}
          >
            <i style={{ left: 0, width: `${share}%` }} />
          </div>
        )}
      </div>
      {obstacle && !going && <p className="hint">{obstacle}</p>}
    </section>
  );
}
