// The labels over time: as far apart as they were, told in words, and reached by keys.
import { describe, expect, it } from "vitest";
import { Timeline } from "../src/components/Timeline";
import type { Stretch } from "../src/wire";
import { byTestId, press, show } from "./render";

const stretch = (minute: number, change: Partial<Stretch>): Stretch => ({
  at: `2026-01-01T00:${String(minute).padStart(2, "0")}:00Z`,
  good: 0,
  neutral: 0,
  bad: 0,
  cant_tell: 0,
  executions: 0,
  violations: 0,
  proposal: minute + 1,
  episode: 1,
  ...change,
});

const told = {
  seconds: 60,
  started_at: "2026-01-01T00:00:00Z",
  ended_at: "2026-01-01T00:30:20Z",
  stretches: [
    stretch(0, { bad: 4 }),
    stretch(1, { good: 1, cant_tell: 1, executions: 1 }),
    stretch(30, { good: 2, violations: 1, executions: 2, episode: 3 }),
  ],
};

const bars = () => [...document.querySelectorAll<HTMLAnchorElement>('[data-testid="stretch"]')];

describe("the timeline", () => {
  it("puts labels where they were in time, and says how many there were", async () => {
    await show(<Timeline id={7} told={told} />);
    expect(bars().map((bar) => bar.parentElement?.style.gridColumn)).toEqual(["1", "2", "31"]);
    expect(document.querySelector<HTMLElement>("ol")?.style.gridTemplateColumns).toContain("31");
    expect(byTestId("timeline-words").textContent).toBe(
      "Labels over time: 3 good, 4 bad, 1 can’t tell, 3 executed, 1 with a violation",
    );
    expect(bars().map((bar) => bar.getAttribute("aria-label")?.replace(/^.*: /, ""))).toEqual([
      "0 good, 4 bad",
      "1 good, 0 bad, 1 can’t tell, 1 executed",
      "2 good, 0 bad, 2 executed, 1 with a violation",
    ]);
    const height = (index: number, label: string) =>
      bars()[index]?.querySelector<HTMLElement>(`[data-label=${label}]`)?.style.height;
    expect([height(0, "bad"), height(1, "good"), height(2, "good")]).toEqual(["100%", "25%", "50%"]);
    expect(bars()[2]?.querySelector("[data-came]")?.getAttribute("data-came")).toBe("violation");
    expect(byTestId("timeline-axis").querySelectorAll("time").length).toBe(3);
    expect(bars()[2]?.pathname).toMatch(/experiments\/7\/episodes\/3$/);
  });

  it("is one stop of the Tab key, and the arrow keys go along it", async () => {
    await show(<Timeline id={7} told={told} />);
    const stops = () => bars().filter((bar) => bar.tabIndex === 0);
    expect(stops()).toEqual([bars()[2]]);
    bars()[2]?.focus();
    for (const [key, at] of [
      ["ArrowLeft", 1],
      ["Home", 0],
      ["ArrowLeft", 0],
      ["ArrowRight", 1],
      ["End", 2],
    ] as const) {
      await press(key, {}, document.activeElement ?? window);
      expect(document.activeElement).toBe(bars()[at]);
      expect(stops()).toEqual([bars()[at]]);
    }
    expect(byTestId("timeline-words").textContent).toContain("2 good");
  });

  it("isn't there before the first label", async () => {
    await show(<Timeline id={7} told={{ seconds: 1, started_at: null, ended_at: null, stretches: [] }} />);
    expect(document.querySelector('[data-testid="timeline"]')).toBeNull();
  });
});
