import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { type Connection, Stream } from "../src/stream";
import { snapshot } from "./messages";
import { Socket } from "./socket";

/** Said at once when a page is in step, and again and again after that. */
const BEAT = '{"type":"ping","regular":true}';

describe("stream", () => {
  let states: Connection[];
  let stream: Stream;

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal("WebSocket", Socket);
    Socket.made = [];
    states = [];
    stream = new Stream("ws://service/stream", "ann", {
      onEvent: () => undefined,
      onFrame: async () => undefined,
      onConnection: (connection) => states.push(connection),
    });
    stream.start();
  });
  afterEach(() => {
    stream.stop();
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it("is open only once a snapshot came", () => {
    expect(states).toEqual(["connecting"]);
    Socket.newest().accept();
    expect(states.at(-1)).toBe("open");
  });

  it("comes back by itself, waiting longer each time", () => {
    Socket.newest().close();
    expect(states.at(-1)).toBe("lost");
    vi.advanceTimersByTime(400);
    expect(Socket.made.length).toBe(2);
    Socket.newest().close();
    vi.advanceTimersByTime(300);
    expect(Socket.made.length).toBe(2);
    vi.advanceTimersByTime(400);
    expect(Socket.made.length).toBe(3);
  });

  it("goes on after the last event that it heard", () => {
    Socket.newest().hear({ ...snapshot(), boot_id: "run-1", seq: 7 });
    Socket.newest().hear({ type: "metrics_added", point: { feedback: 1, at: "", values: {} }, seq: 8 });
    Socket.newest().hear({ type: "pong", seq: null });
    Socket.newest().close();
    vi.advanceTimersByTime(400);
    expect(Socket.newest().url).toBe("ws://service/stream?trainer=ann&boot_id=run-1&since=8");
    Socket.newest().hear({ type: "resumed", missed: 1, seq: 9 });
    expect(states.at(-1)).toBe("open");
    Socket.newest().close(); // before the missed event came
    vi.advanceTimersByTime(400);
    expect(Socket.newest().url).toBe("ws://service/stream?trainer=ann&boot_id=run-1&since=8");
  });

  it("tries at once when the device is online again", () => {
    Socket.newest().close();
    window.dispatchEvent(new Event("online"));
    expect(Socket.made.length).toBe(2);
  });

  it("leaves a connection alone that answers, however late its timers ring", () => {
    Socket.newest().accept();
    Socket.newest().onmessage?.({ data: '{"type":"pong"}' });
    for (let minute = 0; minute < 5; minute += 1) {
      vi.setSystemTime(Date.now() + 60_000); // a hidden tab: the clock goes on, the timer sleeps
      vi.advanceTimersByTime(3000);
      Socket.newest().onmessage?.({ data: '{"type":"pong"}' });
    }
    expect(Socket.made.length).toBe(1);
  });

  it("answers a service that asks whether it is there, while its timers sleep, and chats with none", () => {
    const socket = Socket.newest();
    socket.accept();
    expect(socket.sent).toEqual([BEAT]);
    vi.setSystemTime(Date.now() + 4000);
    socket.onmessage?.({ data: '{"type":"pong"}' });
    socket.onmessage?.({ data: '{"type":"pong"}' });
    expect(socket.sent).toEqual([BEAT, BEAT]);
  });

  it("gives up on a silent connection", () => {
    Socket.newest().accept();
    vi.advanceTimersByTime(15_000);
    expect(Socket.made.length).toBeGreaterThan(1);
  });

  it("acknowledges every frame, also a damaged one", async () => {
    const socket = Socket.newest();
    socket.accept();
    socket.onmessage?.({ data: new ArrayBuffer(2) });
    expect(socket.sent).toEqual([BEAT, '{"type":"frame_ack"}']);
  });

  it("says when a message can't leave", () => {
    expect(stream.send({ type: "ping", regular: false })).toBe(false);
    Socket.newest().accept();
    expect(stream.send({ type: "ping", regular: false })).toBe(true);
  });
});
