// An emergency stop that nobody confirms: asked for again, told of on every page, and held to when its own is left.
import { act } from "react";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { StopsElsewhere } from "../src/components/StopsElsewhere";
import { Session } from "../src/session";
import type { Action } from "../src/state";
import { stops } from "../src/stops";
import { experiment } from "./messages";
import { show } from "./render";
import { Socket } from "./socket";

type Answer = () => Promise<Response>;

const json =
  (status: number, body: unknown): Answer =>
  async () =>
    new Response(JSON.stringify(body), { status, headers: { "Content-Type": "application/json" } });
const unreachable: Answer = async () => {
  throw new TypeError("no route");
};

describe("an emergency stop", () => {
  let answer: Answer;
  let asked: number;
  let told: Action[];
  let session: Session;

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal("WebSocket", Socket); // that never opens: the network is away
    answer = unreachable;
    asked = 0;
    vi.stubGlobal("fetch", (path: string) => {
      if (!path.endsWith("/experiments/1/halt")) return unreachable();
      asked += 1;
      return answer();
    });
    told = [];
    session = new Session(1, (action) => told.push(action));
    session.open();
  });
  afterEach(async () => {
    await act(async () => {
      session.close();
      stops.forget(1);
    });
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  const pass = (ms: number) => act(async () => vi.advanceTimersByTimeAsync(ms));
  const state = () => document.querySelector<HTMLElement>('[data-testid="stop-elsewhere"]')?.dataset.state;
  const stopping = () => told.findLast((action) => action.kind === "stopping");

  it("is asked for until it is confirmed", async () => {
    session.halt();
    await pass(2500);
    expect(stopping()).toEqual({ kind: "stopping", stopping: "unreachable" });
    expect(asked).toBe(3);
    answer = json(200, experiment({ halted: true }));
    await pass(1000);
    expect(told.at(-1)).toEqual({ kind: "experiment", experiment: experiment({ halted: true }) });
    await pass(10_000);
    expect(asked).toBe(4);
  });

  it("is asked for and told of after its page is left, until somebody has read that it is confirmed", async () => {
    session.halt();
    await pass(100);
    await show(<StopsElsewhere />);
    expect(state()).toBeUndefined(); // its own page tells
    await act(async () => session.close());
    expect(state()).toBe("unreachable");
    await pass(3000);
    expect(asked).toBe(4);
    const leaving = new Event("beforeunload", { cancelable: true });
    window.dispatchEvent(leaving);
    expect(leaving.defaultPrevented).toBe(true);

    answer = json(200, experiment({ halted: true }));
    await pass(1000);
    expect(state()).toBe("confirmed");
    await pass(10_000);
    expect(asked).toBe(5);
    const free = new Event("beforeunload", { cancelable: true });
    window.dispatchEvent(free);
    expect(free.defaultPrevented).toBe(false);
    await act(async () => document.querySelector<HTMLElement>("[data-state=confirmed] button")?.click());
    expect(state()).toBeUndefined();
  });

  it("is taken up again by its own page", async () => {
    session.halt();
    await pass(100);
    session.close();
    told = [];
    session = new Session(1, (action) => told.push(action));
    session.open();
    expect(stopping()).toEqual({ kind: "stopping", stopping: "unreachable" });
    await show(<StopsElsewhere />);
    expect(state()).toBeUndefined();
  });

  it("counts as unconfirmed while an answer is owed", async () => {
    answer = () => new Promise(() => undefined); // a half-open connection
    session.halt();
    await pass(900);
    expect(stopping()).toEqual({ kind: "stopping", stopping: "asked" });
    await pass(200);
    expect(stopping()).toEqual({ kind: "stopping", stopping: "unreachable" });
  });

  it("ends where it is refused for good, and says why", async () => {
    const problem = { title: "", status: 403, detail: "viewers can't stop it", remedy: "ask", fields: [] };
    answer = json(403, problem);
    session.halt();
    await pass(5000);
    expect(asked).toBe(1);
    expect(stopping()).toEqual({ kind: "stopping", stopping: "no" });
    expect(told.at(-1)).toMatchObject({ kind: "notice", tone: "error" });
  });

  it("isn't asked for any more once somebody re-arms here", async () => {
    session.halt();
    await pass(100);
    await session.act("rearm");
    await pass(5000);
    expect(asked).toBe(1);
  });
});
