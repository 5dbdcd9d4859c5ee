// Whether what a trainer approves moves the robot. Two buttons, not radios: the arrow keys judge on this page.
import { t } from "../i18n";
import type { Mode } from "../wire";

const MODES: Mode[] = ["propose_only", "execute_approved"];

export function ModeSwitch({ mode, onChange }: { mode: Mode; onChange: (mode: Mode) => void }) {
  return (
    <section className="card" aria-label={t("mode.label")}>
      <fieldset className="segments" aria-label={t("mode.what")}>
        {MODES.map((each) => (
          <button
            key={each}
            type="button"
            aria-pressed={mode === each}
            data-testid={`mode-${each}`}
            onClick={() => mode !== each && onChange(each)}
          >
            {t(`mode.${each}`)}
          </button>
        ))}
      </fieldset>
      <p className="hint">{t(`mode.${mode}_what`)}</p>
    </section>
  );
}
