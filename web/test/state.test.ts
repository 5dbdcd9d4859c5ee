import { describe, expect, it } from "vitest";
import { activity } from "../src/activity";
import { chosenFor, judgeable, overlayWanted } from "../src/selectors";
import { initial, reduce, type TrainerState } from "../src/state";
import type { StreamEvent } from "../src/wire";
import { execution, experiment, feedback, proposal, snapshot } from "./messages";

const click = { click_id: "click-1", trainer: "local", proposal_id: 1, value: 1 as const };

function having(...events: StreamEvent[]): TrainerState {
  return next(initial, ...events);
}

function next(state: TrainerState, ...events: StreamEvent[]): TrainerState {
  return events.reduce((now, event) => reduce(now, { kind: "event", event }), state);
}

const opened = (id: number): StreamEvent => ({ type: "proposal_opened", proposal: proposal(id) });
const closed = (id: number): StreamEvent => ({
  type: "proposal_closed",
  proposal: proposal(id, { closed_at: "2026-01-01T00:00:01Z", close_reason: "judged", verdict: "good" }),
});
const started: StreamEvent = { type: "execution_started", execution: execution(5) };
const ended: StreamEvent = {
  type: "execution_ended",
  execution: execution(5, { outcome: "succeeded", ended_at: "2026-01-01T00:00:05Z" }),
  violations: [],
};

it("passes over an event that only a newer service knows", () => {
  const state = having(snapshot(), opened(1));
  const unknown = { type: "weather_changed", seq: 7 } as unknown as StreamEvent;
  expect(next(state, unknown).proposal?.id).toBe(1);
});

describe("judging", () => {
  it("counts only for the proposal that is drawn", () => {
    const state = having(snapshot(), opened(1));
    expect(judgeable(state, null)).toBe(false);
    expect(judgeable(state, 1)).toBe(true);
    expect(judgeable(next(state, closed(1), opened(2)), 1)).toBe(false);
  });

  it("takes one click a proposal, while it is on its way and after it is acknowledged", () => {
    const sent = reduce(having(snapshot(), opened(1)), { kind: "pending", clicks: [click] });
    expect(judgeable(sent, 1)).toBe(false);
    expect(chosenFor(sent, 1)).toBe(1);
    const acknowledged = next(sent, { type: "acknowledged", request_id: "click-1", feedback: feedback(1) });
    expect(acknowledged.pending).toEqual([]);
    expect(judgeable(acknowledged, 1)).toBe(false);
  });

  it("is possible again once the click is undone and its proposal is open again", () => {
    const judged = next(
      having(snapshot(), opened(1)),
      { type: "acknowledged", request_id: "click-1", feedback: feedback(1) },
      closed(1),
      opened(2),
      { type: "feedback_undone", feedback: feedback(1) },
      opened(1),
      {
        type: "acknowledged",
        request_id: "undo-1",
        feedback: feedback(1, { undone_at: "2026-01-01T00:00:02Z" }),
      },
    );
    expect(judgeable(judged, 1)).toBe(true);
  });

  it.each([
    ["halted", experiment({ halted: true })],
    ["paused", experiment({ lifecycle: "paused" })],
    ["left to a teacher", experiment({ teacher: "synthetic" })],
  ])("is refused while %s", (_, value) => {
    expect(judgeable(having(snapshot({ experiment: value, proposal: proposal(1) })), 1)).toBe(false);
  });

  it("is refused for an evaluation's proposal", () => {
    expect(judgeable(having(snapshot({ proposal: proposal(1, { purpose: "evaluation" }) })), 1)).toBe(false);
  });

  it("says that a late click isn't counted", () => {
    const late = having(snapshot(), {
      type: "acknowledged",
      request_id: "click-1",
      feedback: feedback(1, { status: "late", value: -1 }),
    });
    expect(late.notices.map((notice) => notice.text)).toEqual(["Your “bad” came too late: not counted."]);
  });

  it("drops a refused click, and keeps it where the service itself failed", () => {
    const sent = reduce(having(snapshot()), { kind: "pending", clicks: [click] });
    const problem = {
      type: "about:blank",
      title: "x",
      status: 409,
      detail: "Closed.",
      remedy: "Go on.",
      fields: [],
    };
    expect(next(sent, { type: "refused", request_id: "click-1", problem }).pending).toEqual([]);
    const fault = next(sent, {
      type: "refused",
      request_id: "click-1",
      problem: { ...problem, status: 507 },
    });
    expect(fault.pending).toEqual([click]);
    expect(fault.notices[0]?.text).toBe("Closed. Go on.");
  });
});

describe("pictures", () => {
  it("shows no overlay from the start of a motion until new pictures come", () => {
    const moving = having(snapshot(), opened(1), closed(1), started);
    expect(overlayWanted(moving)).toBe(false);
    expect(moving.live).toBe(5);
    const still = next(moving, ended);
    expect(overlayWanted(still)).toBe(false);
    const fresh = next(still, opened(2));
    expect(fresh.live).toBeNull();
    expect(overlayWanted(fresh)).toBe(true);
  });

  it("shows no overlay of a withdrawn proposal", () => {
    const withdrawn = proposal(1, { closed_at: "2026-01-01T00:00:01Z", close_reason: "withdrawn" });
    expect(
      overlayWanted(having(snapshot(), opened(1), { type: "proposal_closed", proposal: withdrawn })),
    ).toBe(false);
  });

  it("ignores the closing of another proposal", () => {
    expect(having(snapshot(), opened(2), closed(1)).proposal?.closed_at).toBeNull();
  });
});

describe("coming back", () => {
  it("takes everything from the snapshot of a restarted service and says so", () => {
    const before = having(snapshot({ proposal: proposal(1), undoable: feedback(9) }), started);
    const back = next(
      before,
      snapshot({ boot_id: "boot-2", experiment: experiment({ lifecycle: "paused" }) }),
    );
    expect(back.execution).toBeNull();
    expect(back.undoable).toBeNull();
    expect(back.proposal?.closed_at).not.toBeNull();
    expect(back.experiment?.lifecycle).toBe("paused");
    expect(back.notices.at(-1)?.text).toContain("restarted");
  });

  it("lets the open proposal be judged again: the click on it may have been undone meanwhile", () => {
    const judged = having(snapshot({ proposal: proposal(1) }), {
      type: "acknowledged",
      request_id: "click-1",
      feedback: feedback(1),
    });
    expect(judgeable(judged, 1)).toBe(false);
    expect(judgeable(next(judged, snapshot({ proposal: proposal(1) })), 1)).toBe(true);
  });

  it("says nothing after a mere reconnect", () => {
    expect(having(snapshot(), snapshot()).notices).toEqual([]);
  });

  it("doesn't let an older answer by REST overtake the stream", () => {
    const state = having(
      snapshot({ experiment: experiment({ phase: "executing", updated_at: "2026-01-01T00:00:02Z" }) }),
    );
    expect(reduce(state, { kind: "experiment", experiment: experiment({ phase: "idle" }) })).toBe(state);
  });
});

describe("undo", () => {
  it("is offered while the service says so and gone once something moves", () => {
    const stored = having(snapshot(), opened(1), {
      type: "feedback_stored",
      feedback: feedback(1),
      undoable: true,
    });
    expect(stored.undoable?.id).toBe(1);
    expect(next(stored, started).undoable).toBeNull();
    expect(next(stored, { type: "feedback_undone", feedback: feedback(1) }).undoable).toBeNull();
  });

  it.each([
    ["paused", experiment({ lifecycle: "paused" })],
    ["finished", experiment({ lifecycle: "finished", phase: "idle" })],
    ["failed", experiment({ lifecycle: "failed", phase: "idle" })],
    ["halted", experiment({ halted: true })],
    ["looking at a new scene", experiment({ phase: "observing" })],
  ])("is gone once the experiment is %s, and no late news brings it back", (_, value) => {
    const stored: StreamEvent = { type: "feedback_stored", feedback: feedback(1), undoable: true };
    const before = having(snapshot(), opened(1), stored, closed(1), opened(2));
    expect(before.undoable?.id).toBe(1);
    const after = next(before, { type: "experiment_changed", experiment: value });
    expect(after.undoable).toBeNull();
    expect(next(after, stored).undoable).toBeNull();
  });

  it("is gone at a reset, which withdraws the open proposal", () => {
    const stored: StreamEvent = { type: "feedback_stored", feedback: feedback(1), undoable: true };
    const withdrawn = proposal(2, { closed_at: "2026-01-01T00:00:01Z", close_reason: "withdrawn" });
    const state = having(snapshot(), opened(1), stored, closed(1), opened(2));
    expect(next(state, { type: "proposal_closed", proposal: withdrawn }).undoable).toBeNull();
  });
});

describe("emergency stop", () => {
  it("stays asked for until the service confirms it", () => {
    const asked = reduce(having(snapshot()), { kind: "stopping", stopping: "asked" });
    expect(asked.stopping).toBe("asked");
    const halted = next(asked, { type: "experiment_changed", experiment: experiment({ halted: true }) });
    expect(halted.stopping).toBe("no");
    expect(activity(halted, true).tone).toBe("stopped");
  });
});

describe("curve", () => {
  it("is sorted, has one point a feedback, and the newest word wins", () => {
    const point = (amount: number, successes: number) => ({
      feedback: amount,
      at: "2026-01-01T00:00:00Z",
      values: { successes },
    });
    const state = reduce(having(snapshot()), {
      kind: "metrics",
      points: [point(3, 1), point(1, 0), point(3, 2)],
    });
    expect(state.curve).toEqual([
      { feedback: 0, successes: 0 },
      { feedback: 1, successes: 0 },
      { feedback: 3, successes: 2 },
    ]);
    const added = next(state, { type: "metrics_added", point: point(4, 2) });
    expect(added.curve.at(-1)).toEqual({ feedback: 4, successes: 2 });
  });
});

describe("what is going on", () => {
  it.each([
    ["Waiting for you", having(snapshot({ proposal: proposal(1) }))],
    ["Executing pick, live video", having(snapshot({ execution: execution(1) }))],
    ["Learning from your feedback", having(snapshot({ experiment: experiment({ phase: "learning" }) }))],
    [
      "Starting the robot and the learner",
      having(snapshot({ experiment: experiment({ phase: "starting" }) })),
    ],
    [
      "The learner takes the stored labels back: 4,000 of 1,000,000",
      having(
        snapshot({
          experiment: experiment({ phase: "starting", catching_up: { taken: 4000, of: 1_000_000 } }),
        }),
      ),
    ],
    [
      "Paused. Nothing moves.",
      having(snapshot({ experiment: experiment({ lifecycle: "paused", phase: "idle" }) })),
    ],
    [
      "The synthetic teacher is judging",
      having(snapshot({ experiment: experiment({ teacher: "synthetic" }), proposal: proposal(1) })),
    ],
  ])("%s", (text, state) => {
    expect(activity(state, true).text).toBe(text);
  });

  it.each(["paused", "finished"] as const)(
    "never says that nothing moves while a skill moves: %s",
    (lifecycle) => {
      const changed = (phase: "executing" | "idle"): StreamEvent => ({
        type: "experiment_changed",
        experiment: experiment({ lifecycle, phase }),
      });
      const moving = having(snapshot(), opened(1), closed(1), started, changed("executing"));
      expect(activity(moving, true)).toEqual({ tone: "moving", text: `Finishing pick, then ${lifecycle}` });
      // Also where only one of both is known.
      expect(activity(next(moving, changed("idle")), true).tone).toBe("moving");
      expect(activity(next(moving, ended), true)).toEqual({
        tone: "moving",
        text: `Finishing the skill, then ${lifecycle}`,
      });
      expect(activity(next(moving, ended, changed("idle")), true).tone).toBe("still");
    },
  );

  it("says that it is evaluated while it is paused", () => {
    const paused = experiment({ lifecycle: "paused", phase: "evaluating" });
    expect(activity(having(snapshot({ experiment: paused, execution: execution(1) })), true).text).toBe(
      "Evaluating",
    );
  });

  it("doesn't ask for a judgement before the pictures are there", () => {
    expect(activity(having(snapshot({ proposal: proposal(1) })), false).text).toBe("Loading the pictures");
  });

  it("tells of a click kept while offline", () => {
    let state = having(snapshot({ proposal: proposal(1) }));
    state = reduce(state, { kind: "connection", connection: "lost" });
    state = reduce(state, { kind: "pending", clicks: [click] });
    expect(activity(state, true).text).toBe("“good” is kept until the connection is back");
  });

  it("tells of a dead and a restarted worker", () => {
    const died = having(snapshot(), {
      type: "worker_changed",
      worker: "robot",
      robot: 0,
      status: "died",
      detail: "signal 9",
    });
    expect(died.notices[0]?.text).toBe("The robot's process died and is being restarted. signal 9");
  });
});
