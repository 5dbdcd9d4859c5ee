// One setting as its schema describes it: what it means, its bounds, its default, and whether it was changed.
import { useId, useState } from "react";
import { t } from "../i18n";
import { intervalOf, type Json, readAs, type Setting, shownAs } from "../schemaForm";

export interface SettingFieldProps {
  setting: Setting;
  value: Json;
  /** What it is as long as nobody changes it. */
  base: Json;
  /** Where that comes from: a preset's name, or nothing. */
  preset: string;
  error: string | undefined;
  onChange: (value: Json) => void;
}

function wordOf(setting: Setting, value: Json): string {
  if (value === null || value === "") return t("create.nothing");
  return setting.kind === "boolean"
    ? t(value ? "create.yes" : "create.no")
    : shownAs(value).replace("-", "−");
}

export function SettingField(props: SettingFieldProps) {
  const { setting, value, base, error } = props;
  const id = useId();
  const changed = JSON.stringify(value) !== JSON.stringify(base);
  const interval = intervalOf(setting);
  return (
    <div className="setting" data-changed={changed} data-testid={`setting-${setting.name}`}>
      <div className="setting-head">
        <label htmlFor={id}>
          <code>{setting.name}</code>
        </label>
        {changed && (
          <button
            type="button"
            className="reset"
            aria-label={t("create.resetOf", { name: setting.name })}
            onClick={() => props.onChange(base)}
          >
            {t("create.reset", { value: wordOf(setting, base) })}
          </button>
        )}
      </div>
      <Control {...props} id={id} />
      <p className="about" id={`${id}-about`}>
        {setting.description}
        <span className="bounds">
          {[
            interval,
            t(props.preset ? "create.inPreset" : "create.default", { value: wordOf(setting, base) }),
          ]
            .filter(Boolean)
            .join(" · ")}
        </span>
      </p>
      {error && (
        <p className="error" id={`${id}-error`} role="alert">
          {error}
        </p>
      )}
    </div>
  );
}

function Control({ id, setting, value, error, onChange }: SettingFieldProps & { id: string }) {
  const [text, setText] = useState(shownAs(value));
  const shown = JSON.stringify(readAs(setting, text)) === JSON.stringify(value) ? text : shownAs(value);
  const shared = {
    id,
    name: setting.name,
    "aria-invalid": Boolean(error),
    "aria-describedby": error ? `${id}-error ${id}-about` : `${id}-about`,
  };
  if (setting.kind === "boolean")
    return (
      <label className="switch">
        <input
          {...shared}
          type="checkbox"
          checked={value === true}
          onChange={(event) => onChange(event.target.checked)}
        />
        <span aria-hidden="true">{t(value ? "create.yes" : "create.no")}</span>
      </label>
    );
  if (setting.kind === "choice")
    return (
      <select
        {...shared}
        value={shownAs(value)}
        onChange={(event) => onChange(readAs(setting, event.target.value))}
      >
        {setting.nullable && <option value="">{t("create.nothing")}</option>}
        {setting.choices.map((choice) => (
          <option key={choice} value={choice}>
            {choice}
          </option>
        ))}
      </select>
    );
  return (
    <input
      {...shared}
      value={shown}
      inputMode={setting.kind === "number" || setting.kind === "integer" ? "decimal" : "text"}
      autoComplete="off"
      spellCheck={false}
      placeholder={setting.nullable ? t("create.nothing") : undefined}
      onChange={(event) => {
        setText(event.target.value);
        onChange(readAs(setting, event.target.value));
      }}
    />
  );
}
