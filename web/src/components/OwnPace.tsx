// How someone is doing: labels a minute, the run without a pause, and how often they say what others say.
import { useEffect, useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { decimal, percent } from "../i18n/numbers";
import { type Pace, perMinute } from "../pace";
import { useDelayed } from "../useDelayed";
import { useLatest } from "../useLatest";
import type { TrainerFigures } from "../wire";

const REFRESH_MS = 5000;
/** The service tells figures again for two seconds: what it told after the last of some quick clicks may miss them. */
const SETTLED_MS = 2500;

export function OwnPace({ id, feedback, pace }: { id: number; feedback: number; pace: Pace }) {
  const [now, setNow] = useState(() => Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNow(Date.now()), REFRESH_MS);
    return () => clearInterval(timer);
  }, []);
  // Only a click of this tab may have changed one's own figures.
  const own = useLatest<TrainerFigures | null>(
    () => (feedback > 0 ? http.ownFigures(id) : Promise.resolve(null)),
    `${id}:${Math.ceil(feedback / 5)}:${useDelayed(feedback, SETTLED_MS)}`,
  );
  const rate = perMinute(pace, Math.max(now, pace.clicks.at(-1) ?? 0));
  const agreement = own?.with_others;
  return (
    <section className="card" aria-label={t("pace.label")}>
      <dl className="counters pace">
        <div>
          <dt>{t("pace.rate")}</dt>
          <dd data-testid="pace-rate">{rate === null ? "–" : decimal(rate, rate < 10 ? 1 : 0)}</dd>
        </div>
        <div title={t("pace.streakWhat")}>
          <dt>{t("pace.streak")}</dt>
          <dd data-testid="pace-streak">{own?.streak ?? pace.streak}</dd>
        </div>
        <div title={t("pace.agreementWhat")}>
          <dt>{t("pace.agreement")}</dt>
          <dd data-testid="pace-agreement">
            {agreement && agreement.of > 0 ? percent(agreement.count / agreement.of) : "–"}
          </dd>
        </div>
      </dl>
    </section>
  );
}
