// Good, Neutral, Bad, and that nothing can be told from the view: as buttons and as keys. One press is one click for the
// proposal that is drawn, never for the next.

import {
  type KeyboardEvent as ReactKeyboardEvent,
  type MouseEvent as ReactMouseEvent,
  type PointerEvent as ReactPointerEvent,
  useEffect,
  useEffectEvent,
  useRef,
} from "react";
import { t } from "../i18n";
import type { Press } from "../useJudging";
import type { Value } from "../wire";
import { dialogOpen } from "./Dialog";
import { Cross, Dash, Eye, Tick } from "./icons";

// In the order of the arrow keys, from left to right.
const CHOICES = [
  { value: -1, testId: "bad", arrow: "←", number: "3", key: "ArrowLeft", Icon: Cross },
  { value: 0, testId: "neutral", arrow: "↓", number: "2", key: "ArrowDown", Icon: Dash },
  { value: 1, testId: "good", arrow: "→", number: "1", key: "ArrowRight", Icon: Tick },
  {
    value: "cant_tell",
    testId: "cant-tell",
    arrow: "↑",
    number: "4",
    key: "ArrowUp",
    Icon: Eye,
  },
] as const;

const WORDS = {
  bad: "judge.bad",
  neutral: "judge.neutral",
  good: "judge.good",
  "cant-tell": "judge.cantTell",
} as const;

export interface JudgeBarProps {
  /** Whether a click would count now. */
  ready: boolean;
  /** The click on its way for the drawn proposal. */
  chosen: Value | null;
  canUndo: boolean;
  onJudge: (value: Value, press: Press) => void;
  onUndo: () => void;
}

/** Whether digits, letters or arrows are the control's own: text, a choice among several, a slider. */
export function typing(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLElement &&
    target.matches("input:not([type=checkbox]), select, textarea, [contenteditable]")
  );
}

function useJudgeKeys(props: JudgeBarProps): void {
  const press = useEffectEvent((event: KeyboardEvent) => {
    if (typing(event.target) || dialogOpen()) return;
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    const undo = command ? key === "z" && !event.shiftKey : key === "u";
    if (undo && !event.altKey && props.canUndo && !event.repeat) {
      event.preventDefault();
      props.onUndo();
    }
    if (command || event.altKey || event.shiftKey) return;
    const choice = CHOICES.find(({ key, number }) => event.key === key || event.key === number);
    if (!choice) return;
    event.preventDefault();
    // A held key repeats by itself: nobody has looked at what it would judge.
    const at = event.timeStamp;
    if (!event.repeat) props.onJudge(choice.value, { begun: at, ended: at });
  });
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => press(event);
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  }, []);
}

/** A button clicks when the mouse, the finger or the space bar is lifted: this remembers when it went down. */
function useDown() {
  const pointer = useRef<number | null>(null);
  const key = useRef<number | null>(null);
  return {
    on: {
      onPointerDown: (event: ReactPointerEvent) => {
        pointer.current = event.timeStamp;
      },
      onKeyDown: (event: ReactKeyboardEvent) => {
        // Enter held down on a focused button would click it again and again.
        if (event.repeat) event.preventDefault();
        else if (event.key === " " || event.key === "Enter") key.current = event.timeStamp;
      },
      onBlur: () => {
        key.current = null; // the space bar, lifted elsewhere, clicks nothing
      },
    },
    pressOf: ({ detail, timeStamp }: ReactMouseEvent): Press => {
      const down = detail === 0 ? key : pointer; // a key's click has no count
      const begun = down.current ?? timeStamp;
      down.current = null;
      return { begun, ended: timeStamp };
    },
  };
}

export function JudgeBar(props: JudgeBarProps) {
  useJudgeKeys(props);
  const { on, pressOf } = useDown();
  return (
    <fieldset className="judge" aria-label={t("judge.label")} data-idle={!props.ready}>
      {CHOICES.map(({ value, testId, arrow, number, key, Icon }) => (
        <button
          key={testId}
          type="button"
          className={testId}
          data-testid={testId}
          data-chosen={props.chosen === value}
          aria-disabled={!props.ready}
          aria-keyshortcuts={`${number} ${key}`}
          {...on}
          onClick={(event) => props.onJudge(value, pressOf(event))}
        >
          <Icon />
          {t(WORDS[testId])}
          <span className="keys" aria-hidden="true">
            <span className="key">{arrow}</span>
            <span className="key">{number}</span>
          </span>
        </button>
      ))}
    </fieldset>
  );
}
