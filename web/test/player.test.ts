// A motion played again shows, of each camera, what it showed at that time.
import { describe, expect, it } from "vitest";
import { reelOf, shotAt } from "../src/player";
import { Recording } from "../src/recording";

const shot = (camera: string, at: number) => ({
  camera,
  at,
  width: 640,
  height: 480,
  source: `${camera}${at}`,
});

describe("player", () => {
  const reel = reelOf([shot("right", 100.1), shot("left", 100), shot("left", 100.5), shot("right", 101)]);

  it("puts the cameras side by side on one clock", () => {
    expect(reel.length).toBeCloseTo(1);
    expect(reel.tracks.map(({ camera }) => camera)).toEqual(["left", "right"]);
    const [left, right] = reel.tracks;
    const seen = (time: number) => [left && shotAt(left, time), right && shotAt(right, time)];
    expect(seen(0)).toEqual(["left100", "right100.1"]);
    expect(seen(0.5)).toEqual(["left100.5", "right100.1"]);
    expect(seen(9)).toEqual(["left100.5", "right101"]);
  });

  it("has nothing to show of nothing", () => {
    expect(reelOf([])).toEqual({ length: 0, tracks: [] });
  });
});

describe("recording", () => {
  const frame = (robot: number, execution_id: number, taken_at: number) => ({
    header: { robot, camera: "left", width: 640, height: 480, taken_at, execution_id, telemetry: null },
    jpeg: new Blob(["x"]),
  });

  it("keeps each robot's newest motion only, and no more of it than fits", () => {
    const recording = new Recording();
    for (let at = 0; at < 2000; at += 1) recording.keep(frame(0, 1, at));
    recording.keep(frame(1, 2, 0));
    expect(recording.of(0, 1).length).toBe(900);
    expect(recording.of(0, 1)[0]?.at).toBe(1100);
    expect(recording.of(1, 2).length).toBe(1);
    recording.keep(frame(0, 3, 0));
    expect(recording.of(0, 1)).toEqual([]);
  });
});
