import { t } from "../i18n";
import type { Mode } from "../wire";

const MODES: Mode[] = ["propose_only", "execute_approved"];

export function ModeSwitch({ mode, onChange }: { mode: Mode; onChange: (mode: Mode) => void }) {
  return (
    <section className="card" aria-label={t("mode.label")}>
      <fieldset className="segments" aria-label={t("mode.what")}>
        {MODES.map((each) => (
          <label key={each}>
            <input
              type="radio"
              name="mode"
              checked={mode === each}
              onChange={() => onChange(each)}
              data-testid={`mode-${each}`}
            />
            {t(`mode.${each}`)}
          </label>
        ))}
      </fieldset>
      <p className="hint">{t(`mode.${mode}_what`)}</p>
    </section>
  );
}
