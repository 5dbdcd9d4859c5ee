// The browser's socket with its wires exposed, to put in its place.
import type { StreamEvent } from "../src/wire";
import { snapshot } from "./messages";

export class Socket {
  static readonly OPEN = 1;
  static readonly CONNECTING = 0;
  static made: Socket[] = [];
  readyState = Socket.CONNECTING;
  binaryType = "";
  sent: string[] = [];
  onmessage: ((message: { data: string | ArrayBuffer }) => void) | null = null;
  onclose: ((closed: { code: number }) => void) | null = null;
  constructor(readonly url: string) {
    Socket.made.push(this);
  }
  send(text: string): void {
    this.sent.push(text);
  }
  close(): void {
    this.readyState = 3;
    this.onclose?.({ code: 1006 });
  }
  accept(): void {
    this.hear(snapshot());
  }
  hear(event: StreamEvent): void {
    this.readyState = Socket.OPEN;
    this.onmessage?.({ data: JSON.stringify(event) });
  }
  static newest(): Socket {
    const socket = Socket.made.at(-1);
    if (!socket) throw new Error("no socket was made");
    return socket;
  }
}
