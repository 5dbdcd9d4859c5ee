// Several robots: one queue of proposals, and nothing of one robot passes for another's.
import { act } from "react";
import { describe, expect, it } from "vitest";
import { CameraView } from "../src/components/CameraView";
import { RobotPicker } from "../src/components/RobotPicker";
import { FrameSink } from "../src/frames";
import { queueOf } from "../src/robots";
import { chosenFor, judgeable } from "../src/selectors";
import { initial, reduce, type TrainerState } from "../src/state";
import type { Execution, Proposal, StreamEvent } from "../src/wire";
import { execution, experiment, feedback, proposal, snapshot } from "./messages";
import { byTestId, show } from "./render";

const three = experiment({ num_envs: 3 });
const of = (robot: number, id: number, change: Partial<Proposal> = {}) => proposal(id, { robot, ...change });
const opened = (robot: number, id: number): StreamEvent => ({
  type: "proposal_opened",
  proposal: of(robot, id),
});
const closed = (robot: number, id: number): StreamEvent => ({
  type: "proposal_closed",
  proposal: of(robot, id, { closed_at: "2026-01-01T00:00:01Z", close_reason: "judged", verdict: "good" }),
});
const motion = (robot: number, id: number, change: Partial<Execution> = {}) =>
  execution(id, { robot, proposal_id: id, ...change });
const started = (robot: number, id: number): StreamEvent => ({
  type: "execution_started",
  execution: motion(robot, id),
});
const ended = (robot: number, id: number, change: Partial<Execution> = {}): StreamEvent => ({
  type: "execution_ended",
  execution: motion(robot, id, { ended_at: "2026-01-01T00:00:05Z", outcome: "succeeded", ...change }),
  violations: [],
});

const next = (state: TrainerState, ...events: StreamEvent[]): TrainerState =>
  events.reduce((now, event) => reduce(now, { kind: "event", event }), state);
const waiting = next(
  initial,
  snapshot({ experiment: three, proposals: [of(0, 1), of(1, 2), of(2, 3)], proposal: of(0, 1) }),
);

describe("one queue", () => {
  it("shows the oldest open proposal, then the next one, while the first robot moves", () => {
    expect([waiting.shown, waiting.proposal?.id]).toEqual([0, 1]);
    expect(queueOf(waiting.robots, {}).map(({ id }) => id)).toEqual([1, 2, 3]);
    const moving = next(waiting, closed(0, 1), started(0, 1));
    expect([moving.shown, moving.proposal?.id, moving.execution, moving.live]).toEqual([1, 2, null, null]);
    expect(judgeable(moving, 2)).toBe(true);
    expect(judgeable(moving, 1)).toBe(false);
    // what another robot is proposed meanwhile waits behind those that are there
    expect(next(moving, ended(0, 1), opened(0, 4)).proposal?.id).toBe(2);
  });

  it("stays with the robot judged last where nothing waits, and goes on as soon as something does", () => {
    const all = [0, 1, 2].flatMap((robot) => [closed(robot, robot + 1), started(robot, robot + 1)]);
    const moving = next(waiting, ...all);
    expect([moving.shown, moving.execution?.id, moving.live]).toEqual([2, 3, 3]);
    const asked = next(moving, ended(0, 1), opened(0, 4));
    expect([asked.shown, asked.proposal?.id, asked.live]).toEqual([0, 4, null]);
  });

  it("shows a robot that moves to whoever comes while nothing waits", () => {
    const come = next(initial, snapshot({ experiment: three, executions: [motion(1, 2)] }));
    expect([come.shown, come.live]).toEqual([1, 2]);
  });

  it("keeps to the robot that someone wants to see", () => {
    const watching = reduce(next(waiting, closed(0, 1), started(0, 1)), { kind: "watch", robot: 0 });
    expect([watching.shown, watching.live]).toEqual([0, 1]);
    expect(judgeable(watching, 2)).toBe(false);
    expect(reduce(watching, { kind: "watch", robot: null }).proposal?.id).toBe(2);
  });

  it("goes on to the next robot where a judged proposal waits until the others are judged too", () => {
    const ack = (id: number): StreamEvent => ({
      type: "acknowledged",
      request_id: `click-${id}`,
      feedback: feedback(id, { click_id: `click-${id}`, proposal_id: id }),
    });
    const one = next(waiting, ack(1));
    expect([one.shown, one.proposal?.id, queueOf(one.robots, one.judged).length]).toEqual([1, 2, 2]);
    const all = next(one, ack(2), ack(3));
    expect(queueOf(all.robots, all.judged)).toEqual([]);
    expect([1, 2, 3].map((id) => chosenFor(all, id))).toEqual([1, 1, 1]);
    const undone = next(all, { type: "feedback_undone", feedback: feedback(2) }, opened(1, 2));
    expect([undone.proposal?.id, judgeable(undone, 2), judgeable(undone, 3)]).toEqual([2, true, false]);
    const judged = [closed(0, 1), closed(1, 2), closed(2, 3)];
    const later = next(all, ...judged, opened(2, 4), opened(0, 5), opened(1, 6));
    expect([later.proposal?.id, later.judged]).toEqual([4, {}]);
  });

  it("doesn't jump about where a teacher judges", () => {
    const taught = next(
      initial,
      snapshot({ experiment: experiment({ num_envs: 3, teacher: "synthetic" }), proposals: [of(1, 2)] }),
    );
    expect(taught.shown).toBe(0);
    expect(next(taught, opened(2, 3)).shown).toBe(0);
  });
});

describe("undo", () => {
  const clicked = next(waiting, {
    type: "feedback_stored",
    feedback: feedback(2, { value: -1 }),
    undoable: true,
  });

  it("stays possible while another robot moves, until the judged one does", () => {
    const other = next(clicked, closed(0, 1), started(0, 1), opened(1, 4));
    expect(other.undoable?.proposal_id).toBe(2);
    expect(next(other, started(1, 4)).undoable).toBeNull();
  });

  it("brings its proposal back to the front", () => {
    const gone = next(clicked, closed(1, 2), closed(0, 1), opened(1, 5));
    expect(gone.proposal?.id).toBe(3);
    const back = next(gone, { type: "feedback_undone", feedback: feedback(2) }, opened(1, 2));
    expect(back.proposal?.id).toBe(2);
    expect(judgeable(back, 2)).toBe(true);
  });
});

it("says whose news it is", () => {
  const told = next(
    waiting,
    closed(1, 2),
    started(1, 2),
    ended(1, 2, { task_success: true, outcome: "interrupted" }),
    { type: "worker_changed", worker: "robot", robot: 2, status: "died", detail: "signal 9" },
  ).notices.map(({ text }) => text);
  expect(told).toEqual([
    "Robot 2: Task solved.",
    "Robot 2: The pick was interrupted. It won't be repeated by itself.",
    "Robot 3's process died and is being restarted. signal 9",
  ]);
});

it("draws no live picture of another robot", async () => {
  const frames = new FrameSink();
  const view = proposal(1).views[0];
  if (!view) throw new Error("no view");
  const drawn: unknown[] = [];
  const context = { drawImage: (picture: unknown) => drawn.push(picture), clearRect: () => undefined };
  HTMLCanvasElement.prototype.getContext = (() => context) as never;
  globalThis.createImageBitmap = (async (jpeg: Blob) => ({
    name: await jpeg.text(),
    close: () => undefined,
  })) as never;
  await show(
    <CameraView
      side="left"
      view={view}
      picture={undefined}
      skill={null}
      proposalId={1}
      overlay={false}
      judged={false}
      robot={1}
      live={7}
      moving={true}
      frames={frames}
    />,
  );
  const header = { camera: "left", width: 640, height: 480, taken_at: 0, execution_id: 7, telemetry: null };
  await act(async () => {
    await frames.show({ header: { ...header, robot: 0 }, jpeg: new Blob(["other"]) });
    await frames.show({ header: { ...header, robot: 1 }, jpeg: new Blob(["own"]) });
  });
  expect(drawn).toMatchObject([{ name: "own" }]);
});

it("offers every robot, and says what each does and how many proposals wait", async () => {
  const chosen: (number | null)[] = [];
  const moving = next(waiting, closed(0, 1), started(0, 1));
  await show(
    <RobotPicker
      robots={moving.robots}
      judged={moving.judged}
      chosen={null}
      shown={1}
      onChoose={(robot) => chosen.push(robot)}
    />,
  );
  expect(byTestId("queue").textContent).toBe("Robot 2 of 32 proposals wait");
  expect(byTestId("robot-1").dataset.doing).toBe("moving");
  expect(byTestId("robot-2").dataset.doing).toBe("waiting");
  byTestId("robot-3").click();
  expect(chosen).toEqual([2]);
});
