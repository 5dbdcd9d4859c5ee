// An undo that a dead connection swallows: sent again when the connection is back, and answered to whoever asked.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Session } from "../src/session";
import type { Action } from "../src/state";
import type { ClientMessage, Feedback, StreamEvent } from "../src/wire";
import { feedback, proposal, snapshot } from "./messages";
import { Socket } from "./socket";

describe("an undo", () => {
  let told: Action[];
  let stored: Feedback;
  let session: Session;
  const sent = () => Socket.newest().sent.map((text) => JSON.parse(text) as ClientMessage);
  const undos = () => sent().filter((message) => message.type === "undo");
  const again = async () => {
    Socket.newest().close(); // half-open until here: what was sent is gone
    await vi.advanceTimersByTimeAsync(500);
    Socket.newest().hear(snapshot());
    await vi.advanceTimersByTimeAsync(0); // the clicks wait until the service has said who sits here
  };
  const refusal = (requestId: string): StreamEvent => ({
    type: "refused",
    request_id: requestId,
    problem: { type: "", title: "", status: 409, detail: "can't be undone", remedy: "go on", fields: [] },
  });
  const refusals = () => told.filter((each) => each.kind === "event" && each.event.type === "refused");

  beforeEach(() => {
    vi.useFakeTimers();
    localStorage.clear();
    Socket.made = [];
    vi.stubGlobal("WebSocket", Socket);
    stored = feedback(1);
    vi.stubGlobal("fetch", async (path: string) => {
      if (path.includes("/feedback/1?")) return new Response(JSON.stringify(stored));
      if (path.endsWith("/me")) return Response.json({ login: false, name: "local", role: "owner" });
      throw new TypeError("nothing else is asked for here");
    });
    told = [];
    session = new Session(1, (action) => told.push(action));
    session.open();
    Socket.newest().hear(snapshot({ proposal: proposal(2) }));
  });
  afterEach(() => {
    session.close();
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it("is sent again by its own id, before what was clicked after it, until it is answered", async () => {
    session.undo(1);
    session.undo(1); // pressed twice: it is on its way
    const [first] = undos();
    expect(undos().length).toBe(1);
    session.judge(proposal(2), -1, true);
    await again();
    const judging = sent().filter(({ type }) => type === "undo" || type === "feedback");
    expect(judging.map(({ type }) => type)).toEqual(["undo", "feedback"]);
    expect(undos()).toEqual([first]);
    const { request_id } = first as { request_id: string };
    Socket.newest().hear({
      type: "acknowledged",
      request_id,
      feedback: feedback(1, { undone_at: "2026-01-01" }),
    });
    await again();
    expect(undos()).toEqual([]);
  });

  it("says nothing where it had come through after all", async () => {
    session.undo(1);
    await again();
    stored = feedback(1, { undone_at: "2026-01-01T00:00:09Z" });
    const [asked] = undos() as { request_id: string }[];
    Socket.newest().hear(refusal(asked?.request_id ?? ""));
    await vi.advanceTimersByTimeAsync(0);
    expect(refusals()).toEqual([]);
  });

  it("says so where it came too late", async () => {
    session.undo(1);
    await again();
    const [asked] = undos() as { request_id: string }[];
    Socket.newest().hear(refusal(asked?.request_id ?? ""));
    await vi.advanceTimersByTimeAsync(0);
    expect(refusals().length).toBe(1);
    session.undo(1);
    expect(undos().length).toBe(2); // answered, so it may be asked for anew
  });

  it("isn't promised where the connection is known to be gone", () => {
    Socket.newest().close();
    session.undo(1);
    expect(told.at(-1)).toMatchObject({ kind: "notice", tone: "warning" });
  });
});
