import { useEffect } from "react";
import { t } from "../i18n";
import type { Notice } from "../state";

const READ_MS = { info: 6000, good: 6000, warning: 12_000 };

/** Short news in a corner; errors stay until they are dismissed. */
export function Notices({ notices, onDismiss }: { notices: Notice[]; onDismiss: (id: number) => void }) {
  return (
    <section className="notices" aria-live="polite" aria-label={t("notice.label")} data-testid="notices">
      {notices.map((notice) => (
        <Toast key={notice.id} notice={notice} onDismiss={onDismiss} />
      ))}
    </section>
  );
}

function Toast({ notice, onDismiss }: { notice: Notice; onDismiss: (id: number) => void }) {
  useEffect(() => {
    if (notice.tone === "error") return;
    const timer = setTimeout(() => onDismiss(notice.id), READ_MS[notice.tone]);
    return () => clearTimeout(timer);
  }, [notice.tone, notice.id, onDismiss]);
  return (
    <div className="notice" data-tone={notice.tone}>
      <p>{notice.text}</p>
      <button type="button" aria-label={t("common.dismiss")} onClick={() => onDismiss(notice.id)}>
        ×
      </button>
    </div>
  );
}
