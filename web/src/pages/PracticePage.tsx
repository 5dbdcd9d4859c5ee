// Practice: proposals with known answers, and after each click what was right and why. Nothing here counts or moves.

import { useCallback, useEffect, useRef, useState } from "react";
import { Header } from "../components/Header";
import { JudgeBar } from "../components/JudgeBar";
import { PracticeCorrection, PracticeScore } from "../components/PracticeCorrection";
import { PracticeViews } from "../components/PracticeViews";
import { ProblemCard } from "../components/ProblemCard";
import * as http from "../http";
import { t, taskWords } from "../i18n";
import { newId } from "../ids";
import { Link } from "../router";
import type { PracticeCard, PracticeResult, Problem, Value } from "../wire";

interface Practice {
  card: PracticeCard | null;
  chosen: Value | null;
  result: PracticeResult | null;
  problem: Problem | null;
  answer: (value: Value) => void;
  next: () => void;
}

function usePractice(experiment: number): Practice {
  const [card, setCard] = useState<PracticeCard | null>(null);
  const [chosen, setChosen] = useState<Value | null>(null);
  const [result, setResult] = useState<PracticeResult | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const next = useCallback(() => {
    http.nextPractice(experiment).then(
      (following) => {
        setCard(following);
        setChosen(null);
        setResult(null);
        setProblem(null);
      },
      (error: unknown) => setProblem(http.problemOf(error)),
    );
  }, [experiment]);
  useEffect(next, [next]);
  const answer = (value: Value) => {
    if (!card || chosen !== null) return;
    setChosen(value);
    http.answerPractice(card.id, { click_id: newId(), value }).then(
      (told) => {
        setResult(told);
        setProblem(null);
      },
      (error: unknown) => {
        setChosen(null); // press again
        setProblem(http.problemOf(error));
      },
    );
  };
  return { card, chosen, result, problem, answer, next };
}

function Correction(props: {
  result: PracticeResult;
  shown: boolean;
  onShow: () => void;
  onNext: () => void;
}) {
  const next = useRef<HTMLButtonElement>(null);
  useEffect(() => next.current?.focus(), []); // Enter or the space bar goes on
  return (
    <PracticeCorrection result={props.result}>
      {!props.result.reason.good && (
        <button type="button" className="button" aria-pressed={props.shown} onClick={props.onShow}>
          {t("practice.showRight")}
        </button>
      )}
      <button ref={next} type="button" className="button primary" data-testid="next" onClick={props.onNext}>
        {t("practice.next")}
      </button>
    </PracticeCorrection>
  );
}

export function PracticePage({ id }: { id: number }) {
  const { card, chosen, result, problem, answer, next } = usePractice(id);
  const [drawnId, setDrawnId] = useState<number | null>(null);
  const [showRight, setShowRight] = useState(false);
  useEffect(() => {
    document.title = `${t("practice.title")} · SEED`;
  }, []);
  if (!card) return problem ? <ProblemCard problem={problem} /> : <Header back />;
  const overlays = showRight && result ? result.right_overlays : null;
  const goOn = () => {
    setShowRight(false);
    next();
  };
  return (
    <>
      <Header back />
      <main className="page with-dock practice" data-testid="practice" data-card-id={card.id}>
        <div className="title-row">
          <div className="title-text">
            <h1>{t("practice.title")}</h1>
            <p className="soft">{taskWords(card.instruction)}</p>
          </div>
          <Link to={`/experiments/${id}`} className="button">
            {t("practice.toExperiment")}
          </Link>
        </div>
        <PracticeScore progress={result?.progress ?? card.progress} />
        <div className="trainer">
          <div className="stage">
            <PracticeViews
              key={card.id}
              card={card}
              overlays={overlays}
              right={result?.reason.right_skill ?? null}
              onDrawn={() => setDrawnId(card.id)}
            />
            <div className="dock">
              {problem && <p className="error" role="alert">{`${problem.detail} ${problem.remedy}`}</p>}
              <p className="practice-next">
                <span className="soft">{t("agent.next")}</span>{" "}
                <b data-testid="subgoal">{taskWords(card.subgoal)}</b>
              </p>
              {result && (
                <Correction
                  result={result}
                  shown={showRight}
                  onShow={() => setShowRight(!showRight)}
                  onNext={goOn}
                />
              )}
              <JudgeBar
                ready={drawnId === card.id && chosen === null}
                chosen={chosen}
                canUndo={false}
                onJudge={(value) => drawnId === card.id && answer(value)}
                onUndo={() => undefined}
              />
            </div>
          </div>
        </div>
      </main>
    </>
  );
}
