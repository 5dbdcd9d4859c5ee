// On every page but the experiment's own: an emergency stop that was asked for there, and how it goes.
import { useSyncExternalStore } from "react";
import { t } from "../i18n";
import { Link } from "../router";
import { type Stop, stops } from "../stops";

const WORDS = {
  asked: ["halt.asking", "halt.askingWhat"],
  unreachable: ["halt.unconfirmed", "halt.unconfirmedWhat"],
  confirmed: ["halt.stopped", "halt.confirmedWhat"],
  refused: ["halt.refused", "halt.refusedWhat"],
} as const;

export function StopsElsewhere() {
  const told = useSyncExternalStore(stops.subscribe, stops.elsewhere);
  if (told.length === 0) return null;
  return (
    <aside className="stops-elsewhere" aria-label={t("halt.label")}>
      {told.map((stop) => (
        <Told key={stop.id} stop={stop} />
      ))}
    </aside>
  );
}

function Told({ stop: { id, state } }: { stop: Stop }) {
  const [title, text] = WORDS[state];
  const over = state === "confirmed" || state === "refused";
  return (
    <div className="banner" role="alert" data-testid="stop-elsewhere" data-state={state}>
      <div>
        <b>{t(title)}</b> {t(text)}
      </div>
      <div className="actions">
        <Link to={`/experiments/${id}`} className="button">
          {t("halt.open")}
        </Link>
        {over && (
          <button type="button" className="button quiet" onClick={() => stops.forget(id)}>
            {t("common.dismiss")}
          </button>
        )}
      </div>
    </div>
  );
}
