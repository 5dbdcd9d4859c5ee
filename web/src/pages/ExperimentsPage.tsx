// Every experiment with its state and counters; make, start, pause, resume, finish.

import { useCallback, useEffect, useState } from "react";
import { Confirm, type Question } from "../components/Dialog";
import { ExperimentRow } from "../components/ExperimentRow";
import { Header } from "../components/Header";
import { Sprout } from "../components/icons";
import { NewExperiment } from "../components/NewExperiment";
import * as http from "../http";
import { t } from "../i18n";
import type { Experiment, Problem } from "../wire";

const REFRESH_MS = 2500;

interface List {
  items: Experiment[] | null;
  problem: Problem | null;
  more: boolean;
}

/** The experiments, newest first, kept fresh while the page is looked at. */
function useExperiments(): { list: List; refresh: () => void; showMore: () => void } {
  const [list, setList] = useState<List>({ items: null, problem: null, more: false });
  const [pages, setPages] = useState(1);
  const load = useCallback(async () => {
    try {
      const items: Experiment[] = [];
      let cursor: string | null = null;
      for (let page = 0; page < pages; page += 1) {
        const answer = await http.experiments(cursor);
        items.push(...answer.items);
        cursor = answer.next_cursor ?? null;
        if (!cursor) break;
      }
      setList({ items, problem: null, more: cursor !== null });
    } catch (error) {
      setList((before) => ({ ...before, problem: http.problemOf(error) }));
    }
  }, [pages]);
  useEffect(() => {
    const tick = () => {
      if (document.visibilityState === "visible") void load();
    };
    void load();
    const timer = setInterval(tick, REFRESH_MS);
    document.addEventListener("visibilitychange", tick);
    return () => {
      clearInterval(timer);
      document.removeEventListener("visibilitychange", tick);
    };
  }, [load]);
  return { list, refresh: () => void load(), showMore: () => setPages((count) => count + 1) };
}

function Empty({ onNew }: { onNew: () => void }) {
  return (
    <div className="empty" data-testid="empty">
      <Sprout />
      <h2>{t("experiments.empty")}</h2>
      <p>{t("experiments.emptyWhat")}</p>
      <button type="button" className="button primary" onClick={onNew}>
        {t("experiments.new")}
      </button>
    </div>
  );
}

export function ExperimentsPage() {
  const { list, refresh, showMore } = useExperiments();
  const [creating, setCreating] = useState(false);
  const [question, setQuestion] = useState<Question | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const wrong = problem ?? list.problem;
  return (
    <>
      <Header />
      <main className="page narrow">
        <div className="title-row">
          <h1 className="title-text">{t("experiments.title")}</h1>
          <button
            type="button"
            className="button primary"
            data-testid="new"
            onClick={() => setCreating(true)}
          >
            {t("experiments.new")}
          </button>
        </div>
        {wrong && (
          <div className="banner" role="alert">
            <div>
              <b>{wrong.detail}</b> {wrong.remedy}
            </div>
            <button
              type="button"
              className="button"
              onClick={() => {
                setProblem(null);
                refresh();
              }}
            >
              {t("common.retry")}
            </button>
          </div>
        )}
        {list.items === null && !list.problem && (
          <div className="rows" role="status" aria-label={t("common.loading")}>
            <div className="skeleton" />
            <div className="skeleton" />
          </div>
        )}
        {list.items?.length === 0 && <Empty onNew={() => setCreating(true)} />}
        <ul className="rows">
          {list.items?.map((each) => (
            <ExperimentRow
              key={each.id}
              experiment={each}
              onChanged={refresh}
              onProblem={setProblem}
              onAsk={setQuestion}
            />
          ))}
        </ul>
        {list.more && (
          <button type="button" className="button quiet" onClick={showMore}>
            {t("common.showMore")}
          </button>
        )}
      </main>
      {creating && <NewExperiment count={list.items?.length ?? 0} onClose={() => setCreating(false)} />}
      {question && <Confirm question={question} onClose={() => setQuestion(null)} />}
    </>
  );
}
