// Calibrating a real robot's cameras: what they see of the board, how many poses there are, what the result is worth.

import { useCallback, useEffect, useRef, useState } from "react";
import { Field } from "../components/Field";
import { GuideCameras, GuideWorth } from "../components/GuideCameras";
import { Header } from "../components/Header";
import * as http from "../http";
import { t } from "../i18n";
import { Link } from "../router";
import type { GuideOutcome, GuideStep, Problem } from "../wire";

/** Between the end of a look and the next one. */
const AGAIN_MS = 300;

function useGuide(id: number) {
  const [step, setStep] = useState<GuideStep | null>(null);
  const [outcome, setOutcome] = useState<GuideOutcome | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(false);
  const [known, setKnown] = useState(false);
  const ask = useCallback(async <T,>(request: Promise<T>, then: (told: T) => void) => {
    setBusy(true);
    try {
      then(await request);
      setProblem(null);
    } catch (error) {
      setProblem(http.problemOf(error));
    }
    setBusy(false);
  }, []);
  // the poses are kept by the service: a page that was loaded anew goes on with them
  const recall = useCallback(async () => {
    try {
      const told = await http.guideState(id);
      setStep(told.step ?? null);
      setOutcome(told.outcome ?? null);
    } catch (error) {
      setProblem(http.problemOf(error));
    }
    setKnown(true);
  }, [id]);
  useEffect(() => void recall(), [recall]);
  const begin = (square: number, wanted: number) =>
    ask(http.guide(id, square, wanted), (told) => {
      setOutcome(null);
      setStep(told);
    });
  const solve = async () => {
    await ask(http.guideSolve(id), setOutcome);
    await recall(); // where the poses don't do, more are wanted
  };
  const store = () => ask(http.guideStore(id), setOutcome);
  const restart = () => {
    setStep(null);
    setOutcome(null);
    setProblem(null);
  };
  return { known, step, setStep, outcome, problem, busy, begin, solve, store, restart };
}

/** Looks again and again; a pose is taken where `taking` says so. */
function useLooking(id: number, guide: ReturnType<typeof useGuide>, taking: () => boolean) {
  const { step, outcome, busy, setStep } = guide;
  const [problem, setProblem] = useState<Problem | null>(null);
  const looking = step !== null && !step.done && !outcome && !busy;
  const take = useRef(taking);
  take.current = taking;
  useEffect(() => {
    if (!looking) return;
    let gone = false;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const again = async () => {
      try {
        const told = await http.guideLook(id, take.current());
        if (gone) return;
        setStep(told);
        setProblem(null);
      } catch (error) {
        if (!gone) setProblem(http.problemOf(error));
      }
      if (!gone) timer = setTimeout(again, AGAIN_MS);
    };
    void again();
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [looking, id, setStep]);
  return looking ? problem : null;
}

function Begin({ busy, onBegin }: { busy: boolean; onBegin: (square: number, wanted: number) => void }) {
  const [square, setSquare] = useState("36");
  const [wanted, setWanted] = useState("15");
  return (
    <form
      className="card calibrating"
      onSubmit={(event) => {
        event.preventDefault();
        onBegin(Number(square.replace(",", ".")), Number(wanted));
      }}
    >
      <ol>
        <li>{t("cameras.print")}</li>
        <li>{t("cameras.fasten")}</li>
        <li>{t("cameras.guide")}</li>
      </ol>
      <Field label={t("cameras.square")} name="square_mm" value={square} numeric onChange={setSquare} />
      <Field label={t("cameras.wanted")} name="wanted" value={wanted} numeric onChange={setWanted} />
      <button type="submit" className="button primary" disabled={busy} data-testid="calibrate">
        {t("cameras.begin")}
      </button>
    </form>
  );
}

export function CamerasPage({ id }: { id: number }) {
  const guide = useGuide(id);
  const [auto, setAuto] = useState(true);
  const once = useRef(false);
  const { known, step, outcome, busy } = guide;
  const unseen = useLooking(id, guide, () => {
    const take = auto || once.current;
    once.current = false;
    return take;
  });
  useEffect(() => {
    document.title = `${t("cameras.title")} · SEED`;
  }, []);
  const problem = guide.problem ?? unseen;
  const enough = step?.cameras.every(({ taken }) => taken >= step.fewest);
  return (
    <>
      <Header back />
      <main className="page" data-testid="cameras">
        <div className="title-row">
          <h1 className="title-text">{t("cameras.title")}</h1>
          <Link to={`/experiments/${id}`} className="button">
            {t("cameras.back")}
          </Link>
        </div>
        {problem && (
          <p className="warning-text" role="alert" data-testid="guide-problem">
            {`${problem.detail} ${problem.remedy}`}
          </p>
        )}
        {known && !step && <Begin busy={busy} onBegin={(...given) => void guide.begin(...given)} />}
        {step && !outcome && (
          <section className="card calibrating" aria-label={t("cameras.title")}>
            <p className="advice" role="status" data-testid="guide-advice" data-advice={step.advice}>
              {t(`cameras.advice_${step.advice}`, { camera: step.camera })}
            </p>
            <GuideCameras step={step} />
            <label className="check">
              <input type="checkbox" checked={auto} onChange={(event) => setAuto(event.target.checked)} />
              {t("cameras.auto")}
            </label>
            <div className="actions">
              <button
                type="button"
                className="button"
                disabled={auto || step.done}
                data-testid="take-pose"
                onClick={() => {
                  once.current = true;
                }}
              >
                {t("cameras.take")}
              </button>
              <button
                type="button"
                className="button primary"
                disabled={!enough || busy}
                data-testid="guide-solve"
                onClick={() => void guide.solve()}
              >
                {busy ? t("cameras.solving") : t("cameras.solve")}
              </button>
            </div>
          </section>
        )}
        {outcome && <GuideWorth outcome={outcome} busy={busy} onStore={() => void guide.store()} />}
        {step && (
          <button type="button" className="button" data-testid="guide-again" onClick={guide.restart}>
            {t("cameras.again")}
          </button>
        )}
      </main>
    </>
  );
}
