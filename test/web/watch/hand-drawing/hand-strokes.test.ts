import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { Line } from "../../../../src/index.js";
import { HandStrokes } from "../../../../web/watch/hand-drawing/hand-strokes.js";
import { inkUntil } from "../../../../web/watch/hand-drawing/picture.js";
import { cases } from "../../../support/runs/full-run.js";

const strokesFrom = (...lines: Line[]): HandStrokes => {
  const strokes = new HandStrokes();
  for (const line of lines) {
    for (const [x, y] of line) strokes.lineTo(x, y);
    strokes.penUp();
  }
  return strokes;
};

const LINE: Line = [
  [0, 0],
  [30, 0],
  [30, 40],
];

const mm = fc.double({ min: -300, max: 300, noNaN: true });
const lines = fc.array(fc.tuple(mm, mm), { minLength: 2, maxLength: 20 });
const shares = fc.double({ min: 0, max: 1, noNaN: true });

describe("the strokes of a drawing by hand", () => {
  it("leave out a point that repeats the one before, as the plotter does", () => {
    const strokes = new HandStrokes();
    expect([strokes.lineTo(1, 1), strokes.lineTo(1, 1), strokes.lineTo(2, 1)]).toEqual([true, false, true]);
    expect(strokes.pointsOf(0)).toEqual([
      [1, 1],
      [2, 1],
    ]);
  });

  it("have a point at each place, and at each length up to the end", () => {
    const strokes = strokesFrom(LINE);
    expect(strokes.lengthOf(0)).toBe(70);
    for (const [alongMm, at] of [
      [0, [0, 0]],
      [15, [15, 0]],
      [30, [30, 0]],
      [50, [30, 20]],
      [70, [30, 40]],
      [Infinity, [30, 40]],
    ] as const)
      expect(strokes.pointAt({ stroke: 0, alongMm })).toEqual(at);
  });

  it("give back the place of any of their points, seen from a little before it", () => {
    fc.assert(
      fc.property(lines, shares, (line, share) => {
        const strokes = strokesFrom(line);
        fc.pre(strokes.lengthOf(0) > 0);
        const alongMm = share * strokes.lengthOf(0);
        const from = { stroke: 0, alongMm: Math.max(0, alongMm - 1) };
        const at = strokes.pointAt({ stroke: 0, alongMm });
        const found = strokes.nearest(from, at, 20, 0.4);
        // It may pass the point once more within the 20 mm.
        const [x, y] = strokes.pointAt(found!);
        expect(Math.hypot(x - at[0], y - at[1])).toBeLessThan(1e-6);
        expect(found!.alongMm).toBeGreaterThanOrEqual(from.alongMm - 1e-9);
      }),
      { numRuns: cases() },
    );
  });

  it("are taken back as far as the plotter says", () => {
    const strokes = strokesFrom(LINE, LINE);
    strokes.takeBack(2);
    expect(strokes.lengthOf(1)).toBe(30);
    strokes.takeBack(0);
    expect(strokes.count).toBe(1);
    expect([...strokes.drawing.xy]).toEqual(LINE.flat());
    strokes.takeBack(0);
    strokes.takeBack(0);
    expect(strokes.count).toBe(0);
  });
});

describe("the ink of a drawing by hand", () => {
  const pen = { xMm: 30, yMm: 5, penDown: true, planS: 0, isMoving: true };
  const reported = { stroke: 0, alongMm: 25 };

  it("reaches to the pen, ahead of the last report", () => {
    expect(inkUntil(strokesFrom(LINE), reported, pen)).toEqual({ stroke: 0, alongMm: 35 });
  });

  it.each([
    ["there is no pen", null],
    ["the pen is up", { ...pen, penDown: false }],
    ["the pen is beside the line", { ...pen, xMm: 33 }],
    ["the pen is behind", { ...pen, xMm: 10, yMm: 0 }],
  ])("is as reported when %s", (_when, shown) => {
    expect(inkUntil(strokesFrom(LINE), reported, shown)).toEqual(reported);
    expect(inkUntil(strokesFrom(LINE), { stroke: 1, alongMm: 0 }, shown)).toEqual({ stroke: 1, alongMm: 0 });
  });
});
