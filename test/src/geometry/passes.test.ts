import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { likeliestPass, passesOf, type Pass } from "../../../src/geometry/passes.js";

const summary = (passes: readonly Pass[]) => passes.map(({ at, until, awayMm }) => [at, until, awayMm]);

describe("the passes of a line at a point", () => {
  it.each([
    ["a straight line", [0, 0, 10, 0], [4, 3], [[0.4, 0.4, 3]]],
    ["a line that begins there", [0, 0, 10, 0], [-3, 4], [[0, 0, 5]]],
    ["a line that ends there", [0, 0, 10, 0], [13, 4], [[1, 1, 5]]],
    ["a dot", [1, 1], [4, 5], [[0, 0, 5]]],
    ["a corner that points at it", [0, 0, 10, 10, 20, 0], [10, 12], [[1, 1, 2]]],
    [
      "out and back",
      [0, 0, 10, 0, 0, 0],
      [7, 2],
      [
        [0.7, 0.7, 2],
        [1.3, 1.3, 2],
      ],
    ],
    [
      "the two sides of a corner",
      [0, 0, 10, 0, 10, 10],
      [7, 3],
      [
        [0.7, 0.7, 3],
        [1.3, 1.3, 3],
      ],
    ],
    ["a rest on the way", [0, 0, 5, 0, 5, 0, 5, 0, 9, 4], [5, 0], [[1, 3, 0]]],
    ["a rest at the beginning", [0, 0, 0, 0, 5, 0], [-1, 0], [[0, 1, 1]]],
    ["a rest at the end", [0, 0, 5, 0, 5, 0], [6, 0], [[1, 2, 1]]],
    ["a rest elsewhere", [0, 0, 5, 0, 5, 0, 10, 0], [8, 1], [[2.6, 2.6, 1]]],
  ] as const)("are its nearest points: %s", (_, xy, [x, y], expected) => {
    const found = summary(passesOf(xy, x, y));
    expect(found).toHaveLength(expected.length);
    found.flat().forEach((value, i) => expect(value).toBeCloseTo(expected.flat()[i], 9));
  });

  it("contain the nearest point of the whole line, and tell the length before each", () => {
    const coordinate = fc.integer({ min: 0, max: 20 });
    const point = fc.tuple(coordinate, coordinate);
    fc.assert(
      fc.property(fc.array(point, { minLength: 1, maxLength: 8 }), point, (points, [x, y]) => {
        const xy = points.flat();
        const passes = passesOf(xy, x, y);
        let sampledMm = Infinity;
        for (let at = 0; at <= points.length - 1; at += 1 / 64) {
          const [px, py] = pointAt(points, at);
          sampledMm = Math.min(sampledMm, Math.hypot(px - x, py - y));
        }
        const nearestMm = Math.min(...passes.map(({ awayMm }) => awayMm));
        expect(nearestMm).toBeLessThan(sampledMm + 1e-9);
        expect(nearestMm).toBeGreaterThan(sampledMm - 0.5);
        for (const { at, until, alongMm, awayMm } of passes) {
          for (const end of [at, until]) {
            const [px, py] = pointAt(points, end);
            expect(Math.hypot(px - x, py - y)).toBeCloseTo(awayMm, 9);
            expect(alongMm).toBeCloseTo(lengthBefore(points, end), 9);
          }
        }
      }),
    );
  });
});

type Point = readonly [number, number];

function pointAt(points: readonly Point[], at: number): Point {
  const from = points[Math.floor(at)];
  const to = points[Math.min(Math.floor(at) + 1, points.length - 1)];
  const share = at % 1;
  return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
}

function lengthBefore(points: readonly Point[], at: number): number {
  let mm = 0;
  for (let i = 0; i < at; i++) {
    const [from, to] = [points[i], pointAt(points, Math.min(i + 1, at))];
    mm += Math.hypot(to[0] - from[0], to[1] - from[1]);
  }
  return mm;
}

describe("the likeliest pass", () => {
  const passes = [
    { at: 1, awayMm: 0.01 },
    { at: 2, awayMm: 0 },
    { at: 9, awayMm: 0.05 },
  ];

  it("is the expected one of those that are as near as the nearest", () => {
    expect(likeliestPass(passes, ({ at }) => Math.abs(at - 0))?.at).toBe(1);
    expect(likeliestPass(passes, ({ at }) => Math.abs(at - 9))?.at).toBe(2);
  });

  it("is null without passes", () => {
    expect(likeliestPass([], () => 0)).toBeNull();
  });
});
