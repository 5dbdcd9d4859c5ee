// One study, live: its curves over the paper's, its runs, and what it leaves behind.

import { useCallback, useEffect } from "react";
import { Header } from "../components/Header";
import { ProblemBanner } from "../components/ProblemBanner";
import { ProblemCard } from "../components/ProblemCard";
import { StudyChart, StudyLegend } from "../components/StudyChart";
import { StudyProgress, studyState } from "../components/StudyProgress";
import { StudyRuns } from "../components/StudyRuns";
import * as http from "../http";
import { t } from "../i18n";
import { notesOf } from "../studyLines";
import { usePolled } from "../usePolled";
import type { Study, StudyScenario } from "../wire";

const REFRESH_MS = 2000;

function Scenario({ study, scenario }: { study: Study; scenario: StudyScenario }) {
  return (
    <section className="card study-scenario" aria-label={scenario.title} data-testid="scenario">
      <h2>{scenario.title}</h2>
      {scenario.curves.length > 0 ? (
        <StudyChart scenario={scenario} />
      ) : (
        <p className="empty-chart">{t("studies.curvesLater")}</p>
      )}
      <StudyLegend scenario={scenario} />
      {scenario.curves.length > 0 && (
        <p className="soft small" data-testid="study-notes">
          {notesOf(scenario).join(" ")}
        </p>
      )}
      <p className="soft small">{scenario.caption}</p>
      <StudyRuns scenario={scenario} runs={study.run_list.filter((run) => run.scenario === scenario.name)} />
    </section>
  );
}

function Files({ study }: { study: Study }) {
  const figures = study.files.filter((file) => file.endsWith(".png"));
  const rest = study.files.filter((file) => !file.endsWith(".png"));
  if (study.files.length === 0) return null;
  return (
    <section className="card" aria-label={t("studies.files")} data-testid="files">
      <h2>{t("studies.files")}</h2>
      <div className="study-figures">
        {figures.map((file) => (
          <a key={file} href={http.studyFile(study.name, file)} download={file}>
            <img src={http.studyFile(study.name, file)} alt={t("studies.figure", { file })} loading="lazy" />
          </a>
        ))}
      </div>
      <div className="actions">
        {[...figures, ...rest].map((file) => (
          <a key={file} className="button" href={http.studyFile(study.name, file)} download={file}>
            {file}
          </a>
        ))}
      </div>
    </section>
  );
}

export function StudyPage({ name }: { name: string }) {
  const ask = useCallback(() => http.study(name), [name]);
  const { value: study, problem } = usePolled(ask, REFRESH_MS);
  useEffect(() => {
    document.title = `${name} · SEED`;
  }, [name]);
  if (!study && problem) return <ProblemCard problem={problem} />;
  return (
    <>
      <Header back />
      <main className="page narrow studies">
        <div className="title-row">
          <div className="title-text">
            <div className="title-line">
              <h1>{name}</h1>
              {study && <StudyProgress state={studyState(study)} />}
            </div>
            {study && (
              <p className="soft">
                {t("studies.summary", {
                  study: study.study,
                  adapter: study.adapter,
                  finished: study.finished,
                  runs: study.runs,
                  done: `${Math.floor(100 * study.done)} %`,
                })}
              </p>
            )}
          </div>
        </div>
        {problem && <ProblemBanner problem={problem} />}
        {study && studyState(study) === "interrupted" && (
          <div className="banner">
            <div>
              <b>{t("studies.noProcess")}</b> {t("studies.goOn")}{" "}
              <code>{`seed study ${study.study} --resume --out …/studies/${name}`}</code>
            </div>
          </div>
        )}
        {!study && <div className="skeleton" role="status" aria-label={t("common.loading")} />}
        {study?.scenarios.map((scenario) => (
          <Scenario key={scenario.name} study={study} scenario={scenario} />
        ))}
        {study && <Files study={study} />}
      </main>
    </>
  );
}
