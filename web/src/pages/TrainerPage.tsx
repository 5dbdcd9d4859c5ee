// The trainer's page: judge proposals on camera pictures, watch approved ones run, stop at any time.

import { useEffect, useMemo, useState } from "react";
import { activity } from "../activity";
import { ActivityLine } from "../components/ActivityLine";
import { CalibrationPanel } from "../components/Calibration";
import { ConnectionState } from "../components/ConnectionState";
import { Curve } from "../components/Curve";
import { Confirm, type Question } from "../components/Dialog";
import { HaltBanner } from "../components/HaltBanner";
import { Header } from "../components/Header";
import { HistoryStrip } from "../components/History";
import { JudgeBar } from "../components/JudgeBar";
import { LabelQualityPanel } from "../components/LabelQuality";
import { LastMotion } from "../components/LastMotion";
import { MarkGold } from "../components/MarkGold";
import { Notices } from "../components/Notices";
import { NeedsHand, ResetDialog } from "../components/OperatorPanel";
import { PracticeBanner } from "../components/PracticeBanner";
import { ProblemCard } from "../components/ProblemCard";
import { RobotPicker } from "../components/RobotPicker";
import { SceneNotice } from "../components/SceneNotice";
import { SidePanel } from "../components/SidePanel";
import { StopButton } from "../components/StopButton";
import { Tour } from "../components/Tour";
import { TrainerTitle } from "../components/TrainerTitle";
import { useDrawn, Views } from "../components/Views";
import { ViewTools } from "../components/ViewTools";
import { Votes } from "../components/Votes";
import { type Entry, lastMotion } from "../history";
import { t } from "../i18n";
import { ImageStore } from "../images";
import { queueOf } from "../robots";
import { chosenFor, overlayWanted } from "../selectors";
import { useSession } from "../session";
import { useSettings } from "../settings";
import { useSimulated, useTask } from "../useCatalogue";
import { useJudging } from "../useJudging";
import { usePace } from "../usePace";
import { useSignsOfLife } from "../useSignsOfLife";
import type { Experiment, Reported, Value } from "../wire";
import type { Swipe } from "../zoom";

/** A real robot waits for a hand: its last motion ended so, and nothing has begun since. */
function handWanted(experiment: Experiment | null, last: Entry | null): boolean {
  const kinds = last?.execution?.violations.map(({ kind }) => kind);
  return experiment?.lifecycle === "paused" && (kinds?.includes("manual_reset") ?? false);
}

const stopQuestion = (act: () => void): Question => ({
  title: t("motion.stop"),
  text: t("motion.stopWhat"),
  yes: t("motion.stopYes"),
  danger: true,
  testId: "stop-confirm",
  act,
});

const STROKES: Record<Swipe, Value> = { left: -1, up: 0, right: 1 };

export function TrainerPage({ id }: { id: number }) {
  const { state, session } = useSession(id);
  const [resetting, setResetting] = useState(false);
  const [touring, setTouring] = useState(false);
  const [question, setQuestion] = useState<Question | null>(null);
  const settings = useSettings();
  const pace = usePace(settings.restAfter, session.notify);
  const images = useMemo(() => new ImageStore(), []);
  const next = queueOf(state.robots, state.judged).find(({ id }) => id !== state.proposal?.id) ?? null;
  const { drawn, failed } = useDrawn(images, state.proposal, next);
  const { experiment, proposal, undoable, live } = state;

  const task = useTask(experiment?.task);
  const simulated = useSimulated(experiment?.adapter);

  // An overlay is shown only on its own pictures, so nothing is drawn for a proposal whose pictures aren't here.
  const current = drawn !== null && drawn === proposal;
  const overlay = current && overlayWanted(state);
  const drawnId = overlay && !drawn.closed_at ? drawn.id : null;
  const { ready, accepting, hint, judge } = useJudging(state, drawnId, (judged, value) => {
    session.judge(judged, value, settings.estimate);
    pace.click();
  });
  const judging = experiment?.lifecycle === "running" && !experiment.halted;

  useSignsOfLife(session.look);
  useEffect(() => {
    if (experiment) document.title = `${experiment.name} · SEED`;
  }, [experiment]);

  if (state.fatal) return <ProblemCard problem={state.fatal} />;
  const now = activity(state, current);
  const last = lastMotion(state.history, state.shown);
  const report = (executionId: number, outcome: Reported) =>
    void session.report(executionId, outcome).then((kept) => {
      if (kept && outcome === "needs_reset") setResetting(true);
      if (kept && outcome === "damage" && !experiment?.halted)
        setQuestion(stopQuestion(() => session.halt()));
    });
  return (
    <>
      <Header back stop experiment={id}>
        <ConnectionState connection={state.connection} pending={state.pending.length} />
      </Header>
      <StopButton stopping={state.stopping !== "no"} onStop={() => session.halt()} />
      <main className="page with-dock" data-testid="trainer">
        <HaltBanner state={state} onAsk={setQuestion} onRearm={() => void session.act("rearm")} />
        {simulated === false && handWanted(experiment, last) && (
          <NeedsHand onOpen={() => setResetting(true)} />
        )}
        <TrainerTitle experiment={experiment} session={session} onAsk={setQuestion} />
        {experiment && <PracticeBanner experiment={experiment} />}
        <div className="trainer">
          <div className="stage">
            {state.robots.length > 1 && (
              <RobotPicker
                robots={state.robots}
                judged={state.judged}
                chosen={state.chosen}
                shown={state.shown}
                onChoose={session.watch}
              />
            )}
            <ViewTools
              subgoal={(current ? proposal : drawn)?.subgoal ?? null}
              onTour={() => setTouring(true)}
            />
            <Views
              onSwipe={(swipe, press) => judge(STROKES[swipe], press)}
              images={images}
              frames={session.frames}
              drawn={drawn}
              failed={failed}
              overlay={overlay}
              accepting={accepting}
              robot={state.shown}
              live={live}
              moving={state.execution !== null && state.finishing === null}
              skill={overlay ? drawn.skill : (state.execution?.skill ?? null)}
              empty={experiment?.lifecycle === "created" ? t("camera.start") : now.text}
            />
            <div className="dock">
              <SceneNotice telling={session.telling} robot={state.shown} />
              <ActivityLine
                activity={now}
                number={ready && drawn ? drawn.number : null}
                hint={hint}
                canUndo={undoable !== null}
                onUndo={() => undoable && session.undo(undoable.id)}
              />
              {experiment && (
                <Votes
                  proposal={proposal}
                  experiment={experiment}
                  judges={state.judges}
                  leaseLeft={session.leaseLeft}
                />
              )}
              <JudgeBar
                ready={ready}
                chosen={proposal && current && judging ? chosenFor(state, proposal.id) : null}
                canUndo={undoable !== null}
                onJudge={judge}
                onUndo={() => undoable && session.undo(undoable.id)}
              />
            </div>
            <LastMotion last={last} recording={session.recording} onReport={report} />
            <HistoryStrip
              history={state.history}
              onRelabel={(feedbackId, value) => void session.relabel(feedbackId, value)}
              {...(experiment?.gold_rate && {
                more: (proposalId) => <MarkGold proposalId={proposalId} notify={session.notify} />,
              })}
            />
            <Curve curve={state.curve} />
          </div>
          {experiment && (
            <SidePanel
              state={state}
              experiment={experiment}
              proposal={current ? proposal : drawn}
              session={session}
              onAsk={setQuestion}
              overlay={overlay}
              pace={pace.pace}
              task={task}
              simulated={simulated}
              onTour={() => setTouring(true)}
            />
          )}
          {experiment && (
            <div className="stage">
              <CalibrationPanel experiment={experiment} />
              <LabelQualityPanel experiment={experiment} onProblem={session.tellOf} />
            </div>
          )}
        </div>
      </main>
      {resetting && (
        <ResetDialog
          task={task}
          simulated={simulated ?? false}
          onReset={() => void session.act("reset")}
          onClose={() => setResetting(false)}
        />
      )}
      {touring && <Tour onClose={() => setTouring(false)} />}
      <Notices notices={state.notices} onDismiss={session.dismiss} />
      {question && <Confirm question={question} onClose={() => setQuestion(null)} />}
    </>
  );
}
