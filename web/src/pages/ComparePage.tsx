// Several experiments in one chart, grouped to means over their seeds, beside the paper's own curves.

import { useCallback, useEffect, useMemo, useState } from "react";
import { type Compared, comparedIn, figuresOf, pictureOfComparison, searchOf } from "../comparing";
import { ChartCard } from "../components/ChartCard";
import { CompareTable } from "../components/CompareTable";
import { CompareTools } from "../components/CompareTools";
import { Header } from "../components/Header";
import { ProblemBanner } from "../components/ProblemBanner";
import * as http from "../http";
import { t } from "../i18n";
import { Link, setSearch, useSearch } from "../router";
import { usePolled } from "../usePolled";
import type { Experiment, PaperFigures } from "../wire";

const REFRESH_MS = 5000;
const HEIGHT = 380;

function useAll(ids: number[]): Experiment[] {
  const [found, setFound] = useState<Experiment[]>([]);
  const wanted = ids.join();
  useEffect(() => {
    let gone = false;
    const asked = wanted.split(",").filter(Boolean).map(Number);
    Promise.allSettled(asked.map(http.experiment)).then((answers) => {
      if (!gone) setFound(answers.flatMap((each) => (each.status === "fulfilled" ? [each.value] : [])));
    });
    return () => {
      gone = true;
    };
  }, [wanted]);
  return found;
}

function usePaper(): PaperFigures | null {
  const [paper, setPaper] = useState<PaperFigures | null>(null);
  useEffect(() => {
    http.paperFigures().then(setPaper, () => undefined); // without it only ours are drawn
  }, []);
  return paper;
}

function Empty() {
  return (
    <div className="empty" data-testid="nothing-to-compare">
      <h2>{t("compare.empty")}</h2>
      <p>{t("compare.emptyWhat")}</p>
      <Link to="/" className="button primary">
        {t("common.allExperiments")}
      </Link>
    </div>
  );
}

export function ComparePage() {
  const search = useSearch();
  const compared = useMemo(() => comparedIn(search), [search]);
  useEffect(() => {
    document.title = `${t("compare.title")} · SEED`;
  }, []);
  return (
    <>
      <Header back />
      <main className="page" data-testid="comparison">
        <div className="title-row">
          <h1 className="title-text">{t("compare.title")}</h1>
        </div>
        {compared.experiments.length === 0 ? (
          <Empty />
        ) : (
          <Comparing compared={compared} onChange={(next) => setSearch(searchOf(next))} />
        )}
      </main>
    </>
  );
}

function Comparing({ compared, onChange }: { compared: Compared; onChange: (next: Compared) => void }) {
  const { measure } = compared;
  const key = searchOf(compared).toString();
  const ask = useCallback(() => {
    const wanted = comparedIn(key);
    return http.comparison(wanted.experiments, wanted.measure, wanted.by);
  }, [key]);
  const { value: comparison, problem } = usePolled(ask, REFRESH_MS);
  const paper = usePaper();
  const experiments = useAll(compared.experiments);
  const figures = figuresOf(paper, measure);
  const figure = figures.find(({ scenario }) => scenario === compared.paper);
  const current = comparison?.measure === measure ? comparison : null;
  const picture = useMemo(() => (current ? pictureOfComparison(current, figure) : null), [current, figure]);
  const missing = experiments.filter(({ id }) => current?.missing.includes(id)).map(({ name }) => name);
  return (
    <>
      <CompareTools compared={compared} figures={figures} onChange={onChange} />
      {problem && <ProblemBanner problem={problem} />}
      {!picture && !problem && (
        <div className="skeleton tall" role="status" aria-label={t("common.loading")} />
      )}
      {picture && picture.lines.length === 0 && <p className="empty-chart card">{t("compare.nothingYet")}</p>}
      {picture && picture.lines.length > 0 && (
        <ChartCard picture={picture} smoothing={0} fileName="comparison" height={HEIGHT} />
      )}
      {figure && (
        <p className="soft small" data-testid="paper-note">
          {[paper?.source, figure.note].filter(Boolean).join(". ")}
        </p>
      )}
      {missing.length > 0 && (
        <p className="soft small">{t("compare.missing", { names: missing.join(", ") })}</p>
      )}
      <CompareTable
        experiments={experiments}
        onRemove={(id) =>
          onChange({ ...compared, experiments: compared.experiments.filter((each) => each !== id) })
        }
      />
    </>
  );
}
