// Curves as lines: smoothed, aligned, told as a table and as an SVG; settings as their schema says.
import { describe, expect, it } from "vitest";
import {
  aligned,
  csvOf,
  drawn,
  isLogarithmic,
  type Picture,
  pictureOf,
  smoothed,
  ticks,
} from "../src/charting";
import { svgOf } from "../src/chartSvg";
import { differing } from "../src/comparing";
import { listingOf, sortedBy, withoutTag, withTag } from "../src/listing";
import { baseOf, differences, intervalOf, readAs, settingsOf } from "../src/schemaForm";

const picture: Picture = {
  ...pictureOf({
    name: "critic_loss",
    axis: "feedback",
    curves: [
      { name: "critic_loss", x: [1, 2, 4], y: [1, null, 3], low: null, high: null },
      { name: 'own "loss"', x: [2, 3], y: [5, 6], low: [4, 5], high: [6, 7] },
    ],
  }),
};

describe("smoothing", () => {
  it("begins at the first value and follows later ones", () => {
    expect(smoothed([2, 2, 2], 0.9).map((value) => Number(value?.toFixed(9)))).toEqual([2, 2, 2]);
    const line = smoothed([0, 1, 1], 0.5);
    expect(line[0]).toBe(0);
    expect(line[2]).toBeCloseTo(6 / 7);
  });

  it("leaves gaps and counts alone", () => {
    expect(smoothed([1, null, 1], 0.5)[1]).toBeNull();
    expect(drawn({ ...picture, smoothable: false }, 0.9)).toHaveLength(2);
    expect(drawn(picture, 0.9).filter((line) => line.behind)).toHaveLength(2);
  });
});

describe("a picture's numbers", () => {
  it("lie on one axis", () => {
    expect(aligned(picture.lines)).toEqual([
      [1, 2, 3, 4],
      [1, null, null, 3],
      [null, 5, 6, null],
      [null, 4, 5, null],
      [null, 6, 7, null],
    ]);
    expect(aligned([{ label: "a", color: 0, x: [0, 1], y: [1, 2] }], true)[0]).toEqual([1]);
  });

  it("are a table for spreadsheets", () => {
    const rows = csvOf(picture).split("\n");
    expect(rows[0]).toBe('feedback,critic,"own ""loss""","own ""loss"" −","own ""loss"" +"');
    expect(rows[2]).toBe("2,,5,4,6");
  });

  it("are drawn as a document that stands by itself", () => {
    const look = {
      ink: "#000",
      soft: "#555",
      grid: "#ddd",
      background: "#fff",
      font: "serif",
      colors: ["#00f", "#f00"],
    };
    const svg = svgOf(picture, picture.lines, null, look, String);
    const parsed = new DOMParser().parseFromString(svg, "image/svg+xml");
    expect(parsed.querySelector("parsererror")).toBeNull();
    expect(svg).toContain("own &quot;loss&quot;");
    expect(svg).not.toContain("NaN");
    expect(svg).not.toContain("var(");
  });

  it("have round ticks", () => {
    expect(ticks(0, 1, 5)).toEqual([0, 0.2, 0.4, 0.6, 0.8, 1]);
    expect(ticks(-3, 7, 5)).toEqual([-2, 0, 2, 4, 6]);
    expect(
      isLogarithmic([
        { label: "", color: 0, x: [10], y: [1] },
        { label: "", color: 0, x: [1000], y: [1] },
      ]),
    ).toBe(true);
  });
});

describe("settings", () => {
  const settings = settingsOf({
    properties: {
      rate: { type: "number", exclusiveMinimum: 0, maximum: 0.1, default: 0.003, description: "how fast" },
      size: { type: "integer", minimum: 1, default: 4 },
      height: { anyOf: [{ type: "number", minimum: -1, maximum: 1 }, { type: "null" }], default: null },
      kind: { enum: ["a", "b"], default: "a", type: "string" },
      layout: { type: "object" },
    },
  });
  const [rate, size, height, kind, layout] = settings as [never, never, never, never, never];

  it("know their kinds and bounds", () => {
    expect(settings.map((each) => each.kind)).toEqual(["number", "integer", "number", "choice", "json"]);
    expect([rate, size, height, kind].map(intervalOf)).toEqual(["(0, 0.1]", "[1, ∞)", "[−1, 1]", ""]);
  });

  it("are read as what they are, and left to the service where they are nothing", () => {
    expect(readAs(rate, " 0.01 ")).toBe(0.01);
    expect(readAs(rate, "fast")).toBe("fast");
    expect(readAs(height, "")).toBeNull();
    expect(readAs(layout, '{"x": [0, 1]}')).toEqual({ x: [0, 1] });
    expect(readAs(layout, "{")).toBe("{");
  });

  it("are sent only where they differ from the preset", () => {
    const base = baseOf(settings, { size: 8 });
    expect(base).toEqual({ rate: 0.003, size: 8, height: null, kind: "a", layout: {} });
    expect(differences({ rate: 0.003, size: 4, layout: {} }, base)).toEqual({ size: 4 });
    expect(
      differing([
        { a: 1, b: 2 },
        { a: 1, b: 3 },
      ]),
    ).toEqual(["b"]);
  });
});

describe("the list's address", () => {
  it("keeps what it knows", () => {
    expect(listingOf("?text=a&sort=beauty&order=up&from=3&tag=x&tag=y").toString()).toBe(
      "text=a&tag=x&tag=y",
    );
  });

  it("turns an order round when it is asked for again", () => {
    const once = sortedBy(new URLSearchParams(), "feedback");
    expect(once.toString()).toBe("sort=feedback&order=desc");
    expect(sortedBy(once, "feedback").get("order")).toBe("asc");
    expect(sortedBy(once, "name").get("order")).toBe("asc");
  });

  it("takes tags on and off", () => {
    const two = withTag(withTag(withTag(new URLSearchParams(), "a"), "b"), "a");
    expect(two.getAll("tag")).toEqual(["a", "b"]);
    expect(withoutTag(two, "a").getAll("tag")).toEqual(["b"]);
  });
});
