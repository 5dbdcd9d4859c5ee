import type { StudySummary } from "../wire";

/** Where a study is, in one word. */
export function studyState(study: StudySummary): string {
  if (study.problem) return "unreadable";
  if (study.live) return "running";
  if (study.finished === study.runs) return "finished";
  return study.finished + study.failed === study.runs ? "failed" : "interrupted";
}

export function StudyProgress({ state }: { state: string }) {
  return (
    <span className="pill" data-state={state} data-testid="study-state">
      <span className="dot" />
      {state}
    </span>
  );
}
