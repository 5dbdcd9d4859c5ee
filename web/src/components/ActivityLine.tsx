import { useEffect, useState } from "react";
import type { Activity } from "../activity";
import { t } from "../i18n";
import type { Hint } from "../useJudging";

const SETTLED_MS = 500;

/** `text` once it has stayed for a while: a screen reader shouldn't hear every blink of the loop. */
function useSettled(text: string): string {
  const [settled, setSettled] = useState("");
  useEffect(() => {
    const timer = setTimeout(() => setSettled(text), SETTLED_MS);
    return () => clearTimeout(timer);
  }, [text]);
  return settled;
}

export interface ActivityLineProps {
  activity: Activity;
  /** Number of the proposal that waits on the screen. */
  number: number | null;
  /** Why the newest press didn't count; it covers the activity for a while. */
  hint: Hint | null;
  canUndo: boolean;
  onUndo: () => void;
}

/** What is going on now, and the way back from the last click. */
export function ActivityLine({ activity, number, hint, canUndo, onUndo }: ActivityLineProps) {
  const spoken = useSettled(activity.text);
  return (
    <div className="now">
      <div className="activity" data-tone={activity.tone} data-testid="activity">
        <span className="dot" />
        <span>{activity.text}</span>
        {number !== null && <small className="number">{t("activity.proposal", { number })}</small>}
      </div>
      <p className="sr-only" aria-live="polite">
        {spoken}
      </p>
      <div className="judge-hint" aria-live="assertive" data-testid="judge-hint">
        {hint && <p key={hint.id}>{hint.text}</p>}
      </div>
      <button
        type="button"
        className="button quiet"
        data-testid="undo"
        disabled={!canUndo}
        aria-keyshortcuts="U Control+Z"
        onClick={onUndo}
      >
        {t("common.undo")}
        <span className="key keys" aria-hidden="true">
          U
        </span>
      </button>
    </div>
  );
}
