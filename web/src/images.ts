// Decoded still images by content hash. An overlay may only be shown once its own image is here.
import { at } from "./base";
import type { View } from "./wire";

const KEPT = 16;
const RETRY_MS = 1500;

export type Decode = (url: string) => Promise<ImageBitmap>;

async function fetchAndDecode(url: string): Promise<ImageBitmap> {
  const response = await fetch(at(url));
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return createImageBitmap(await response.blob());
}

export class ImageStore {
  private readonly decoded = new Map<string, ImageBitmap>();
  private readonly loading = new Set<string>();
  private readonly listeners = new Set<() => void>();
  private version = 0;
  private failing = new Set<string>();

  constructor(private readonly decode: Decode = fetchAndDecode) {}

  get(hash: string): ImageBitmap | undefined {
    return this.decoded.get(hash);
  }

  failed(hash: string): boolean {
    return this.failing.has(hash);
  }

  /** Starts loading; the same hash is never fetched twice. Failures are tried again until it works or is forgotten. */
  want(view: View): void {
    const known = this.decoded.get(view.image);
    if (known) {
      this.decoded.delete(view.image);
      this.decoded.set(view.image, known); // newest last
      return;
    }
    if (this.loading.has(view.image)) return;
    this.loading.add(view.image);
    this.decode(view.url).then(
      (picture) => this.keep(view.image, picture),
      () => this.fail(view.image),
    );
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  snapshot = (): number => this.version;

  private keep(hash: string, picture: ImageBitmap): void {
    this.loading.delete(hash);
    this.failing.delete(hash);
    this.decoded.set(hash, picture);
    for (const [oldest, old] of this.decoded) {
      if (this.decoded.size <= KEPT) break;
      this.decoded.delete(oldest);
      old.close();
    }
    this.changed();
  }

  private fail(hash: string): void {
    this.failing.add(hash);
    this.changed();
    setTimeout(() => {
      this.loading.delete(hash);
      this.changed(); // whoever still needs it asks again
    }, RETRY_MS);
  }

  private changed(): void {
    this.version += 1;
    for (const listener of this.listeners) listener();
  }
}
