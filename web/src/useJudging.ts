// Which presses count: those on a proposal that was on the screen long enough to be looked at. The others are told of.

import { useEffect, useState } from "react";
import { t } from "./i18n";
import { may } from "./me";
import { isOpen, queueOf } from "./robots";
import { chosenFor, judgeable } from "./selectors";
import type { TrainerState } from "./state";
import { useDrawnAt } from "./useDrawnAt";
import type { Proposal, Value } from "./wire";

/** Nobody sees a picture and judges it in less time: such a press was meant for the proposal before. */
export const LOOK_MS = 250;
/** How long a hint stays; it fades at the end (trainer.css). */
const HINT_MS = 3000;

/** A press or a stroke: times in ms, as in `Event.timeStamp`. */
export interface Press {
  begun: number;
  ended: number;
}

/** Why the newest press didn't count. */
export interface Hint {
  id: number;
  text: string;
}

export interface Judging {
  /** Whether the drawn proposal waits for a judgement. */
  ready: boolean;
  /** Whether a press counts now. */
  accepting: boolean;
  hint: Hint | null;
  /** What counts is what was seen when the press began: the next proposal may come while it is held. */
  judge: (value: Value, press: Press) => void;
}

/** What to say of a press that doesn't count; nothing where judging isn't on offer at all. */
function whyNot(state: TrainerState, ready: boolean): string | null {
  const { experiment, proposal } = state;
  if (!may("trainer")) return t("people.onlyLooks");
  if (ready) return t("judge.tooFast");
  if (experiment?.lifecycle !== "running" || experiment.halted || experiment.teacher) return null;
  const waiting = queueOf(state.robots, state.judged);
  if (waiting.length > 0 && !waiting.some(({ robot }) => robot === state.shown))
    return t("judge.otherRobots");
  if (state.execution) return t("judge.moving");
  if (proposal && chosenFor(state, proposal.id) !== null) return t("judge.already");
  if (proposal && isOpen(proposal) && state.asks === "no") return t("judge.notYours");
  return t("judge.notYet");
}

/** `drawnId`: the open proposal that is drawn with its own pictures. */
export function useJudging(
  state: TrainerState,
  drawnId: number | null,
  send: (proposal: Proposal, value: Value) => void,
): Judging {
  const clock = useDrawnAt(drawnId);
  const [seenId, setSeenId] = useState<number | null>(null);
  const [hint, setHint] = useState<Hint | null>(null);
  const ready = judgeable(state, drawnId) && may("trainer");

  useEffect(() => {
    if (drawnId === null) return;
    const timer = setTimeout(() => setSeenId(drawnId), LOOK_MS);
    return () => {
      clearTimeout(timer);
      setSeenId(null); // an undo brings the same proposal back, which is drawn anew then
    };
  }, [drawnId]);

  useEffect(() => {
    if (!hint) return;
    const timer = setTimeout(() => setHint(null), HINT_MS);
    return () => clearTimeout(timer);
  }, [hint]);

  const judge = (value: Value, { begun, ended }: Press) => {
    if (ready && drawnId !== null && state.proposal?.id === drawnId && clock.age(begun) >= LOOK_MS) {
      setHint(null);
      clock.clicked(ended);
      send(state.proposal, value);
      return;
    }
    const text = whyNot(state, ready);
    if (text !== null) setHint((last) => ({ id: (last?.id ?? 0) + 1, text }));
  };

  return { ready, accepting: ready && seenId === drawnId, hint, judge };
}
