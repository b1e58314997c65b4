/** Cutting a line by a region, checked against cutting each of its segments by itself. */
import { FillRule } from "clipper2-ts";
import fc from "fast-check";
import { expect, it } from "vitest";
import { LineBuilder, totalLength } from "../../../src/geometry/polyline.js";
import { SCALE, cleanRings, cutLine, regionOf, type Region } from "../../../src/geometry/region.js";
import { cases } from "../../support/full-run.js";

type Point = readonly [number, number];

const SIDE = 12;
const coordinate = fc.integer({ min: 0, max: SIDE });
/** Between the places of the lines, so that no line runs along a border, where both sides are right. */
const ring = fc.array(fc.tuple(coordinate, coordinate), { minLength: 3, maxLength: 7 }).map((points) =>
  points.map(([x, y]) => ({
    x: Math.round((x + 0.37) * SCALE),
    y: Math.round((y + 0.41) * SCALE),
  })),
);
/** Mostly along a horizontal, and often back over itself. */
const step = fc.oneof(
  { weight: 4, arbitrary: fc.record({ x: coordinate }) },
  { weight: 1, arbitrary: fc.record({ y: coordinate }) },
  { weight: 1, arbitrary: fc.record({ x: coordinate, y: coordinate }) },
);
const line = fc
  .tuple(fc.array(step, { minLength: 2, maxLength: 12 }), fc.boolean())
  .map(([steps, isClosed]): Point[] => {
    const points: Point[] = [[0, 0]];
    for (const { x, y } of steps as { x?: number; y?: number }[]) {
      const [lastX, lastY] = points[points.length - 1];
      points.push([x ?? lastX, y ?? lastY]);
    }
    return isClosed ? [...points, points[0]] : points;
  });

function cutLength(points: readonly Point[], region: Region, keepOutside: boolean): number {
  const whole = new LineBuilder();
  for (const [x, y] of points) whole.point(x, y);
  if (whole.openPoints < 2) return 0;
  whole.end(0);
  const parts = new LineBuilder();
  cutLine(whole.finish(), 0, region, keepOutside, parts);
  return totalLength(parts.finish());
}

it("cuts a line like its segments, also where it goes back over itself", () => {
  fc.assert(
    fc.property(
      fc.array(ring, { minLength: 1, maxLength: 3 }),
      line,
      fc.boolean(),
      (rings, points, outside) => {
        const region = regionOf(cleanRings(rings, FillRule.EvenOdd));
        let expected = 0;
        for (let k = 1; k < points.length; k++) {
          expected += cutLength(points.slice(k - 1, k + 1), region, outside);
        }
        // Each crossing is rounded to a Clipper unit.
        expect(Math.abs(cutLength(points, region, outside) - expected)).toBeLessThan(0.05);
      },
    ),
    { numRuns: cases(300) },
  );
});
