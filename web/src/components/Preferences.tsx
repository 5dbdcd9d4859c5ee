// How the page looks and speaks in this browser: colours and language, remembered.
import { useState } from "react";
import { signOut } from "../http";
import { chooseLanguage, LANGUAGES, nameOf, t, useLanguage } from "../i18n";
import { isName, LOGIN, ME, ROLE, rename, signedOut } from "../me";
import { change, RESTS, useSettings } from "../settings";
import { chooseTheme, THEMES, useTheme } from "../theme";
import { Dialog } from "./Dialog";
import { Choice, Field } from "./Field";
import { Sliders } from "./icons";

/** Whose clicks this page sends, where nobody signs in. */
function Name() {
  const [name, setName] = useState(ME);
  const wrong = !isName(name.trim());
  return (
    <form
      className="name"
      onSubmit={(event) => {
        event.preventDefault();
        if (!wrong) rename(name.trim());
      }}
    >
      <Field
        label={t("settings.name")}
        name="trainer"
        value={name}
        error={wrong ? t("settings.nameWrong") : undefined}
        onChange={setName}
      />
      <button type="submit" className="button" disabled={wrong || name.trim() === ME} data-testid="rename">
        {t("common.set")}
      </button>
      <p className="hint">{t("settings.nameWhat")}</p>
    </form>
  );
}

/** Who is signed in, and the way out. */
function Account() {
  const leave = () => void signOut().then(signedOut, signedOut);
  return (
    <div className="name">
      <p data-testid="account">
        {t("people.youAre", { name: ME, role: t(`people.role_${ROLE ?? "viewer"}`) })}
      </p>
      <button type="button" className="button" onClick={leave} data-testid="sign-out">
        {t("people.signOut")}
      </button>
    </div>
  );
}

function Panel({ onClose }: { onClose: () => void }) {
  const chosen = useTheme();
  const language = useLanguage();
  const judging = useSettings();
  return (
    <Dialog title={t("settings.title")} onClose={onClose}>
      <div className="preferences">
        <div className="field">
          <span id="theme-label">{t("settings.theme")}</span>
          <fieldset className="segments" aria-labelledby="theme-label">
            {THEMES.map((theme) => (
              <label key={theme}>
                <input
                  type="radio"
                  name="theme"
                  checked={chosen === theme}
                  onChange={() => chooseTheme(theme)}
                  data-testid={`theme-${theme}`}
                />
                {t(`settings.${theme}`)}
              </label>
            ))}
          </fieldset>
        </div>
        {LOGIN ? <Account /> : <Name />}
        <Choice
          label={t("settings.language")}
          name="language"
          value={language}
          options={LANGUAGES.map((tag) => ({ value: tag, label: nameOf(tag) }))}
          onChange={(tag) => void chooseLanguage(tag)}
        />
        <fieldset className="checks">
          <legend>{t("settings.judging")}</legend>
          {(["sound", "haptic"] as const).map((name) => (
            <label key={name}>
              <input
                type="checkbox"
                checked={judging[name]}
                onChange={(event) => change({ [name]: event.target.checked })}
                data-testid={`cue-${name}`}
              />
              {t(`settings.${name}`)}
            </label>
          ))}
        </fieldset>
        <Choice
          label={t("settings.rest")}
          name="rest"
          value={String(judging.restAfter)}
          options={RESTS.map((minutes) => ({
            value: String(minutes),
            label: minutes ? t("settings.minutes", { count: minutes }) : t("settings.never"),
          }))}
          onChange={(minutes) => change({ restAfter: Number(minutes) })}
        />
      </div>
      <div className="actions">
        <button type="button" className="button primary" onClick={onClose} data-testid="preferences-done">
          {t("common.done")}
        </button>
      </div>
    </Dialog>
  );
}

export function Preferences() {
  const [open, setOpen] = useState(false);
  return (
    <>
      <button
        type="button"
        className="icon-button"
        aria-label={t("header.settings")}
        title={t("header.settings")}
        data-testid="preferences"
        onClick={() => setOpen(true)}
      >
        <Sliders />
      </button>
      {open && <Panel onClose={() => setOpen(false)} />}
    </>
  );
}
