// All settings of an algorithm, an adapter or a teacher, folded away until somebody wants them.
import { useState } from "react";
import { type Draft, errorAt, type Part, partBase, schemaOf } from "../draft";
import type { Catalogue } from "../http";
import { t } from "../i18n";
import { differences, type Json, settingsOf } from "../schemaForm";
import type { Problem } from "../wire";
import { SettingField } from "./SettingField";

export interface SettingsPartProps {
  part: Part;
  /** Whose settings. */
  of: string;
  about: string;
  catalogue: Catalogue;
  draft: Draft;
  problem: Problem | null;
  onChange: (part: Part, name: string, value: Json) => void;
}

export function SettingsPart(props: SettingsPartProps) {
  const { part, catalogue, draft, problem } = props;
  const [text, setText] = useState("");
  const settings = settingsOf(schemaOf(catalogue, draft, part));
  const base = partBase(catalogue, draft, part);
  const changed = differences(draft[part], base);
  const count = Object.keys(changed).length;
  const wrong = settings.some(({ name }) => errorAt(problem, `${part}.${name}`));
  const preset = part === "settings" ? draft.preset : "";
  const wanted = settings.filter(({ name, description }) =>
    `${name} ${description}`.toLowerCase().includes(text.trim().toLowerCase()),
  );
  if (settings.length === 0) return null;
  return (
    <details className="card part" open={wrong || undefined} data-testid={`part-${part}`}>
      <summary>
        <span>
          {t(`create.part_${part}`)} <code>{props.of}</code>
        </span>
        <span className="soft">
          {count > 0
            ? t("create.changed", { count })
            : t("create.asPreset", { preset: preset || t("create.presetDefault") })}
        </span>
      </summary>
      <p className="soft small">{props.about}</p>
      {settings.length > 8 && (
        <input
          type="search"
          className="find-setting"
          value={text}
          aria-label={t("create.find")}
          placeholder={t("create.find")}
          onChange={(event) => setText(event.target.value)}
          onKeyDown={(event) => event.key === "Enter" && event.preventDefault()}
        />
      )}
      <div className="settings">
        {wanted.map((setting) => (
          <SettingField
            // another algorithm's, or another preset's, setting of the same name is another field
            key={`${props.of} ${preset} ${setting.name}`}
            setting={setting}
            value={draft[part][setting.name] ?? base[setting.name] ?? null}
            base={base[setting.name] ?? null}
            preset={preset}
            error={errorAt(problem, `${part}.${setting.name}`)}
            onChange={(value) => props.onChange(part, setting.name, value)}
          />
        ))}
        {wanted.length === 0 && <p className="soft">{t("create.foundNone")}</p>}
      </div>
    </details>
  );
}
