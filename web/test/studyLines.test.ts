// What a study's chart draws: whose line is where, and how different lengths share one axis.
import { describe, expect, it } from "vitest";
import { chartData, isLogarithmic, linesOf, notesOf } from "../src/studyLines";
import type { StudyScenario } from "../src/wire";

function scenario(end: number): StudyScenario {
  return {
    name: "reaching",
    title: "Reaching",
    axis: "low_level_steps",
    measure: "success_rate",
    caption: "",
    curves: [
      { algorithm: "seed", title: "SEED", seeds: 2, planned: 2, x: [0, end], mean: [0, 0.5], sem: [0, 0.1] },
      {
        algorithm: "sac",
        title: "SAC",
        seeds: 1,
        planned: 3,
        x: [0, end / 2],
        mean: [0, 0],
        sem: [null, null],
      },
    ],
    paper: [
      { algorithm: "seed", title: "SEED", trial: 1, x: [100], y: [0.9] },
      { algorithm: "seed", title: "SEED", trial: 2, x: [100], y: [0.8] },
    ],
  };
}

describe("a study's lines", () => {
  it("names each once, the paper's behind ours and in the same colour", () => {
    const lines = linesOf(scenario(100));
    expect(lines.map((line) => line.label)).toEqual([
      "SEED, paper",
      null,
      null,
      null,
      "SEED (2 seeds)",
      "SAC (1 of 3 seeds)",
    ]);
    expect(lines[0]?.color).toBe(lines[4]?.color);
    expect(lines[2]?.y).toEqual([0, 0.6]);
    expect(lines[3]?.y).toEqual([0, 0.4]);
  });

  it("share the union of their points, with nothing where they have none", () => {
    const [x, first, , , , ours, sac] = chartData(linesOf(scenario(100)));
    expect(x).toEqual([0, 50, 100]);
    expect(first).toEqual([null, null, 0.9]);
    expect(ours).toEqual([0, null, 0.5]);
    expect(sac).toEqual([0, 0, null]);
  });

  it("take a logarithmic axis, which has no 0, where one is far longer than another", () => {
    expect(isLogarithmic(linesOf(scenario(100)))).toBe(false);
    const lines = linesOf(scenario(4));
    expect(isLogarithmic(lines)).toBe(true);
    expect(chartData(lines)[0]).toEqual([2, 4, 100]);
  });

  it("say what the axis and the lines hide", () => {
    expect(notesOf(scenario(100))).toEqual([]);
    const told = scenario(4);
    told.curves[1] = { algorithm: "sac", title: "SAC", seeds: 1, planned: 3, x: [0], mean: [0], sem: [null] };
    told.paper.push({ algorithm: "tamer", title: "TAMER", trial: null, x: [100], y: [0.9] });
    expect(notesOf(told)).toEqual([
      expect.stringContaining("no 0"),
      expect.stringMatching(/Only at 0.*SAC \(1 of 3 seeds\)/),
      "One line in the paper: SEED, TAMER.",
    ]);
  });
});
