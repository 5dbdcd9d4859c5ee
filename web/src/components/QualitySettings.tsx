// How trainers are checked in this experiment: hidden known answers, and practice before clicks count.

import * as http from "../http";
import { t } from "../i18n";
import { percent } from "../i18n/numbers";
import type { Experiment, Problem } from "../wire";
import { Choice } from "./Field";

const RATES = [0, 0.02, 0.05, 0.1, 0.2];
const DEFAULT = { proposals: 10, accuracy: 0.8 };

/** Those on offer, and the one that is set by other means. */
function rates(now: number): { value: string; label: string }[] {
  return [...new Set([...RATES, now])]
    .sort((one, other) => one - other)
    .map((rate) => ({ value: String(rate), label: rate === 0 ? t("quality.off") : percent(rate) }));
}

export function QualitySettings(props: { experiment: Experiment; onProblem: (problem: Problem) => void }) {
  const { id, gold_rate: rate, practice_required: required } = props.experiment;
  const bar = required ?? DEFAULT;
  const set = (change: http.QualityChange) =>
    void http.setQuality(id, change).catch((error: unknown) => props.onProblem(http.problemOf(error)));
  return (
    <div className="form">
      <Choice
        label={t("quality.goldRate")}
        name="gold_rate"
        value={String(rate)}
        options={rates(rate)}
        onChange={(value) => set({ gold_rate: Number(value) })}
      />
      <Choice
        label={t("quality.practice")}
        name="practice_required"
        value={required ? "on" : "off"}
        options={[
          { value: "off", label: t("quality.off") },
          {
            value: "on",
            label: t("quality.practiceBar", { accuracy: percent(bar.accuracy), proposals: bar.proposals }),
          },
        ]}
        onChange={(value) => set({ practice_required: value === "on" ? bar : null })}
      />
      <p className="soft wide">{t("quality.goldWhat")}</p>
    </div>
  );
}
