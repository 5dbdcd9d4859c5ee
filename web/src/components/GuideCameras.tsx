// What a calibration's cameras see, and what its result is worth.
import { t } from "../i18n";
import { decimal } from "../i18n/numbers";
import type { GuideOutcome, GuideStep } from "../wire";

export function GuideCameras({ step }: { step: GuideStep }) {
  return (
    <div className="calibrating-cameras">
      {step.cameras.map(({ camera, found, taken, jpeg }) => {
        const seen = t(found ? "cameras.found" : "cameras.notFound");
        return (
          <figure key={camera} data-testid={`guide-${camera}`} data-found={found}>
            <img src={`data:image/jpeg;base64,${jpeg}`} alt={t("cameras.picture", { camera, seen })} />
            <figcaption>
              <b>{camera}</b> <span className={found ? "soft" : "warning-text"}>{seen}</span>{" "}
              <span data-testid="taken">{t("cameras.taken", { taken, wanted: step.wanted })}</span>
              <progress
                max={step.wanted}
                value={taken}
                aria-label={t("cameras.taken", { taken, wanted: step.wanted })}
              />
            </figcaption>
          </figure>
        );
      })}
    </div>
  );
}

export function GuideWorth(props: { outcome: GuideOutcome; busy: boolean; onStore: () => void }) {
  const { cameras, apart_mm, stored } = props.outcome;
  return (
    <section className="card calibrating" aria-label={t("cameras.result")} data-testid="guide-result">
      <h2>{t("cameras.result")}</h2>
      <ul>
        {cameras.map(({ camera, error_mm, poses, left_out, good }) => (
          <li key={camera} className={good ? undefined : "warning-text"}>
            {t("cameras.worth", { camera, error: decimal(error_mm, 1), poses })}{" "}
            {t(good ? "cameras.good" : "cameras.poor")}
            {left_out > 0 && ` ${t("cameras.leftOut", { number: left_out })}`}
          </li>
        ))}
        {apart_mm !== null && <li>{t("cameras.apart", { apart: decimal(apart_mm, 1) })}</li>}
      </ul>
      {stored ? (
        <p role="status" data-testid="guide-stored">
          {t("cameras.stored")}
        </p>
      ) : (
        <>
          <p>{t("cameras.away")}</p>
          <button
            type="button"
            className="button primary"
            disabled={props.busy}
            data-testid="guide-store"
            onClick={props.onStore}
          >
            {t("cameras.store")}
          </button>
        </>
      )}
    </section>
  );
}
