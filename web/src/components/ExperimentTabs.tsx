// From one page of an experiment to its others.
import { t } from "../i18n";
import { Link } from "../router";

export const PAGES = ["judge", "results", "gallery", "critic"] as const;
export type ExperimentPage = (typeof PAGES)[number];

export function ExperimentTabs({ id, here }: { id: number; here: ExperimentPage }) {
  return (
    <nav className="tabs" aria-label={t("nav.label")}>
      {PAGES.map((page) => (
        <Link
          key={page}
          to={page === "judge" ? `/experiments/${id}` : `/experiments/${id}/${page}`}
          current={page === here}
        >
          {t(`nav.${page}`)}
        </Link>
      ))}
    </nav>
  );
}
