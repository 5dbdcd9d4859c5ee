// One experiment's charts, live: how well it does, what the critic learns, how fast people judge.

import { useEffect, useMemo } from "react";
import { pictureOf } from "../charting";
import { CalibrationPanel } from "../components/Calibration";
import { ChartCard } from "../components/ChartCard";
import { ConnectionState } from "../components/ConnectionState";
import { goodShare, violationRatio } from "../components/Counters";
import { factsOf } from "../components/ExperimentRow";
import { ExperimentTabs } from "../components/ExperimentTabs";
import { Header } from "../components/Header";
import { Sprout } from "../components/icons";
import { ProblemBanner } from "../components/ProblemBanner";
import { ProblemCard } from "../components/ProblemCard";
import { Smoothing, useSmoothing } from "../components/Smoothing";
import { StatePill } from "../components/StatePill";
import * as http from "../http";
import { t } from "../i18n";
import { whole } from "../i18n/numbers";
import { Link } from "../router";
import { useCurves } from "../useCurves";
import type { Experiment } from "../wire";

function Figures({ experiment }: { experiment: Experiment }) {
  const { counters } = experiment;
  const figures = {
    feedback: whole(counters.feedback),
    goodShare: goodShare(counters),
    successes: whole(counters.successes),
    executions: whole(counters.executions),
    episodes: whole(counters.episodes),
    steps: whole(counters.low_level_steps),
    violations: whole(counters.violations),
    violationRatio: violationRatio(counters),
  } as const;
  return (
    <dl className="figures" data-testid="figures">
      {Object.entries(figures).map(([name, value]) => (
        <div key={name}>
          <dt>{t(`results.${name as keyof typeof figures}`)}</dt>
          <dd className="number" data-testid={`figure-${name}`}>
            {value}
          </dd>
        </div>
      ))}
    </dl>
  );
}

function Nothing({ id }: { id: number }) {
  return (
    <div className="empty" data-testid="no-curves">
      <Sprout />
      <h2>{t("results.empty")}</h2>
      <p>{t("results.emptyWhat")}</p>
      <Link to={`/experiments/${id}`} className="button primary">
        {t("nav.judge")}
      </Link>
    </div>
  );
}

export function ResultsPage({ id }: { id: number }) {
  const { experiment, curves, problem, connection } = useCurves(id);
  const [smoothing, setSmoothing] = useSmoothing();
  const pictures = useMemo(() => (curves?.charts ?? []).map(pictureOf), [curves]);
  useEffect(() => {
    if (experiment) document.title = `${experiment.name} · ${t("nav.results")} · SEED`;
  }, [experiment]);
  if (problem && !experiment) return <ProblemCard problem={problem} />;
  return (
    <>
      <Header back>
        <ConnectionState connection={connection} pending={0} />
      </Header>
      <main className="page" data-testid="results">
        <div className="title-row">
          <div className="title-text">
            <div className="title-line">
              <h1>{experiment?.name ?? t("common.loading")}</h1>
              {experiment && <StatePill experiment={experiment} />}
            </div>
            {experiment && <p className="facts">{factsOf(experiment)}</p>}
          </div>
          <Smoothing value={smoothing} onChange={setSmoothing} />
          <a className="button" href={http.metricsTable(id)} download data-testid="metrics-table">
            {t("results.table")}
          </a>
        </div>
        <ExperimentTabs id={id} here="results" />
        {problem && <ProblemBanner problem={problem} />}
        {experiment && <Figures experiment={experiment} />}
        {!curves && !problem && (
          <div className="charts" role="status" aria-label={t("common.loading")}>
            <div className="skeleton tall" />
            <div className="skeleton tall" />
          </div>
        )}
        {curves && pictures.length === 0 && <Nothing id={id} />}
        <div className="charts">
          {pictures.map((picture) => (
            <ChartCard
              key={picture.name}
              picture={picture}
              smoothing={smoothing}
              fileName={`experiment-${id}`}
            />
          ))}
          {experiment && pictures.length > 0 && <CalibrationPanel experiment={experiment} />}
        </div>
      </main>
    </>
  );
}
