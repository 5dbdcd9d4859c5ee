// A press counts for the proposal that somebody has looked at; one that doesn't count says so.
import { act, useRef } from "react";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ActivityLine } from "../src/components/ActivityLine";
import { JudgeBar } from "../src/components/JudgeBar";
import { initial, reduce, type TrainerState } from "../src/state";
import { LOOK_MS, type Press, useJudging } from "../src/useJudging";
import { useZoom } from "../src/useZoom";
import type { Experiment, StreamEvent, Value } from "../src/wire";
import { execution, experiment, feedback, proposal, snapshot } from "./messages";
import { byTestId, press, show } from "./render";

type Sent = [proposal: number, value: Value];

/** A view whose strokes judge, as the trainer's page has it. */
function Strokes({ onStroke }: { onStroke: (value: Value, press: Press) => void }) {
  const frame = useRef<HTMLElement>(null);
  useZoom(frame, null, (swipe, press) => onStroke(swipe === "left" ? -1 : 1, press));
  return <figure ref={frame} data-testid="strokes" />;
}

function Page({ state, drawnId, sent }: { state: TrainerState; drawnId: number | null; sent: Sent[] }) {
  const { ready, accepting, hint, judge } = useJudging(state, drawnId, ({ id }, value) =>
    sent.push([id, value]),
  );
  return (
    <div data-testid="page" data-ready={accepting}>
      <ActivityLine
        activity={{ tone: "you", text: "" }}
        number={null}
        hint={hint}
        canUndo={false}
        onUndo={() => undefined}
      />
      <Strokes onStroke={(value, press) => judge(value, press)} />
      <JudgeBar ready={ready} chosen={null} canUndo={false} onJudge={judge} onUndo={() => undefined} />
    </div>
  );
}

const having = (...events: StreamEvent[]): TrainerState =>
  events.reduce((now, event) => reduce(now, { kind: "event", event }), initial);
const waiting = (id: number, change: Partial<Experiment> = {}): TrainerState =>
  having(snapshot({ proposal: proposal(id), experiment: experiment(change) }));

const hint = () => byTestId("judge-hint").textContent;
const accepting = () => byTestId("page").dataset.ready === "true";
const pass = (ms: number) => act(async () => vi.advanceTimersByTime(ms));

/** The `detail`-th click of a row with the mouse; its time stamp is the tests' clock's. */
const clickOn = (testId: string, detail = 1) =>
  act(async () => {
    const event = new MouseEvent("click", { bubbles: true, cancelable: true, detail });
    Object.defineProperty(event, "timeStamp", { value: performance.now() });
    byTestId(testId).dispatchEvent(event);
  });

const send = (event: Event, target: EventTarget) =>
  act(async () => {
    Object.defineProperty(event, "timeStamp", { value: performance.now() });
    target.dispatchEvent(event);
  });

/** Down with the mouse, the finger or the space bar; what follows, when it is lifted. */
const DOWN = {
  mouse: async (testId: string) => {
    await send(new PointerEvent("pointerdown", { bubbles: true }), byTestId(testId));
    return () => clickOn(testId);
  },
  "space bar": async (testId: string) => {
    await send(new KeyboardEvent("keydown", { key: " ", bubbles: true }), byTestId(testId));
    return () => clickOn(testId, 0);
  },
  finger: async (testId: string) => {
    const view = byTestId("strokes");
    const pointer = { pointerId: 1, pointerType: "touch", bubbles: true, clientX: 200 };
    const clientX = testId === "bad" ? 50 : 350;
    await send(new PointerEvent("pointerdown", pointer), view);
    await send(new PointerEvent("pointermove", { ...pointer, clientX }), view);
    return () => send(new PointerEvent("pointerup", { ...pointer, clientX }), view);
  },
};

const drawn = (id: number, sent: Sent[]) => show(<Page state={waiting(id)} drawnId={id} sent={sent} />);

describe("judging what was looked at", () => {
  beforeEach(() => {
    vi.useFakeTimers({ now: 1_700_000_000_000 });
    vi.spyOn(Event.prototype, "timeStamp", "get").mockImplementation(() => performance.now());
  });
  afterEach(() => {
    vi.restoreAllMocks();
    vi.useRealTimers();
  });

  it("takes one label from a double click, and says that the second press wasn't counted", async () => {
    const sent: Sent[] = [];
    await drawn(1, sent);
    await pass(1000);
    await clickOn("bad");
    await pass(30);
    await drawn(2, sent);
    await pass(80);
    await clickOn("bad", 2);
    expect(sent).toEqual([[1, -1]]);
    expect(hint()).toBe("Too fast, not counted: look at this one first.");
    expect(byTestId("judge-hint").getAttribute("aria-live")).toBe("assertive");
  });

  it.each(["3", "ArrowLeft", "1"])(
    "takes no key either before the proposal was looked at: %s",
    async (key) => {
      const sent: Sent[] = [];
      await drawn(1, sent);
      await pass(LOOK_MS - 1);
      await press(key);
      expect(sent).toEqual([]);
      expect(hint()).toContain("not counted");
    },
  );

  it("takes every quick press that comes later, also one that belongs to a double click", async () => {
    const sent: Sent[] = [];
    for (const [id, act] of [
      [1, () => clickOn("bad")],
      [2, () => clickOn("bad", 2)],
      [3, () => press("3")],
      [4, () => clickOn("good", 3)],
    ] as const) {
      await drawn(id, sent);
      await pass(LOOK_MS);
      expect(accepting()).toBe(true);
      await act();
      expect(hint()).toBe("");
    }
    expect(sent).toEqual([
      [1, -1],
      [2, -1],
      [3, -1],
      [4, 1],
    ]);
  });

  it.each(["mouse", "space bar", "finger"] as const)(
    "takes no press for a proposal that came while it was held, and every other: %s",
    async (how) => {
      const sent: Sent[] = [];
      await drawn(1, sent);
      await pass(1000);
      const lift = await DOWN[how]("bad");
      await pass(40);
      await drawn(2, sent);
      await pass(LOOK_MS + 100);
      expect(accepting()).toBe(true);
      await lift();
      expect(sent).toEqual([]);
      expect(hint()).toBe("Too fast, not counted: look at this one first.");
      const again = await DOWN[how]("good");
      await pass(2000);
      await again();
      expect(sent).toEqual([[2, 1]]);
    },
  );

  it("takes a click without a press, as a screen reader makes it, whatever was pressed and let go before", async () => {
    const sent: Sent[] = [];
    await drawn(1, sent);
    await DOWN.mouse("bad");
    await DOWN["space bar"]("bad");
    await send(new FocusEvent("focusout", { bubbles: true }), byTestId("bad"));
    await send(new KeyboardEvent("keydown", { key: "g", bubbles: true }), byTestId("bad"));
    await drawn(2, sent);
    await pass(LOOK_MS);
    await clickOn("bad", 0);
    expect(sent).toEqual([[2, -1]]);
  });

  it("says that it accepts presses only once it does, and anew for a proposal that an undo brought back", async () => {
    const sent: Sent[] = [];
    await drawn(1, sent);
    expect(accepting()).toBe(false);
    await pass(LOOK_MS);
    expect(accepting()).toBe(true);
    await drawn(2, sent);
    expect(accepting()).toBe(false);
    await drawn(1, sent);
    expect(accepting()).toBe(false);
    await clickOn("good");
    expect(sent).toEqual([]);
  });

  it("lets the hint fade, shows it anew at another press, and drops it at one that counts", async () => {
    const sent: Sent[] = [];
    await drawn(1, sent);
    await press("3");
    const first = byTestId("judge-hint").firstChild;
    await press("3");
    expect(byTestId("judge-hint").firstChild).not.toBe(first);
    await pass(3000);
    expect(hint()).toBe("");
    await drawn(2, sent);
    await press("3");
    expect(hint()).not.toBe("");
    await pass(LOOK_MS);
    await press("3");
    expect(sent).toEqual([[2, -1]]);
    expect(hint()).toBe("");
  });

  it.each([
    [
      "that one was judged already",
      having(snapshot({ proposal: proposal(1) }), {
        type: "acknowledged",
        request_id: "click-1",
        feedback: feedback(1),
      }),
    ],
    ["nothing to judge while the robot moves", having(snapshot({ execution: execution(1) }))],
    ["the next proposal isn’t here yet", having(snapshot())],
    [
      "other robots wait to be judged. Press “In turn” to see their proposals",
      reduce(
        having(
          snapshot({
            experiment: experiment({ num_envs: 2 }),
            proposals: [proposal(1, { robot: 1 })],
            executions: [execution(1)],
          }),
        ),
        { kind: "watch", robot: 0 },
      ),
    ],
  ])("says why a press between two proposals isn't counted: %s", async (why, state) => {
    const sent: Sent[] = [];
    await show(<Page state={state} drawnId={null} sent={sent} />);
    await press("3");
    expect(hint()).toBe(`Not counted: ${why}.`);
    expect(sent).toEqual([]);
  });

  it.each([
    ["paused", { lifecycle: "paused" }],
    ["halted", { halted: true }],
    ["left to a teacher", { teacher: "synthetic" }],
  ] as const)("has nothing to say where nobody is asked: %s", async (_, change) => {
    const sent: Sent[] = [];
    await show(<Page state={waiting(1, change)} drawnId={1} sent={sent} />);
    await pass(LOOK_MS);
    await press("3");
    expect(sent).toEqual([]);
    expect(hint()).toBe("");
    expect(accepting()).toBe(false);
  });
});
