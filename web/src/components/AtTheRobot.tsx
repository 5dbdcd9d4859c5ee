// At a real robot: how the arm is in words, whether an operator attends it, and what only they may ask of it.
import { useEffect, useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { ME } from "../me";
import { Link } from "../router";
import type { Session } from "../session";
import { useOperator, useTold } from "../telling";
import type { Experiment } from "../wire";

/** Seconds until the service counts an operator as gone, and between two words to it. */
const LEASE = 4;
const AGAIN = 1;

/** Says again and again that somebody attends; what was asked of the page ends with it. */
function useAttending(session: Session): [boolean, (attending: boolean) => void] {
  const [attending, setAttending] = useState(false);
  const { id, tellOf } = session;
  useEffect(() => {
    if (!attending) return;
    const say = () =>
      http.attend(id, ME, LEASE).catch((error) => {
        setAttending(false);
        tellOf(http.problemOf(error));
      });
    void say();
    const timer = setInterval(say, 1000 * AGAIN);
    return () => {
      clearInterval(timer);
      http.leave(id, ME).catch(() => undefined); // it lapses by itself
    };
  }, [attending, id, tellOf]);
  return [attending, setAttending];
}

export function AtTheRobot({ session, experiment }: { session: Session; experiment: Experiment }) {
  const told = useTold(session.telling, 0);
  const operator = useOperator(session.telling);
  const [attending, setAttending] = useAttending(session);
  const mode = told?.mode ?? null;
  const still = experiment.lifecycle !== "running";
  return (
    <div className="at-the-robot">
      {mode && (
        <p
          className={["idle", "moving"].includes(mode) ? "soft" : "warning-text"}
          data-testid="arm-state"
          data-mode={mode}
        >
          {t(`operator.mode_${mode}`)}
        </p>
      )}
      <label className="check">
        <input
          type="checkbox"
          data-testid="attend"
          checked={attending}
          onChange={(event) => setAttending(event.target.checked)}
        />
        {t("operator.attend")}
      </label>
      <p className="hint" data-testid="attended-by">
        {operator ? t("operator.attendedBy", { name: operator }) : t("operator.attendedByNobody")}
      </p>
      <div className="actions">
        <button
          type="button"
          className="button"
          data-testid="home"
          disabled={!still || operator !== ME || experiment.halted}
          onClick={() => void session.tend("home")}
        >
          {t("operator.home")}
        </button>
        <button
          type="button"
          className="button"
          data-testid="recover"
          disabled={!still || operator !== ME}
          onClick={() => void session.tend("recover")}
        >
          {t("operator.recover")}
        </button>
        {still && (
          <Link to={`/experiments/${experiment.id}/cameras`} className="button" testId="calibrate-cameras">
            {t("operator.calibrate")}
          </Link>
        )}
      </div>
    </div>
  );
}
