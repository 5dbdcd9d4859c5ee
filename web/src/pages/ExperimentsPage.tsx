// Every experiment with its state and counters: find it, order them, tag, compare; start, pause, resume, finish.

import { useCallback, useEffect, useState } from "react";
import { Confirm, type Question } from "../components/Dialog";
import { ExperimentTable } from "../components/ExperimentTable";
import { Header } from "../components/Header";
import { Sprout } from "../components/icons";
import { ListTools } from "../components/ListTools";
import { ProblemBanner } from "../components/ProblemBanner";
import * as http from "../http";
import { t } from "../i18n";
import { isNarrowed, listingOf, withTag } from "../listing";
import { Link, setSearch, useSearch } from "../router";
import { useCatalogue } from "../useCatalogue";
import { usePolled } from "../usePolled";
import type { Experiment, Problem } from "../wire";

const REFRESH_MS = 2500;
const TAGS_MS = 10_000;

interface List {
  items: Experiment[] | null;
  problem: Problem | null;
  more: boolean;
}

/** The experiments that the address asks for, kept fresh while the page is looked at. */
function useExperiments(listing: string): { list: List; refresh: () => void; showMore: () => void } {
  const [list, setList] = useState<List>({ items: null, problem: null, more: false });
  const [shown, setShown] = useState({ listing, pages: 1 });
  const pages = shown.listing === listing ? shown.pages : 1;
  const load = useCallback(
    async (current: () => boolean) => {
      try {
        const items = new Map<number, Experiment>();
        let cursor: string | null = null;
        for (let page = 0; page < pages; page += 1) {
          const answer = await http.experiments(listing, cursor);
          for (const item of answer.items) items.set(item.id, item); // one may move to the next page meanwhile
          cursor = answer.next_cursor ?? null;
          if (!cursor) break;
        }
        if (current()) setList({ items: [...items.values()], problem: null, more: cursor !== null });
      } catch (error) {
        if (current()) setList((before) => ({ ...before, problem: http.problemOf(error) }));
      }
    },
    [pages, listing],
  );
  const [asked, setAsked] = useState(0);
  // biome-ignore lint/correctness/useExhaustiveDependencies: asking again is what `asked` is for
  useEffect(() => {
    let gone = false;
    const current = () => !gone;
    const tick = () => {
      if (document.visibilityState === "visible") void load(current);
    };
    void load(current);
    const timer = setInterval(tick, REFRESH_MS);
    document.addEventListener("visibilitychange", tick);
    return () => {
      gone = true;
      clearInterval(timer);
      document.removeEventListener("visibilitychange", tick);
    };
  }, [load, asked]);
  return {
    list,
    refresh: () => setAsked((count) => count + 1),
    showMore: () => setShown({ listing, pages: pages + 1 }),
  };
}

function Empty() {
  return (
    <div className="empty" data-testid="empty">
      <Sprout />
      <h2>{t("experiments.empty")}</h2>
      <p>{t("experiments.emptyWhat")}</p>
      <Link to="/experiments/new" className="button primary">
        {t("experiments.new")}
      </Link>
    </div>
  );
}

function NoneSuch({ onAll }: { onAll: () => void }) {
  return (
    <div className="empty" data-testid="none-such">
      <h2>{t("list.none")}</h2>
      <p>{t("list.noneWhat")}</p>
      <button type="button" className="button" onClick={onAll}>
        {t("list.all")}
      </button>
    </div>
  );
}

function CompareBar({ selected, onClear }: { selected: ReadonlySet<number>; onClear: () => void }) {
  const query = new URLSearchParams([...selected].map((id) => ["experiment", String(id)]));
  return (
    <section className="compare-bar" aria-label={t("list.selected")} data-testid="compare-bar">
      <span role="status">{t("list.count", { count: selected.size })}</span>
      <Link to={`/compare?${query}`} className="button primary" testId="compare">
        {t("list.compare")}
      </Link>
      <button type="button" className="button quiet" onClick={onClear}>
        {t("list.clear")}
      </button>
    </section>
  );
}

export function ExperimentsPage() {
  const listing = listingOf(useSearch());
  const { list, refresh, showMore } = useExperiments(listing.toString());
  const [question, setQuestion] = useState<Question | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [selected, setSelected] = useState<ReadonlySet<number>>(new Set());
  const { value: tags } = usePolled(http.tags, TAGS_MS);
  const { catalogue } = useCatalogue();
  const wrong = problem ?? list.problem;
  const knownTags = (tags ?? []).map(({ tag }) => tag);
  const narrowed = isNarrowed(listing);
  const select = (id: number, on: boolean) => {
    const next = new Set(selected);
    if (on) next.add(id);
    else next.delete(id);
    setSelected(next);
  };
  return (
    <>
      <Header />
      <main className="page wide">
        <div className="title-row">
          <h1 className="title-text">{t("experiments.title")}</h1>
          <Link to="/experiments/new" className="button primary" testId="new">
            {t("experiments.new")}
          </Link>
        </div>
        {wrong && (
          <ProblemBanner
            problem={wrong}
            onRetry={() => {
              setProblem(null);
              refresh();
            }}
          />
        )}
        {(narrowed || (list.items?.length ?? 0) > 0) && (
          <ListTools listing={listing} catalogue={catalogue} tags={knownTags} onChange={setSearch} />
        )}
        {list.items === null && !list.problem && (
          <div className="rows" role="status" aria-label={t("common.loading")}>
            <div className="skeleton" />
            <div className="skeleton" />
          </div>
        )}
        {list.items?.length === 0 &&
          (narrowed ? <NoneSuch onAll={() => setSearch(new URLSearchParams())} /> : <Empty />)}
        {list.items && list.items.length > 0 && (
          <ExperimentTable
            experiments={list.items}
            listing={listing}
            selected={selected}
            knownTags={knownTags}
            onSelect={select}
            onListing={setSearch}
            onTag={(tag) => setSearch(withTag(listing, tag))}
            onChanged={refresh}
            onProblem={setProblem}
            onAsk={setQuestion}
          />
        )}
        {list.more && (
          <button type="button" className="button quiet" onClick={showMore} data-testid="more">
            {t("common.showMore")}
          </button>
        )}
        {selected.size > 0 && <CompareBar selected={selected} onClear={() => setSelected(new Set())} />}
      </main>
      {question && <Confirm question={question} onClose={() => setQuestion(null)} />}
    </>
  );
}
