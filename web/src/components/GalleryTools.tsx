// What narrows the gallery.
import { CHOICES, type Choice } from "../gallery";
import { skillName, t } from "../i18n";
import { changed } from "../listing";

export interface GalleryToolsProps {
  narrowed: URLSearchParams;
  skills: string[];
  onChange: (narrowed: URLSearchParams) => void;
}

export function GalleryTools({ narrowed, skills, onChange }: GalleryToolsProps) {
  return (
    <search className="list-tools" aria-label={t("gallery.narrow")}>
      <select
        aria-label={t("gallery.skill")}
        data-testid="narrow-skill"
        data-set={narrowed.has("skill")}
        value={narrowed.get("skill") ?? ""}
        onChange={(event) => onChange(changed(narrowed, "skill", event.target.value))}
      >
        <option value="">{t("gallery.any_skill")}</option>
        {skills.map((skill) => (
          <option key={skill} value={skill}>
            {skillName(skill)}
          </option>
        ))}
      </select>
      {(Object.keys(CHOICES) as Choice[]).map((choice) => (
        <select
          key={choice}
          aria-label={t(`gallery.${choice}`)}
          data-testid={`narrow-${choice}`}
          data-set={narrowed.has(choice)}
          value={narrowed.get(choice) ?? ""}
          onChange={(event) => onChange(changed(narrowed, choice, event.target.value))}
        >
          <option value="">{t(`gallery.any_${choice}`)}</option>
          {CHOICES[choice].map((value) => (
            <option key={value} value={value}>
              {t(`gallery.${choice}_${value}` as "gallery.verdict_good")}
            </option>
          ))}
        </select>
      ))}
    </search>
  );
}
