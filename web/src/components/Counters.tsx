import { t } from "../i18n";
import { percent } from "../i18n/numbers";
import type { Experiment } from "../wire";

/** Share of good among the feedback, in words. */
export function goodShare({ feedback, good }: { feedback: number; good: number }): string {
  return feedback === 0 ? "–" : percent(good / feedback);
}

/** Violations over decision steps, which are proposals that trainers judged, and motions that the critic approved. */
export function violationRatio(
  counters: Pick<Experiment["counters"], "feedback" | "auto_approved" | "violations">,
) {
  const decisions = counters.feedback + counters.auto_approved;
  return decisions === 0 ? "–" : percent(counters.violations / decisions, 1);
}

export function Counters({ counters }: { counters: Experiment["counters"] }) {
  return (
    <section className="card" aria-label={t("counters.label")}>
      <dl className="counters">
        <div>
          <dt>{t("counters.feedback")}</dt>
          <dd data-testid="count-feedback">{counters.feedback}</dd>
        </div>
        <div>
          <dt>{t("counters.goodShare")}</dt>
          <dd data-testid="count-good-share">{goodShare(counters)}</dd>
        </div>
        <div>
          <dt>{t("counters.successes")}</dt>
          <dd data-testid="count-successes">{counters.successes}</dd>
        </div>
        <div>
          <dt>{t("counters.violations")}</dt>
          <dd data-testid="count-violations" className={counters.violations > 0 ? "alarm" : undefined}>
            {counters.violations}
          </dd>
          <dd data-testid="violation-ratio" className="note">
            <small>{t("counters.ofDecisions", { ratio: violationRatio(counters) })}</small>
          </dd>
        </div>
      </dl>
    </section>
  );
}
