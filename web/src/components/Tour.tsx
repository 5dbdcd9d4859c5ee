// The first-run tour: one part of the page after another, ringed and explained. Nothing is covered, least of all Stop.
import { useEffect, useEffectEvent, useLayoutEffect, useRef, useState } from "react";
import { createPortal } from "react-dom";
import { t } from "../i18n";
import { change, useSettings } from "../settings";

const STEPS = [
  { name: "views", selector: "[data-testid=views]" },
  { name: "dot", selector: "[data-testid=dot]" },
  { name: "line", selector: "[data-testid=line]" },
  { name: "bar", selector: "[data-testid=bar]" },
  { name: "judge", selector: ".judge" },
  { name: "undo", selector: "[data-testid=undo]" },
  { name: "tools", selector: ".toggles" },
  { name: "agent", selector: ".thought" },
  { name: "history", selector: "[data-testid=history]" },
  { name: "stop", selector: "[data-testid=halt]" },
] as const;

interface Place {
  ring: { left: number; top: number; width: number; height: number } | null;
  card: { left: number; top?: number; bottom?: number };
}

const MARGIN = 12;
const WIDTH = 320;

/** The ring around what is explained, and the card beside it: below where there is more room, else above. */
function placeOf(selector: string): Place {
  const box = document.querySelector(selector)?.getBoundingClientRect();
  const width = Math.min(WIDTH, window.innerWidth - 2 * MARGIN);
  if (!box)
    return { ring: null, card: { left: (window.innerWidth - width) / 2, top: window.innerHeight / 3 } };
  const ring = {
    left: box.left - 6,
    top: box.top - 6,
    width: box.width + 12,
    height: box.height + 12,
  };
  const left = Math.min(
    Math.max(MARGIN, box.left + box.width / 2 - width / 2),
    window.innerWidth - width - MARGIN,
  );
  const below = window.innerHeight - box.bottom;
  if (below > 220) return { ring, card: { left, top: box.bottom + 2 * MARGIN } };
  if (box.top > 220) return { ring, card: { left, bottom: window.innerHeight - box.top + 2 * MARGIN } };
  return { ring, card: { left, bottom: MARGIN } };
}

function usePlace(selector: string): Place {
  const [place, setPlace] = useState(() => placeOf(selector));
  useLayoutEffect(() => {
    document.querySelector(selector)?.scrollIntoView({ block: "center" });
    const measure = () => setPlace(placeOf(selector));
    measure();
    window.addEventListener("resize", measure);
    window.addEventListener("scroll", measure, { passive: true });
    return () => {
      window.removeEventListener("resize", measure);
      window.removeEventListener("scroll", measure);
    };
  }, [selector]);
  return place;
}

export function Tour({ onClose }: { onClose: () => void }) {
  const [at, setAt] = useState(0);
  const step = STEPS[at] ?? STEPS[0];
  const place = usePlace(step.selector);
  const next = useRef<HTMLButtonElement>(null);
  const last = at === STEPS.length - 1;
  const close = useEffectEvent(() => {
    change({ toured: true });
    onClose();
  });
  useEffect(() => {
    const before = document.activeElement;
    document.documentElement.dataset.dialog = "open"; // so that keys don't judge
    next.current?.focus({ preventScroll: true });
    const onKey = (event: KeyboardEvent) => {
      if (event.key === "Escape") close();
      if (event.key === "ArrowRight") setAt((step) => Math.min(STEPS.length - 1, step + 1));
      if (event.key === "ArrowLeft") setAt((step) => Math.max(0, step - 1));
    };
    window.addEventListener("keydown", onKey);
    return () => {
      window.removeEventListener("keydown", onKey);
      delete document.documentElement.dataset.dialog;
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return createPortal(
    <>
      {place.ring && <div className="tour-ring" style={place.ring} aria-hidden="true" />}
      <div
        className="tour"
        role="dialog"
        aria-label={t("tour.label")}
        aria-live="polite"
        style={place.card}
        data-testid="tour-card"
        data-step={step.name}
      >
        <h2>{t(`tour.${step.name}`)}</h2>
        <p>{t(`tour.${step.name}What`)}</p>
        <div className="actions">
          <span className="soft number">{t("tour.progress", { step: at + 1, count: STEPS.length })}</span>
          <span className="spring" />
          {at > 0 && (
            <button type="button" className="button quiet" onClick={() => setAt(at - 1)}>
              {t("tour.back")}
            </button>
          )}
          <button
            type="button"
            className="button quiet"
            onClick={() => close()}
            data-testid="tour-close"
            hidden={last}
          >
            {t("tour.leave")}
          </button>
          <button
            type="button"
            className="button primary"
            ref={next}
            data-testid="tour-next"
            onClick={() => (last ? close() : setAt(at + 1))}
          >
            {last ? t("common.done") : t("tour.next")}
          </button>
        </div>
      </div>
    </>,
    document.body,
  );
}

/** Offers the tour to whoever is here for the first time. */
export function TourOffer({ onTour }: { onTour: () => void }) {
  const { toured } = useSettings();
  if (toured) return null;
  return (
    <section className="card offer" aria-label={t("tour.label")} data-testid="tour-offer">
      <p>
        <b>{t("tour.offer")}</b> {t("tour.offerWhat")}
      </p>
      <div className="actions">
        <button type="button" className="button primary" onClick={onTour}>
          {t("tour.take")}
        </button>
        <button type="button" className="button quiet" onClick={() => change({ toured: true })}>
          {t("tour.decline")}
        </button>
      </div>
    </section>
  );
}
