// One WebSocket per open experiment, kept alive: heartbeat, backoff, and an immediate try when the device comes back.
import { at } from "./base";
import { type Frame, parseFrame } from "./frames";
import { signedOut } from "./me";
import type { ClientMessage, StreamEvent } from "./wire";

export type Connection = "connecting" | "open" | "lost";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 8000;
const PING_MS = 3000;
const SILENCE_MS = 5000;
/** The code by which the service says that the access of whoever sits here has ended. */
const SIGNED_OUT = 4401;

/** Where an experiment's stream is. */
export function streamUrl(id: number): string {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  return `${scheme}://${location.host}${at(`/api/v1/experiments/${id}/stream`)}`;
}

export interface StreamHandlers {
  onEvent: (event: StreamEvent) => void;
  onFrame: (frame: Frame) => Promise<void>;
  onConnection: (connection: Connection) => void;
}

export class Stream {
  private socket: WebSocket | null = null;
  private wait = FIRST_WAIT_MS;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private heartbeat: ReturnType<typeof setInterval> | undefined;
  /** Since when an answer is owed: a hidden tab's timers sleep, so silence alone proves nothing. */
  private owedSince: number | null = null;
  private saidAt = 0;
  private closed = false;
  /** Where to go on after a break: the service's run, and the number of the last event heard in it. */
  private heard: { bootId: string; seq: number } | null = null;

  /** `trainer`: who sits at this page to judge; null: it only looks. */
  constructor(
    private readonly url: string,
    private readonly trainer: string | null,
    private readonly handlers: StreamHandlers,
  ) {}

  start(): void {
    this.closed = false;
    window.addEventListener("online", this.hurry);
    window.addEventListener("offline", this.doubt);
    document.addEventListener("visibilitychange", this.hurry);
    this.heartbeat = setInterval(this.beat, PING_MS);
    this.connect();
  }

  stop(): void {
    this.closed = true;
    window.removeEventListener("online", this.hurry);
    window.removeEventListener("offline", this.doubt);
    document.removeEventListener("visibilitychange", this.hurry);
    clearInterval(this.heartbeat);
    clearTimeout(this.retry);
    this.drop();
  }

  /** Whether the message left; false means the socket isn't open. */
  send(message: ClientMessage): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    this.saidAt = Date.now();
    return true;
  }

  private connect(): void {
    clearTimeout(this.retry);
    this.handlers.onConnection("connecting");
    const { heard, trainer } = this;
    const query = new URLSearchParams({
      ...(trainer !== null && { trainer }),
      ...(heard && { boot_id: heard.bootId, since: `${heard.seq}` }),
    });
    const socket = new WebSocket(`${this.url}?${query}`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.owedSince = Date.now();
    socket.onmessage = (message) => this.receive(socket, message.data);
    socket.onclose = ({ code }) => {
      if (code === SIGNED_OUT) signedOut();
      this.lost(socket);
    };
  }

  private receive(socket: WebSocket, data: string | ArrayBuffer): void {
    if (socket !== this.socket) return;
    this.owedSince = null;
    if (typeof data !== "string") {
      const frame = parseFrame(data);
      const done = () => this.send({ type: "frame_ack" });
      if (frame) void this.handlers.onFrame(frame).then(done);
      else done();
      return;
    }
    const event = JSON.parse(data) as StreamEvent;
    // While a hidden page's heartbeat sleeps the service asks by this, and would let it go without an answer.
    if (event.type === "pong" && Date.now() - this.saidAt > PING_MS) this.ping();
    if (event.type === "snapshot") this.heard = { bootId: event.boot_id, seq: event.seq ?? 0 };
    else if (event.type !== "resumed" && event.seq && this.heard) this.heard.seq = event.seq;
    if (event.type === "snapshot" || event.type === "resumed") {
      // Only now is the page in step with the service: an open socket alone promises nothing.
      this.wait = FIRST_WAIT_MS;
      this.handlers.onEvent(event);
      this.handlers.onConnection("open");
      this.ping(); // so that the service soon finds out where the network dies from now on
    } else {
      this.handlers.onEvent(event);
    }
  }

  private lost(socket: WebSocket): void {
    if (socket !== this.socket || this.closed) return;
    this.socket = null;
    this.handlers.onConnection("lost");
    clearTimeout(this.retry);
    // Jitter: many pages shouldn't come back to a restarted service in the same millisecond.
    this.retry = setTimeout(() => this.connect(), this.wait * (0.75 + Math.random() / 2));
    this.wait = Math.min(this.wait * 1.7, LONGEST_WAIT_MS);
  }

  private drop(): void {
    const socket = this.socket;
    this.socket = null;
    if (!socket) return;
    socket.onmessage = null;
    socket.onclose = null;
    socket.close();
  }

  private restart(): void {
    const socket = this.socket;
    this.drop();
    if (socket) this.handlers.onConnection("lost");
    this.connect();
  }

  private hurry = (): void => {
    if (this.closed || document.visibilityState === "hidden") return;
    this.wait = FIRST_WAIT_MS;
    if (this.socket?.readyState === WebSocket.OPEN) this.ping();
    else if (this.socket?.readyState !== WebSocket.CONNECTING) this.restart();
  };

  /** The device says it has no network: a half-open socket would keep clicks waiting for its time-out. */
  private doubt = (): void => {
    const socket = this.socket;
    if (!socket) return;
    this.drop();
    this.socket = socket;
    this.lost(socket);
  };

  private beat = (): void => {
    if (!this.socket) return;
    if (this.owedSince === null) this.ping();
    else if (Date.now() - this.owedSince > SILENCE_MS) this.restart();
  };

  private ping(): void {
    if (this.send({ type: "ping", regular: true })) this.owedSince ??= Date.now();
  }
}
