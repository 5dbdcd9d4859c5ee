// The emergency stop: a fixed button above everything, and Esc twice from any focus.

import { useEffect, useEffectEvent } from "react";
import { createPortal } from "react-dom";
import { t } from "../i18n";
import { Octagon } from "./icons";

const TWICE_WITHIN_MS = 600;

export function StopButton({ stopping, onStop }: { stopping: boolean; onStop: () => void }) {
  const stop = useEffectEvent(onStop);
  useEffect(() => {
    let first = Number.NEGATIVE_INFINITY;
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== "Escape" || event.repeat) return;
      if (event.timeStamp - first <= TWICE_WITHIN_MS) {
        first = Number.NEGATIVE_INFINITY;
        stop();
      } else {
        first = event.timeStamp;
      }
    };
    // Capturing on the window: nothing on the page can swallow it.
    window.addEventListener("keydown", onKey, true);
    return () => window.removeEventListener("keydown", onKey, true);
  }, []);
  return createPortal(
    <aside aria-label={t("halt.label")}>
      <button
        type="button"
        className="stop"
        data-testid="halt"
        onClick={onStop}
        aria-label={t("halt.label")}
        aria-keyshortcuts="Escape Escape"
        title={t("halt.title")}
      >
        <Octagon />
        {stopping ? t("halt.stopping") : t("halt.stop")}
        {!stopping && (
          <span className="key" aria-hidden="true">
            Esc Esc
          </span>
        )}
      </button>
    </aside>,
    document.body,
  );
}
