// What was right and why, in the reader's language, from the figures of the task's rule; and how practice goes.

import type { ReactNode } from "react";
import { skillName, t } from "../i18n";
import { percent, whole } from "../i18n/numbers";
import type { PracticeProgress, PracticeReason, PracticeResult, PracticeSlip } from "../wire";

function slipText({ axis, off_mm, limit_mm }: PracticeSlip): string {
  const figures = { off: whole(Math.round(Math.abs(off_mm))), limit: whole(Math.round(limit_mm)) };
  const side = axis === "place" ? "place" : (`${axis}${off_mm > 0 ? "Above" : "Below"}` as const);
  return t(`practice.slip.${side}`, figures);
}

export function reasonText(reason: PracticeReason): string {
  const { aim, skill, right_skill: right, closest, slips } = reason;
  if (reason.good && closest)
    return t("practice.why.good", {
      aim,
      off: whole(Math.round(Math.abs(closest.off_mm))),
      limit: whole(Math.round(closest.limit_mm)),
    });
  if (reason.good) return t("practice.why.goodPlain", { aim });
  if (skill !== right)
    return t("practice.why.skill", { aim, skill: skillName(skill), right: skillName(right) });
  if (reason.sideways) return t("practice.why.sideways", { aim });
  const list = slips.map(slipText).join("; ") || t("practice.why.misses");
  return t("practice.why.off", { aim, slips: list });
}

export function PracticeCorrection({ result, children }: { result: PracticeResult; children: ReactNode }) {
  const answer = t(result.right_answer > 0 ? "judge.word.good" : "judge.word.bad");
  return (
    <section
      className="correction"
      data-right={result.right}
      data-testid="correction"
      aria-label={t("practice.correction")}
    >
      <div role="status">
        <p>
          <b>{result.right ? t("practice.right") : t("practice.wrong", { answer })}</b>
        </p>
        <p data-testid="reason">{reasonText(result.reason)}</p>
      </div>
      <div className="actions">{children}</div>
    </section>
  );
}

/** What is still needed, or that it is passed. */
function standing({ required, newest, passed, counts }: PracticeProgress): string {
  if (required && counts) return t("practice.passed");
  if (!required) return passed ? t("practice.well") : t("practice.voluntary");
  return t("practice.needed", {
    accuracy: percent(required.accuracy),
    proposals: required.proposals,
    right: newest.count,
    of: newest.of,
  });
}

export function PracticeScore({ progress }: { progress: PracticeProgress }) {
  const { answered, right, required, counts } = progress;
  return (
    <section className="practice-score" aria-label={t("practice.score")} data-testid="practice-score">
      <b data-testid="score">{t("practice.count", { right, answered })}</b>
      <span className="soft" data-testid="standing" data-passed={required !== null && counts}>
        {standing(progress)}
      </span>
    </section>
  );
}
