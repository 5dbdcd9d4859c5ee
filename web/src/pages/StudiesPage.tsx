// Every study in the data directory, as far as it is; studies are run from the command line.

import { useEffect } from "react";
import { Header } from "../components/Header";
import { Sprout } from "../components/icons";
import { ProblemBanner } from "../components/ProblemBanner";
import { StudyProgress, studyState } from "../components/StudyProgress";
import * as http from "../http";
import { t } from "../i18n";
import { moment } from "../i18n/numbers";
import { Link } from "../router";
import { usePolled } from "../usePolled";
import type { StudySummary } from "../wire";

const REFRESH_MS = 2500;

function Empty() {
  return (
    <div className="empty" data-testid="no-studies">
      <Sprout />
      <h2>{t("studies.empty")}</h2>
      <p>{t("studies.emptyWhat")}</p>
      <code className="command">seed study paper-sim --adapter kinematic --seeds 3 --budget 300</code>
      <p>{t("studies.emptyHow")}</p>
    </div>
  );
}

function StudyRow({ study }: { study: StudySummary }) {
  return (
    <li className="row study-row" data-testid="study">
      <div>
        <div className="title-line">
          <h2>
            <Link to={`/studies/${encodeURIComponent(study.name)}`}>{study.name}</Link>
          </h2>
          <StudyProgress state={studyState(study)} />
        </div>
        <p className="facts">
          {study.problem ??
            `${study.study} · ${study.adapter} · ${study.created_at ? moment(study.created_at) : ""}`}
        </p>
      </div>
      <dl className="figure">
        <dt>{t("studies.done")}</dt>
        <dd>{`${Math.floor(100 * study.done)} %`}</dd>
      </dl>
      <dl className="figure">
        <dt>{t("studies.runs")}</dt>
        <dd>{`${study.finished}/${study.runs}`}</dd>
      </dl>
      <dl className="figure">
        <dt>{t("studies.failed")}</dt>
        <dd>{study.failed}</dd>
      </dl>
    </li>
  );
}

export function StudiesPage() {
  const { value, problem, refresh } = usePolled(http.studies, REFRESH_MS);
  useEffect(() => {
    document.title = `${t("studies.title")} · SEED`;
  }, []);
  return (
    <>
      <Header back />
      <main className="page narrow">
        <div className="title-row">
          <h1 className="title-text">{t("studies.title")}</h1>
        </div>
        {problem && <ProblemBanner problem={problem} onRetry={refresh} />}
        {value === null && !problem && (
          <div className="rows" role="status" aria-label={t("common.loading")}>
            <div className="skeleton" />
          </div>
        )}
        {value?.length === 0 && <Empty />}
        <ul className="rows">
          {value?.map((each) => (
            <StudyRow key={each.name} study={each} />
          ))}
        </ul>
      </main>
    </>
  );
}
