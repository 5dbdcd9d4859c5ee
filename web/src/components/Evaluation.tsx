import { t } from "../i18n";
import { percent } from "../i18n/numbers";
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
    <section className="card" aria-label={t("evaluation.title")}>
      <h2>{t("evaluation.title")}</h2>
      <div className="evaluation">
        <div className="result" data-testid="evaluation">
          {evaluation?.ended_at ? (
            <>
              <b className="number">{t("evaluation.rate", { rate: percent(evaluation.success_rate) })}</b>
              <div className="soft">
                {t("evaluation.result", {
                  successes: evaluation.successes,
                  rollouts: evaluation.rollouts,
                  feedback: evaluation.feedback,
                })}
              </div>
            </>
          ) : going ? (
            <span className="number">
              {t("evaluation.progress", { done, rollouts: evaluation.rollouts })}
            </span>
          ) : (
            <span className="soft">{t("evaluation.none")}</span>
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
            {t("evaluation.evaluate")}
          </button>
        )}
        {going && (
          <div
            className="track"
            role="progressbar"
            aria-label={t("evaluation.rollouts")}
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
