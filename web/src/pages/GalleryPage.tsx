// Every closed proposal as a picture, narrowed by what was said of it and what came of it; each leads into its episode.

import { useCallback, useEffect, useRef, useState } from "react";
import { ExperimentTabs } from "../components/ExperimentTabs";
import { GalleryItem } from "../components/GalleryItem";
import { GalleryTools } from "../components/GalleryTools";
import { Header } from "../components/Header";
import { Sprout } from "../components/icons";
import { ProblemBanner } from "../components/ProblemBanner";
import { ProblemCard } from "../components/ProblemCard";
import { StatePill } from "../components/StatePill";
import { Timeline } from "../components/Timeline";
import { narrowedIn } from "../gallery";
import * as http from "../http";
import { t } from "../i18n";
import { setSearch, useSearch } from "../router";
import { useTask } from "../useCatalogue";
import type { Experiment, HistoryEntry, Problem, TimelineInfo } from "../wire";

interface Shown {
  narrowed: string;
  items: HistoryEntry[];
  cursor: string | null;
}

function useGallery(id: number, narrowed: string) {
  const [shown, setShown] = useState<Shown | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(false);
  const asked = useRef<symbol | null>(null);
  const load = useCallback(
    async (before: Shown | null) => {
      const question = Symbol();
      const current = () => asked.current === question;
      asked.current = question;
      setBusy(true);
      try {
        const page = await http.told(id, narrowed, before?.cursor ?? null);
        if (!current()) return;
        const items = [...(before?.items ?? []), ...page.items];
        setShown({ narrowed, items, cursor: page.next_cursor ?? null });
        setProblem(null);
      } catch (error) {
        if (current()) setProblem(http.problemOf(error));
      } finally {
        if (current()) setBusy(false);
      }
    },
    [id, narrowed],
  );
  useEffect(() => {
    void load(null);
    return () => {
      asked.current = null; // what is still on its way was asked for something else
    };
  }, [load]);
  return { shown, problem, busy, more: () => void load(shown?.narrowed === narrowed ? shown : null) };
}

function useExperiment(id: number): Experiment | null {
  const [experiment, setExperiment] = useState<Experiment | null>(null);
  useEffect(() => {
    http.experiment(id).then(setExperiment, () => undefined); // the gallery's own problem tells
  }, [id]);
  return experiment;
}

function useTimeline(id: number): TimelineInfo | null {
  const [timeline, setTimeline] = useState<TimelineInfo | null>(null);
  useEffect(() => {
    http.timeline(id).then(setTimeline, () => undefined); // as above
  }, [id]);
  return timeline;
}

function Empty({ narrowed }: { narrowed: boolean }) {
  return (
    <div className="empty" data-testid="no-proposals">
      <Sprout />
      <h2>{t(narrowed ? "gallery.none" : "gallery.empty")}</h2>
      <p>{t(narrowed ? "gallery.noneWhat" : "gallery.emptyWhat")}</p>
    </div>
  );
}

export function GalleryPage({ id }: { id: number }) {
  const narrowed = narrowedIn(useSearch());
  const { shown, problem, busy, more } = useGallery(id, narrowed.toString());
  const experiment = useExperiment(id);
  const timeline = useTimeline(id);
  const task = useTask(experiment?.task);
  useEffect(() => {
    document.title = `${t("nav.gallery")} · SEED`;
  }, []);
  if (problem && !shown) return <ProblemCard problem={problem} />;
  return (
    <>
      <Header back />
      <main className="page" data-testid="gallery">
        <div className="title-row">
          <div className="title-text title-line">
            <h1>{experiment?.name ?? t("common.loading")}</h1>
            {experiment && <StatePill experiment={experiment} />}
          </div>
        </div>
        <ExperimentTabs id={id} here="gallery" />
        <GalleryTools
          narrowed={narrowed}
          skills={task?.skills.map(({ name }) => name) ?? []}
          onChange={setSearch}
        />
        {!shown && <div className="skeleton tall" role="status" aria-label={t("common.loading")} />}
        {timeline && <Timeline id={id} told={timeline} />}
        {shown?.items.length === 0 && <Empty narrowed={narrowed.size > 0} />}
        <ul className="gallery">
          {shown?.items.map((entry) => (
            <GalleryItem key={entry.proposal.id} id={id} entry={entry} />
          ))}
        </ul>
        {problem && <ProblemBanner problem={problem} onRetry={more} />}
        {shown?.cursor && !problem && (
          <button type="button" className="button quiet" disabled={busy} onClick={more} data-testid="more">
            {t("common.showMore")}
          </button>
        )}
      </main>
    </>
  );
}
