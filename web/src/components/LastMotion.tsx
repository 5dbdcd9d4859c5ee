// What the robot did last: how it ended, slow motion on demand, and what a person saw, where a robot can't tell.
import { useState } from "react";
import type { Entry } from "../history";
import { skillName, t } from "../i18n";
import type { Recording } from "../recording";
import type { Reported } from "../wire";
import { Dialog } from "./Dialog";
import { Player } from "./Player";

const REPORTS: Reported[] = ["success", "failed", "damage", "needs_reset"];

export interface LastMotionProps {
  /** The newest proposal of the shown robot that was executed to its end. */
  last: Entry | null;
  recording: Recording;
  onReport: (executionId: number, outcome: Reported) => void;
}

export function LastMotion({ last, recording, onReport }: LastMotionProps) {
  const [replaying, setReplaying] = useState<number | null>(null);
  const execution = last?.execution;
  if (!execution?.outcome) return null;
  const shots = recording.of(execution.robot, execution.id);
  const reported = execution.reports.at(-1)?.outcome;
  const name = skillName(execution.skill);
  return (
    <section className="card last-motion" aria-label={t("motion.title")} data-testid="last-motion">
      <div>
        <h2>{t("motion.title")}</h2>
        <p>
          <b>{name}</b>{" "}
          <span data-tone={execution.outcome === "succeeded" ? "good" : "bad"}>
            {t(`history.outcome_${execution.outcome}`)}
          </span>
          {execution.end_reason && execution.outcome !== "succeeded" && (
            <span className="soft">{` · ${execution.end_reason.replaceAll("_", " ")}`}</span>
          )}
        </p>
      </div>
      <button
        type="button"
        className="button"
        disabled={shots.length === 0}
        title={shots.length === 0 ? t("motion.unseen") : undefined}
        data-testid="replay"
        onClick={() => setReplaying(execution.id)}
      >
        {t("motion.replay")}
      </button>
      <fieldset className="reports" aria-label={t("motion.report")}>
        <legend className="soft">{t("motion.report")}</legend>
        {REPORTS.map((outcome) => (
          <button
            key={outcome}
            type="button"
            className="tool"
            aria-pressed={reported === outcome}
            data-testid={`report-${outcome}`}
            onClick={() => onReport(execution.id, outcome)}
          >
            {t(`motion.${outcome}`)}
          </button>
        ))}
      </fieldset>
      {replaying === execution.id && (
        <Dialog title={t("motion.of", { skill: name })} wide onClose={() => setReplaying(null)}>
          <Player shots={shots} />
          <div className="actions">
            <button type="button" className="button" onClick={() => setReplaying(null)}>
              {t("common.close")}
            </button>
          </div>
        </Dialog>
      )}
    </section>
  );
}
