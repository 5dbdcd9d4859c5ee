// What went wrong, newest first, each with the video of the seconds before.
import { useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { moment } from "../i18n/numbers";
import { useLatest } from "../useLatest";
import type { Incident } from "../wire";
import { Dialog } from "./Dialog";
import { Player } from "./Player";

const shotsOf = ({ frames }: Incident) =>
  frames.map(({ camera, taken_at, width, height, url }) => ({
    camera,
    at: taken_at,
    width,
    height,
    source: url,
  }));

function Opened({ incident, onClose }: { incident: Incident; onClose: () => void }) {
  const [shots] = useState(() => shotsOf(incident));
  return (
    <Dialog title={t(`incidents.${incident.kind}`)} wide onClose={onClose}>
      <p className="soft">{`${moment(incident.at)} · ${incident.detail}`}</p>
      {shots.length > 0 ? <Player shots={shots} /> : <p className="hint">{t("incidents.noVideo")}</p>}
      <div className="actions">
        <button type="button" className="button" onClick={onClose} data-first={shots.length === 0}>
          {t("common.close")}
        </button>
      </div>
    </Dialog>
  );
}

/** `newest` changes when there may be another one. */
export function Incidents({ id, newest }: { id: number; newest: number }) {
  const incidents = useLatest(() => http.incidents(id), `${id}:${newest}`);
  const [open, setOpen] = useState<Incident | null>(null);
  return (
    <div className="incidents" data-testid="incidents">
      <h3>{t("incidents.title")}</h3>
      {incidents?.length ? (
        <ul>
          {incidents.map((incident) => (
            <li key={incident.id}>
              <button
                type="button"
                className="incident"
                data-testid="incident"
                onClick={() => setOpen(incident)}
              >
                <b>{t(`incidents.${incident.kind}`)}</b>
                <span className="soft">{moment(incident.at)}</span>
              </button>
            </li>
          ))}
        </ul>
      ) : (
        <p className="hint">{incidents ? t("incidents.none") : t("common.loading")}</p>
      )}
      {open && <Opened incident={open} onClose={() => setOpen(null)} />}
    </div>
  );
}
