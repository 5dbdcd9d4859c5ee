// What is drawn over pictures can be told apart by everybody, and from any background.
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

type Triple = [number, number, number];
type Matrix = [Triple, Triple, Triple];

/** Full dichromacy in linear RGB (Machado, Oliveira and Fernandes 2009, table 1, severity 1). */
const VISION: Record<string, Matrix> = {
  usual: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

/** Of OKLab; 0.02 is just noticeable side by side. */
const CLEAR = 0.18;

const theme = readFileSync("src/theme.css", "utf-8");

function times(matrix: Matrix, [x, y, z]: Triple): Triple {
  return matrix.map(([a, b, c]) => a * x + b * y + c * z) as Triple;
}

function linear(name: string): Triple {
  const hex = new RegExp(`--${name}: #([0-9a-f]{6})`).exec(theme)?.[1] ?? "";
  return [0, 2, 4].map((at) => {
    const share = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as Triple;
}

function oklab(rgb: Triple): Triple {
  const bounded = rgb.map((each) => Math.min(1, Math.max(0, each))) as Triple;
  const cones = times(
    [
      [0.4122214708, 0.5363325363, 0.0514459929],
      [0.2119034982, 0.6806995451, 0.1073969566],
      [0.0883024619, 0.2817188376, 0.6299787005],
    ],
    bounded,
  ).map(Math.cbrt) as Triple;
  return times(
    [
      [0.2104542553, 0.793617785, -0.0040720468],
      [1.9779984951, -2.428592205, 0.4505937099],
      [0.0259040371, 0.7827717662, -0.808675766],
    ],
    cones,
  );
}

const apart = (one: Triple, other: Triple) => Math.hypot(...one.map((each, at) => each - (other[at] ?? 0)));

describe.each(Object.keys(VISION))("with %s", (vision) => {
  const seen = (name: string) => oklab(times(VISION[vision] as Matrix, linear(name)));
  const marks = ["overlay-dot", "overlay-bar", "overlay-ghost", "overlay-room"];
  const pairs = marks.flatMap((one, at) => marks.slice(at + 1).map((other) => [one, other] as const));

  it.each(pairs)("%s is told from %s", (one, other) => {
    expect(apart(seen(one), seen(other))).toBeGreaterThan(CLEAR);
  });
});

it("every mark has a light and a dark halo, one of which stands out from any grey", () => {
  const light = 1;
  const dark = 0.2; // the dark halo lets some of the picture through
  for (let grey = 0; grey <= 1; grey += 0.05)
    expect(Math.max(Math.abs(light - grey), Math.abs(grey - dark * grey))).toBeGreaterThan(0.4);
});
