import { t } from "../i18n";
import type { StudySummary } from "../wire";

export type StudyState = "unreadable" | "running" | "finished" | "failed" | "interrupted";

/** Where a study is, in one word. */
export function studyState(study: StudySummary): StudyState {
  if (study.problem) return "unreadable";
  if (study.live) return "running";
  if (study.finished === study.runs) return "finished";
  return study.finished + study.failed === study.runs ? "failed" : "interrupted";
}

export function StudyProgress({ state }: { state: StudyState }) {
  return (
    <span className="pill" data-state={state} data-testid="study-state">
      <span className="dot" />
      {t(`studies.state.${state}`)}
    </span>
  );
}
