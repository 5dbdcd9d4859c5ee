// The gallery's pages: each is appended once, and only to what it was asked for.
import { act } from "react";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { GalleryPage } from "../src/pages/GalleryPage";
import { setSearch } from "../src/router";
import type { HistoryPage } from "../src/wire";
import { proposal } from "./messages";
import { byTestId, show } from "./render";

interface Asked {
  query: URLSearchParams;
  answer: (response: Response) => void;
}

const page = (ids: number[], cursor: string | null): Response =>
  Response.json({
    items: ids.map((id) => ({ proposal: proposal(id), feedback: [], execution: null })),
    next_cursor: cursor,
  } satisfies HistoryPage);

describe("the gallery", () => {
  let asked: Asked[];

  beforeEach(() => {
    asked = [];
    vi.stubGlobal("fetch", (path: string) => {
      const { pathname, searchParams } = new URL(path, "http://service");
      if (!pathname.endsWith("/history")) return Promise.reject(new TypeError("nothing else matters here"));
      return new Promise<Response>((answer) => asked.push({ query: searchParams, answer }));
    });
  });
  afterEach(() => {
    act(() => setSearch(new URLSearchParams()));
    vi.unstubAllGlobals();
  });

  const answer = (at: number, response: Response) => act(async () => asked[at]?.answer(response));
  const more = () => act(async () => byTestId("more").click());
  const shown = () =>
    [...document.querySelectorAll('[data-testid="gallery-item"]')].map((each) =>
      Number(each.querySelector(".number")?.textContent),
    );

  it("appends the next page once, however often it is asked for", async () => {
    await show(<GalleryPage id={1} />);
    await answer(0, page([4, 3], "two"));
    await more();
    await more();
    expect(asked.length).toBe(2);
    expect((byTestId("more") as HTMLButtonElement).disabled).toBe(true);
    await answer(1, page([2, 1], null));
    expect(shown()).toEqual([4, 3, 2, 1]);
  });

  it("doesn't append what another choice was asked for", async () => {
    await show(<GalleryPage id={1} />);
    await answer(0, page([4, 3], "two"));
    await more();
    await act(async () => setSearch(new URLSearchParams({ verdict: "good" })));
    await more(); // the shown ones are still those of before
    expect(asked.map(({ query }) => [query.get("verdict"), query.get("cursor")])).toEqual([
      [null, null],
      [null, "two"],
      ["good", null],
    ]);
    await answer(2, page([3], null));
    await answer(1, page([2, 1], null));
    expect(shown()).toEqual([3]);
  });

  it("says why there is no more, and asks again", async () => {
    await show(<GalleryPage id={1} />);
    await answer(0, page([4, 3], "two"));
    await more();
    await answer(1, new Response("", { status: 503 }));
    expect(shown()).toEqual([4, 3]);
    await act(async () => document.querySelector<HTMLElement>("[role=alert] button")?.click());
    await answer(2, page([2, 1], null));
    expect(shown()).toEqual([4, 3, 2, 1]);
    expect(document.querySelector("[role=alert]")).toBeNull();
  });
});
