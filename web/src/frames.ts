// Live video: binary messages `[u32 big-endian header length][JSON header][JPEG]`, drawn straight onto canvases.
import type { FrameHeader } from "./wire";

export interface Frame {
  header: FrameHeader;
  jpeg: Blob;
}

/** The frame in a binary message, or null where it is damaged. */
export function parseFrame(message: ArrayBuffer): Frame | null {
  if (message.byteLength < 4) return null;
  const length = new DataView(message).getUint32(0);
  if (4 + length >= message.byteLength) return null;
  try {
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(message, 4, length))) as FrameHeader;
    return { header, jpeg: new Blob([new Uint8Array(message, 4 + length)], { type: "image/jpeg" }) };
  } catch {
    return null;
  }
}

type Draw = (header: FrameHeader, picture: ImageBitmap) => void;

/** Hands decoded frames to whoever shows that camera. */
export class FrameSink {
  private readonly screens = new Map<string, Draw>();

  attach(camera: string, draw: Draw): () => void {
    this.screens.set(camera, draw);
    return () => {
      if (this.screens.get(camera) === draw) this.screens.delete(camera);
    };
  }

  async show(frame: Frame): Promise<void> {
    const draw = this.screens.get(frame.header.camera);
    if (!draw) return;
    try {
      const picture = await createImageBitmap(frame.jpeg);
      draw(frame.header, picture);
      picture.close();
    } catch {
      // One damaged picture of a video isn't worth a word; the next one comes in a tenth of a second.
    }
  }
}
