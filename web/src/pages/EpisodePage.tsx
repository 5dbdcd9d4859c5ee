// One episode step by step: proposed, judged, executed, and what was seen next. From the database; nothing runs for it.

import { useEffect, useEffectEvent, useState } from "react";
import { dialogOpen } from "../components/Dialog";
import { ExperimentTabs } from "../components/ExperimentTabs";
import { Header } from "../components/Header";
import { Picture } from "../components/History";
import { ProblemCard } from "../components/ProblemCard";
import { StageLine, StepFacts } from "../components/StepFacts";
import * as http from "../http";
import { t } from "../i18n";
import { moment as timeOf } from "../i18n/numbers";
import { type Moment, momentOf, momentsOf } from "../replaying";
import { Link, useSearch } from "../router";
import type { Episode, Problem } from "../wire";

const PLAY_MS = 900;

interface Told {
  episode: Episode | null;
  moments: Moment[];
  problem: Problem | null;
}

function useEpisode(id: number, number: number): Told {
  const [told, setTold] = useState<Told>({ episode: null, moments: [], problem: null });
  useEffect(() => {
    let gone = false;
    Promise.all([http.episode(id, number), http.steps(id, number)]).then(
      ([episode, entries]) => gone || setTold({ episode, moments: momentsOf(entries), problem: null }),
      (error: unknown) => gone || setTold({ episode: null, moments: [], problem: http.problemOf(error) }),
    );
    return () => {
      gone = true;
    };
  }, [id, number]);
  return told;
}

/** Left and right step, Home and End jump; not while something else takes the keys. */
function useKeys(step: (by: number) => void): void {
  const onKey = useEffectEvent((event: KeyboardEvent) => {
    const busy = event.target instanceof HTMLElement && event.target.matches("input, select, textarea");
    if (busy || dialogOpen() || event.metaKey || event.ctrlKey || event.altKey) return;
    const by = {
      ArrowRight: 1,
      ArrowLeft: -1,
      Home: Number.NEGATIVE_INFINITY,
      End: Number.POSITIVE_INFINITY,
    }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    step(by);
  });
  useEffect(() => {
    const listen = (event: KeyboardEvent) => onKey(event);
    window.addEventListener("keydown", listen);
    return () => window.removeEventListener("keydown", listen);
  }, []);
}

export function EpisodePage({ id, number }: { id: number; number: number }) {
  const { episode, moments, problem } = useEpisode(id, number);
  const wanted = Number(new URLSearchParams(useSearch()).get("proposal"));
  const [chosen, setChosen] = useState<number | null>(null);
  const [playing, setPlaying] = useState(false);
  const last = moments.length - 1;
  const at = Math.min(chosen ?? momentOf(moments, wanted), Math.max(0, last));
  const step = (by: number) => setChosen(Math.max(0, Math.min(last, at + by)));
  useKeys((by) => {
    setPlaying(false);
    step(by);
  });
  const next = useEffectEvent(() => (at < last ? step(1) : setPlaying(false)));
  useEffect(() => {
    if (!playing) return;
    const timer = setInterval(() => next(), PLAY_MS);
    return () => clearInterval(timer);
  }, [playing]);
  useEffect(() => {
    document.title = `${t("episode.title", { number })} · SEED`;
  }, [number]);
  const here = moments[at];
  if (problem) return <ProblemCard problem={problem} />;
  return (
    <>
      <Header back />
      <main className="page" data-testid="episode">
        <div className="title-row">
          <div className="title-text">
            <div className="title-line">
              <h1>{t("episode.title", { number })}</h1>
              {episode && (
                <span className="pill">{t(`episode.outcome_${episode.outcome ?? "running"}`)}</span>
              )}
            </div>
            {episode && (
              <p className="facts">
                {t("episode.about", {
                  proposals: episode.proposals,
                  executions: episode.executions,
                  at: timeOf(episode.started_at),
                })}
              </p>
            )}
          </div>
          <div className="actions">
            {number > 1 && (
              <Link to={`/experiments/${id}/episodes/${number - 1}`} className="button">
                {t("episode.before")}
              </Link>
            )}
            <Link to={`/experiments/${id}/episodes/${number + 1}`} className="button">
              {t("episode.after")}
            </Link>
          </div>
        </div>
        <ExperimentTabs id={id} here="gallery" />
        {episode && !here && <p className="empty-chart card">{t("episode.nothing")}</p>}
        {!episode && <div className="skeleton tall" role="status" aria-label={t("common.loading")} />}
        {here && (
          <Replay
            moments={moments}
            at={at}
            playing={playing}
            onAt={setChosen}
            onPlay={() => setPlaying(!playing)}
          />
        )}
      </main>
    </>
  );
}

interface ReplayProps {
  moments: Moment[];
  at: number;
  playing: boolean;
  onAt: (at: number) => void;
  onPlay: () => void;
}

function Replay({ moments, at, playing, onAt, onPlay }: ReplayProps) {
  const here = moments[at];
  if (!here) return null;
  const { proposal } = here.entry;
  return (
    <div className="replay" data-testid="replay" data-at={at} data-stage={here.stage}>
      <div className="replay-pictures">
        {here.stage === "executed" && !here.after ? (
          <p className="empty-chart card">{t("episode.noPicture")}</p>
        ) : (
          (here.after ?? here.entry).proposal.views.map((view) => (
            <Picture
              key={view.camera}
              view={view}
              judged={here.stage === "judged"}
              overlay={here.stage !== "executed"}
            />
          ))
        )}
        <p className="soft small">
          {here.stage === "executed" && here.after ? t("episode.seenAfter") : t("episode.seenBefore")}
        </p>
      </div>
      <section className="card" aria-label={t("episode.step")}>
        <h2>{t("episode.proposal", { number: proposal.number })}</h2>
        <StageLine moment={here} />
        <StepFacts moment={here} />
      </section>
      <div className="replay-bar card">
        <button type="button" className="button primary" onClick={onPlay} data-testid="play">
          {t(playing ? "episode.pause" : "episode.play")}
        </button>
        <button
          type="button"
          className="button"
          disabled={at === 0}
          aria-keyshortcuts="ArrowLeft"
          onClick={() => onAt(at - 1)}
        >
          ← {t("episode.back")}
        </button>
        <input
          type="range"
          min={0}
          max={Math.max(1, moments.length - 1)}
          value={at}
          aria-label={t("episode.place")}
          aria-valuetext={t("episode.placeOf", { at: at + 1, count: moments.length })}
          onChange={(event) => onAt(Math.min(moments.length - 1, Number(event.target.value)))}
        />
        <button
          type="button"
          className="button"
          disabled={at === moments.length - 1}
          aria-keyshortcuts="ArrowRight"
          data-testid="step"
          onClick={() => onAt(at + 1)}
        >
          {t("episode.forward")} →
        </button>
        <span className="number soft" role="status">
          {t("episode.placeOf", { at: at + 1, count: moments.length })}
        </span>
      </div>
    </div>
  );
}
