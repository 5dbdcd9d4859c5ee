import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ImageStore } from "../src/images";
import { proposal } from "./messages";

const picture = () => ({ close: () => undefined }) as unknown as ImageBitmap;

describe("images", () => {
  beforeEach(() => {
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it("fetches a hash once, also for another proposal's address", async () => {
    const asked: string[] = [];
    const store = new ImageStore(async (url) => {
      asked.push(url);
      return picture();
    });
    for (const id of [1, 2]) for (const view of proposal(id).views) store.want(view);
    await vi.runAllTimersAsync();
    for (const view of proposal(3).views) store.want(view);
    expect(asked).toEqual(["/api/v1/proposals/1/images/left", "/api/v1/proposals/1/images/right"]);
    expect(store.get("hash-left")).toBeDefined();
  });

  it("has nothing for a picture that failed, and fetches it again when it is due", async () => {
    let works = false;
    const store = new ImageStore(async () => {
      if (!works) throw new Error("offline");
      return picture();
    });
    const view = proposal(1).views[0];
    if (!view) throw new Error("a proposal has views");
    store.subscribe(() => store.want(view)); // as a page that still shows it does
    store.want(view);
    await vi.advanceTimersByTimeAsync(0);
    expect(store.failed(view.image)).toBe(true);
    expect(store.get(view.image)).toBeUndefined();
    works = true;
    await vi.advanceTimersByTimeAsync(5000);
    expect(store.failed(view.image)).toBe(false);
    expect(store.get(view.image)).toBeDefined();
  });

  it("forgets the oldest first", async () => {
    const store = new ImageStore(async () => picture());
    const [template] = proposal(1).views;
    if (!template) throw new Error("a proposal has views");
    for (let number = 0; number < 40; number += 1) store.want({ ...template, image: `hash-${number}` });
    await vi.runAllTimersAsync();
    expect(store.get("hash-0")).toBeUndefined();
    expect(store.get("hash-39")).toBeDefined();
  });
});
