// A trainer's pace: a rate over what was worked, a run without a pause, and a rest when it is due.
import { describe, expect, it } from "vitest";
import { clicked, FRESH, type Pace, perMinute, restDue } from "../src/pace";

const MINUTE = 60_000;
const clicks = (from: Pace, ...times: number[]) => times.reduce(clicked, from);

describe("pace", () => {
  it("is a rate once there are a few clicks", () => {
    expect(perMinute(clicks(FRESH, 0, 3000), 3000)).toBeNull();
    expect(perMinute(clicks(FRESH, 0, 3000, 6000, 9000), 9000)).toBeCloseTo(20);
  });

  it("forgets what is older than five minutes", () => {
    const pace = clicks(FRESH, ...Array.from({ length: 400 }, (_, index) => index * 2000));
    expect(pace.clicks.length).toBe(150);
    expect(perMinute(pace, 800_000)).toBeCloseTo(30, 0);
  });

  it("counts a run until there is a pause of a minute", () => {
    expect(clicks(FRESH, 0, 1000, 2000).streak).toBe(3);
    expect(clicks(FRESH, 0, 1000, 1000 + 2 * MINUTE).streak).toBe(1);
  });

  it("proposes a rest once for every so many minutes of judging", () => {
    const pace = clicks(FRESH, 0, MINUTE, 2 * MINUTE);
    expect(restDue(pace, 9 * MINUTE, 10)).toBe(false);
    expect(restDue(pace, 10 * MINUTE, 10)).toBe(true);
    expect(restDue(pace, 10 * MINUTE, 0)).toBe(false);
    expect(restDue({ ...pace, proposed: 10 * MINUTE }, 19 * MINUTE, 10)).toBe(false);
    expect(restDue({ ...pace, proposed: 10 * MINUTE }, 20 * MINUTE, 10)).toBe(true);
  });

  it("begins anew for someone who was away", () => {
    expect(clicked(clicks(FRESH, 0, MINUTE), 10 * MINUTE).since).toBe(10 * MINUTE);
  });
});
