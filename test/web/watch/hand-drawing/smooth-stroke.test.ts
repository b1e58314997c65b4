import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { SmoothStroke } from "../../../../web/watch/hand-drawing/smooth-stroke.js";
import { cases } from "../../../support/runs/full-run.js";

type Sample = readonly [x: number, y: number, atMs: number];
type Line = (readonly [x: number, y: number])[];

const smoothed = (samples: readonly Sample[], level: number, pxPerMm = 3): Line => {
  const out: Line = [];
  const stroke = new SmoothStroke(level, pxPerMm, (x, y) => out.push([x, y]));
  for (const sample of samples) stroke.add(...sample);
  stroke.finish();
  return out;
};

/** A hand that moves to the right at 60 mm/s and trembles by 0.3 mm, ten times a second; 125 samples a second. */
const trembling = Array.from({ length: 125 }, (_, k): Sample => [
  20 + 0.48 * k,
  50 + 0.3 * Math.sin(0.5 * k),
  8 * k,
]);

/** How far the line is from y = 50, without its ends, which are where the pointer was. */
const roughness = (line: Line): number => {
  const late = line.filter(([x]) => x > 40 && x < 70);
  return Math.sqrt(late.reduce((sum, [, y]) => sum + (y - 50) ** 2, 0) / late.length);
};

/** The largest turn between neighbouring pieces, degrees. */
const sharpestTurnDeg = (line: Line): number => {
  const directions = line.slice(1).map(([x, y], k) => Math.atan2(y - line[k][1], x - line[k][0]));
  const turns = directions.slice(1).map((angle, k) => {
    const turn = Math.abs(angle - directions[k]);
    return Math.min(turn, 2 * Math.PI - turn);
  });
  return (Math.max(0, ...turns) * 180) / Math.PI;
};

const samples = fc
  .array(
    fc.tuple(
      fc.double({ min: 0, max: 300, noNaN: true }),
      fc.double({ min: 0, max: 200, noNaN: true }),
      fc.integer({ min: 0, max: 40 }),
    ),
    { minLength: 1, maxLength: 60 },
  )
  .map((steps) => {
    let atMs = 0;
    return steps.map(([x, y, ms]): Sample => [x, y, (atMs += ms)]);
  });
const levels = fc.double({ min: 0, max: 1, noNaN: true });

describe("a smoothed stroke", () => {
  it("begins and ends where the pointer did, and stays within the box of its points", () => {
    fc.assert(
      fc.property(samples, levels, (input, level) => {
        const line = smoothed(input, level);
        const xs = input.map(([x]) => x);
        const ys = input.map(([, y]) => y);
        expect(line[0]).toEqual(input[0].slice(0, 2));
        const [endX, endY] = line[line.length - 1];
        expect(Math.hypot(endX - xs[xs.length - 1], endY - ys[ys.length - 1])).toBeLessThan(1e-9);
        for (const [x, y] of line) {
          expect(x).toBeGreaterThan(Math.min(...xs) - 1e-9);
          expect(x).toBeLessThan(Math.max(...xs) + 1e-9);
          expect(y).toBeGreaterThan(Math.min(...ys) - 1e-9);
          expect(y).toBeLessThan(Math.max(...ys) + 1e-9);
        }
      }),
      { numRuns: cases() },
    );
  });

  it("never changes what it has put out: the first points alone give the beginning of the whole", () => {
    fc.assert(
      fc.property(samples, levels, fc.nat(60), (input, level, count) => {
        const out: Line = [];
        const stroke = new SmoothStroke(level, 3, (x, y) => out.push([x, y]));
        for (const sample of input.slice(0, count + 1)) stroke.add(...sample);
        const first = [...out];
        expect(smoothed(input, level).slice(0, first.length)).toEqual(first);
      }),
      { numRuns: cases() },
    );
  });

  it("is the input itself without smoothing", () => {
    expect(smoothed(trembling, 0)).toEqual(trembling.map(([x, y]) => [x, y]));
  });

  it("trembles less, the more it is smoothed", () => {
    const [none, some, much, most] = [0, 0.3, 0.6, 1].map((level) => roughness(smoothed(trembling, level)));
    expect(none).toBeCloseTo(0.3 / Math.SQRT2, 1);
    expect(some).toBeLessThan(0.75 * none);
    expect(much).toBeLessThan(0.75 * some);
    expect(most).toBeLessThan(0.75 * much);
  });

  it("stays straight on a straight line, at any speed of the pointer", () => {
    const line = smoothed(
      Array.from({ length: 50 }, (_, k): Sample => [k * k * 0.05, k * k * 0.1, 10 * k]),
      0.7,
    );
    for (const [x, y] of line) expect(Math.abs(y - 2 * x)).toBeLessThan(1e-9);
  });

  it("is a curve where few points come from a fast finger, not a polygon", () => {
    // 24 points around a circle of 40 mm: the polygon turns by 15° at each of them.
    const circle = Array.from({ length: 49 }, (_, k): Sample => {
      const angle = (k * Math.PI) / 12;
      return [100 + 40 * Math.cos(angle), 100 + 40 * Math.sin(angle), 16 * k];
    });
    expect(sharpestTurnDeg(smoothed(circle, 0).slice(4, -4))).toBeCloseTo(15, 6);
    expect(sharpestTurnDeg(smoothed(circle, 0.4).slice(4, -4))).toBeLessThan(6);
  });

  it("is a single point for a tap", () => {
    expect(smoothed([[10, 20, 0]], 0)).toEqual([[10, 20]]);
    for (const [x, y] of smoothed([[10, 20, 0]], 0.5)) expect([x, y]).toEqual([10, 20]);
  });
});
