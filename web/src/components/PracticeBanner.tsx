// Tells a trainer that their clicks don't count yet, and leads to the practice that changes that.

import * as http from "../http";
import { t } from "../i18n";
import { Link } from "../router";
import { useLatest } from "../useLatest";
import type { Experiment } from "../wire";

export function PracticeBanner({ experiment }: { experiment: Experiment }) {
  const { id, practice_required: required, teacher } = experiment;
  const progress = useLatest(() => http.practiceProgress(id), `${id}:${JSON.stringify(required)}`);
  if (!required || teacher || !progress || progress.counts) return null;
  return (
    <section className="banner calm" aria-label={t("practice.title")} data-testid="practise-first">
      <div>
        <b>{t("practice.first")}</b> {t("practice.firstWhy")}
      </div>
      <Link to={`/experiments/${id}/practice`} className="button primary">
        {t("practice.start")}
      </Link>
    </section>
  );
}
