/** Hatch patterns as lines, and their elliptical borders. On the page y points down from 100. */
import { describe, expect, it } from "vitest";
import { drawDxf } from "../../../support/import/dxf.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

interface Line {
  readonly angle: number;
  readonly base?: readonly [number, number];
  readonly offset: readonly [number, number];
  readonly dashes?: readonly number[];
}
const lineOf = ({ angle, base = [0, 0], offset, dashes = [] }: Line): string =>
  [
    `53 ${angle}\n43 ${base[0]}\n44 ${base[1]}\n45 ${offset[0]}\n46 ${offset[1]}\n79 ${dashes.length}`,
    ...dashes.map((dash) => `49 ${dash}`),
  ].join("\n");

const hatch = (paths: string, lines: readonly Line[], style = 0): string =>
  `0 HATCH\n8 0\n62 3\n10 0\n20 0\n30 0\n2 ANSI31\n70 0\n71 0\n${paths}\n75 ${style}\n76 1\n52 0\n41 1\n77 0\n` +
  `${[`78 ${lines.length}`, ...lines.map(lineOf)].join("\n")}\n47 0.1\n98 1\n10 5\n20 5`;
const square = (from: number, to: number, flags = 0): string =>
  `92 ${2 | flags}\n72 0\n73 1\n93 4\n${[from, from, to, from, to, to, from, to].map((v, i) => `${10 + 10 * (i % 2)} ${v}`).join("\n")}\n97 0`;
const circle = "92 1\n93 1\n72 2\n10 50\n20 50\n40 30\n50 0\n51 360\n73 1\n97 0";

/** The lines of the hatch as "x y x y". */
const linesOf = async (paths: string, lines: readonly Line[], style = 0): Promise<string[]> =>
  shapesOf(await drawDxf(hatch(paths, lines, style)))[1]
    .split("M")
    .slice(1)
    .map((line) => line.replace("L", " "));
const numbers = (lines: readonly string[]): number[][] => lines.map((line) => line.split(" ").map(Number));

const LEVEL: Line = { angle: 0, base: [0, 5], offset: [0, 10] };

describe("the pattern of a HATCH", () => {
  it("is drawn as lines in the hatch's colour, without a fill, and needs no warning", async () => {
    const drawing = await drawDxf(hatch(`91 1\n${square(10, 50)}`, [LEVEL]));
    expect(shapesOf(drawing)[1]).toBe("M10 85L50 85M10 75L50 75M10 65L50 65M10 55L50 55");
    expect(drawing.colors[drawing.paths.stroke[1]]).toBe("#00ff00");
    expect(drawing.paths.fill[1]).toBe(-1);
    expect(codes(drawing)).toEqual([]);
  });

  it("leaves out islands, and what its style excludes", async () => {
    const paths = `91 3\n${square(10, 60, 1)}\n${square(20, 50, 16)}\n${square(30, 40)}`;
    const at35 = async (style: number): Promise<string[]> =>
      (await linesOf(paths, [LEVEL], style)).filter((line) => line.includes(" 65 "));
    expect(await at35(0)).toEqual(["10 65 20 65", "30 65 40 65", "50 65 60 65"]);
    expect(await at35(1)).toEqual(["10 65 20 65", "50 65 60 65"]);
    expect(await at35(2)).toEqual(["10 65 60 65"]);
  });

  it("has dashes that begin at each line's own point, and dots", async () => {
    // The line at 15 is the first from the base: its dashes begin at 3.
    const dashed: Line = { ...LEVEL, offset: [3, 10], dashes: [4, -2] };
    const first = (await linesOf(`91 1\n${square(10, 50)}`, [dashed])).filter((line) => line.endsWith(" 85"));
    expect(first).toEqual([
      "10 85 13 85",
      "15 85 19 85",
      "21 85 25 85",
      "27 85 31 85",
      "33 85 37 85",
      "39 85 43 85",
      "45 85 49 85",
    ]);
    const dotted: Line = { angle: 0, base: [0, 25], offset: [0, 40], dashes: [0, -15, 5, -5] };
    expect(await linesOf(`91 1\n${square(10, 50)}`, [dotted])).toEqual([
      "15 75 20 75",
      "25 75 25 75",
      "40 75 45 75",
    ]);
  });

  it("runs at its angle: each line of the computed length, one spacing from the next", async () => {
    // 45°, 4 apart, through the circle's middle.
    const step = 4 / Math.SQRT2;
    const lines = numbers(
      await linesOf(`91 1\n${circle}`, [{ angle: 45, base: [50, 50], offset: [-step, step] }]),
    );
    expect(lines).toHaveLength(15);
    lines.forEach(([x0, y0, x1, y1], i) => {
      const away = 4 * (i - 7);
      // x + y of the page is x − y of the file, and 100 more.
      expect((100 - y0 - x0) / Math.SQRT2, `line ${i}`).toBeCloseTo(away, 3);
      expect(y1 - y0, `line ${i}`).toBeCloseTo(x0 - x1, 3);
      expect(Math.hypot(x1 - x0, y1 - y0), `line ${i}`).toBeCloseTo(2 * Math.sqrt(900 - away * away), 2);
    });
  });

  it("crosses if it has two families of lines", async () => {
    const upright: Line = { angle: 90, base: [5, 0], offset: [-10, 0] };
    expect(await linesOf(`91 1\n${square(10, 30)}`, [LEVEL, upright])).toEqual([
      "10 85 30 85",
      "10 75 30 75",
      "25 90 25 70",
      "15 90 15 70",
    ]);
  });

  it.each([
    ["has no lines", []],
    ["has overlapping lines", [{ angle: 0, offset: [1, 0] }]],
    ["has more lines than a pen could draw", [{ angle: 0, offset: [0, 1e-6] }]],
    ["has more dashes than a pen could draw", [{ ...LEVEL, dashes: [1e-6, -1e-6] }]],
  ] as [string, Line[]][])("is taken as a filled shape, with a warning, if it %s", async (_what, lines) => {
    const drawing = await drawDxf(hatch(`91 1\n${square(10, 50)}`, lines));
    expect(shapesOf(drawing)[1]).toBe("M10 90L50 90L50 50L10 50Z");
    expect(drawing.paths.stroke[1]).toBe(-1);
    expect(codes(drawing)).toEqual(["gradient-fill"]);
  });
});

/**
 * Of the ellipse about 50, 50 with half axes 40 (turned by the tilt) and 20: its intersection with the ray at
 * an angle from the long axis, by the polar equation r = ab / √((b cos)² + (a sin)²).
 */
function onRay(deg: number, tiltDeg: number): [number, number] {
  const [angle, tilt] = [(deg * Math.PI) / 180, (tiltDeg * Math.PI) / 180];
  const r = 800 / Math.hypot(20 * Math.cos(angle), 40 * Math.sin(angle));
  return [50 + r * Math.cos(angle + tilt), 50 - r * Math.sin(angle + tilt)];
}

describe("an elliptical edge of a HATCH", () => {
  it.each([
    ["a quarter", 0, 0, 90],
    ["angles that are no multiples", 0, 30, 200],
    ["a tilted axis", 30, 20, 110],
    ["through the axis's end", 0, 300, 400],
    ["a tilt beyond a half turn", 215, 45, 170],
  ])(
    "goes anticlockwise between its angles, and clockwise between their mirrored ones: %s",
    async (_what, tilt, from, to) => {
      const axis = [40 * Math.cos((tilt * Math.PI) / 180), 40 * Math.sin((tilt * Math.PI) / 180)];
      const [start, middle, end] = [from, (from + to) / 2, to].map((deg) => onRay(deg, tilt)) as [
        [number, number],
        [number, number],
        [number, number],
      ];
      const chord = `72 1\n10 ${end[0]}\n20 ${100 - end[1]}\n11 ${start[0]}\n21 ${100 - start[1]}`;
      for (const [first, last, ccw] of [
        [from, to, 1],
        [360 - to, 360 - from, 0],
      ]) {
        const edge = `72 3\n10 50\n20 50\n11 ${axis[0]}\n21 ${axis[1]}\n40 0.5\n50 ${first}\n51 ${last}\n73 ${ccw}`;
        const solid = hatch(`91 1\n92 1\n93 2\n${edge}\n${chord}\n97 0`, []).replace("70 0", "70 1");
        const points = pointsOf(await drawDxf(solid), 1);
        const gapTo = ([x, y]: [number, number]): number =>
          Math.min(...points.map(([px, py]) => Math.hypot(px - x, py - y)));
        expect(Math.hypot(points[0][0] - start[0], points[0][1] - start[1])).toBeLessThan(1e-3);
        expect(gapTo(end)).toBeLessThan(1e-3);
        // On the given arc, not on the rest of the ellipse: it contains the arc's midpoint, and not the
        // other's.
        expect(gapTo(middle)).toBeLessThan(0.2);
        expect(gapTo(onRay((from + to) / 2 + 180, tilt))).toBeGreaterThan(5);
      }
    },
  );
});
