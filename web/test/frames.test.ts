import { describe, expect, it } from "vitest";
import { parseFrame } from "../src/frames";

function packed(header: string, jpeg: number[]): ArrayBuffer {
  const text = new TextEncoder().encode(header);
  const message = new Uint8Array(4 + text.length + jpeg.length);
  new DataView(message.buffer).setUint32(0, text.length);
  message.set(text, 4);
  message.set(jpeg, 4 + text.length);
  return message.buffer;
}

describe("frames", () => {
  it("splits header and picture", async () => {
    const header = { camera: "left", width: 640, height: 480, taken_at: 1.5, execution_id: 3 };
    const frame = parseFrame(packed(JSON.stringify(header), [0xff, 0xd8, 0xff]));
    expect(frame?.header).toEqual(header);
    expect(new Uint8Array((await frame?.jpeg.arrayBuffer()) ?? [])).toEqual(
      new Uint8Array([0xff, 0xd8, 0xff]),
    );
  });

  it.each([
    ["empty", new ArrayBuffer(0)],
    ["no picture", packed("{}", [])],
    ["no JSON", packed("{", [1])],
    ["a header longer than the message", new Uint8Array([0, 0, 1, 0, 1, 2]).buffer],
  ])("is null for a damaged message: %s", (_, message) => {
    expect(parseFrame(message)).toBeNull();
  });
});
