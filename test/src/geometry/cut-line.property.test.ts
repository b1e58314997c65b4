/** Cutting a line by a region, checked against cutting each of its segments by itself, and point by point. */
import { FillRule } from "clipper2-ts/dist/Core.js";
import fc from "fast-check";
import { expect, it } from "vitest";
import { LineBuilder, lineCount, totalLength, type Lines } from "../../../src/geometry/polyline.js";
import { clipLinesToBox, cutLine } from "../../../src/geometry/cut-line.js";
import { SCALE, cleanRings, regionOf, type Region } from "../../../src/geometry/region.js";
import { cases } from "../../support/runs/full-run.js";
import {
  distanceToRings,
  distanceToSegment,
  isInside,
  type Ring,
} from "../../support/drawings/shapes-by-sampling.js";
import { boxContains, boxOfPoints, type Box } from "../../../src/geometry/box.js";

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

function cut(points: readonly Point[], region: Region, keepOutside: boolean): Lines {
  const whole = new LineBuilder();
  for (const [x, y] of points) whole.point(x, y);
  whole.end(0);
  const parts = new LineBuilder();
  cutLine(whole.finish(), 0, 0, region, keepOutside, parts);
  return parts.finish();
}

function cutLength(points: readonly Point[], region: Region, keepOutside: boolean): number {
  const isDot = points.every(([x, y]) => x === points[0][0] && y === points[0][1]);
  return isDot ? 0 : totalLength(cut(points, region, keepOutside));
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

/** Rings with corners on the line's own places: most lines touch corners and run along edges. */
const ringOnGrid = fc.array(fc.tuple(coordinate, coordinate), { minLength: 3, maxLength: 9 });

function distanceToLines({ xy, offsets }: Lines, x: number, y: number): number {
  let nearest = Infinity;
  for (let i = 0; i + 1 < offsets.length; i++) {
    for (let p = offsets[i]; p + 1 < offsets[i + 1]; p++) {
      const [x0, y0, x1, y1] = xy.subarray(2 * p, 2 * p + 4);
      nearest = Math.min(nearest, distanceToSegment([x, y], [x0, y0], [x1, y1]));
    }
  }
  return nearest;
}

it("keeps what is inside, or outside, and what runs along an edge, also where a line meets corners", () => {
  fc.assert(
    fc.property(
      fc.array(ringOnGrid, { minLength: 1, maxLength: 4 }),
      line,
      fc.boolean(),
      fc.double({ min: 0.05, max: 0.95, noNaN: true }),
      (rings, points, outside, t) => {
        const scaled = rings.map((ring) => ring.map(([x, y]) => ({ x: x * SCALE, y: y * SCALE })));
        const clean = cleanRings(scaled, FillRule.EvenOdd);
        const inMm: Ring[] = clean.map((ring) => ring.map(({ x, y }) => [x / SCALE, y / SCALE]));
        fc.pre(new Set(points.map(String)).size > 1);
        const kept = cut(points, regionOf(clean), outside);
        for (let k = 1; k < points.length; k++) {
          const [[x0, y0], [x1, y1]] = [points[k - 1], points[k]];
          const [x, y] = [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
          const isFar = distanceToRings(inMm, x, y) > 0.01;
          const length = Math.hypot(x1 - x0, y1 - y0);
          if (length === 0) continue;
          const isOnEdge = [-0.02, 0.02].every((by) => {
            const share = by / length;
            return distanceToRings(inMm, x + share * (x1 - x0), y + share * (y1 - y0)) < 1e-4;
          });
          const isKept = isFar ? isInside(inMm, false, x, y) !== outside : isOnEdge ? true : null;
          if (isKept === true) expect(distanceToLines(kept, x, y)).toBeLessThan(1e-3);
          // Another part of the line may pass here, and is not asked about.
          const passes = points.slice(1).filter((p, n) => distanceToSegment([x, y], points[n], p) < 1e-3);
          if (isKept === false && passes.length === 1)
            expect(distanceToLines(kept, x, y)).toBeGreaterThan(5e-3);
        }
      },
    ),
    { numRuns: cases(1_000) },
  );
});

it("cuts many lines by a region with many edges, each at the edges near it", () => {
  const teeth = 20_000;
  const comb = Array.from({ length: teeth }, (_, k) => [
    { x: 10 * k * 10, y: 0 },
    { x: (10 * k + 5) * 10, y: 0 },
    { x: (10 * k + 5) * 10, y: 10 * SCALE },
    { x: 10 * k * 10, y: 10 * SCALE },
  ]);
  const region = regionOf(comb);
  const across = Array.from({ length: teeth }, (_, k): Point[] => [
    [(k * 10 * 10) / SCALE, 5],
    [(k * 10 * 10) / SCALE + 0.1, 5],
  ]);
  // Each line crosses ten teeth of 5 µm, one apart. What is on an edge counts too, by less than 0.3 µm.
  for (const points of across.slice(0, teeth - 10)) {
    const parts = cut(points, region, false);
    expect(lineCount(parts)).toBe(10);
    expect(totalLength(parts)).toBeCloseTo(0.05, 6);
  }
});

it("keeps a line on the edge of its own region whole, in one piece, whichever side is kept", () => {
  fc.assert(
    fc.property(
      fc.double({ min: 5, max: 80, noNaN: true }),
      fc.double({ min: 0, max: 7, noNaN: true }),
      fc.integer({ min: 5, max: 300 }),
      fc.constantFrom(1, 2),
      fc.integer({ min: 0, max: 299 }),
      fc.boolean(),
      fc.boolean(),
      (radius, turn, count, step, start, isReversed, outside) => {
        // A star if step is 2: its line crosses itself.
        fc.pre(step === 1 || count % 2 === 1);
        const corner = (k: number): Point => {
          const angle = turn + (k * step * 2 * Math.PI) / count;
          return [100 + radius * Math.cos(angle), 100 + 0.6 * radius * Math.sin(angle)];
        };
        const corners = Array.from({ length: count }, (_, k) => corner(k));
        const rings = [corners.map(([x, y]) => ({ x: Math.round(x * SCALE), y: Math.round(y * SCALE) }))];
        const region = regionOf(cleanRings(rings, FillRule.EvenOdd));
        const begun = [...corners.slice(start % count), ...corners.slice(0, start % count)];
        const points = [...begun, begun[0]];
        if (isReversed) points.reverse();
        const kept = cut(points, region, outside);
        expect(lineCount(kept)).toBe(1);
        const whole = points
          .slice(1)
          .reduce((sum, p, k) => sum + Math.hypot(p[0] - points[k][0], p[1] - points[k][1]), 0);
        expect(totalLength(kept)).toBeCloseTo(whole, 4);
      },
    ),
    { numRuns: cases(500) },
  );
});

/** The length of a line's part in a box: each segment is divided where it crosses the sides. */
function lengthInBox(points: readonly Point[], box: Box): number {
  let total = 0;
  for (let k = 1; k < points.length; k++) {
    const [[x0, y0], [x1, y1]] = [points[k - 1], points[k]];
    const crossings = [(box.x0 - x0) / (x1 - x0), (box.x1 - x0) / (x1 - x0), (box.y0 - y0) / (y1 - y0)];
    const shares = [0, 1, ...crossings, (box.y1 - y0) / (y1 - y0)].filter((t) => t >= 0 && t <= 1);
    shares.sort((s, t) => s - t);
    for (let i = 1; i < shares.length; i++) {
      const middle = (shares[i - 1] + shares[i]) / 2;
      const [x, y] = [x0 + middle * (x1 - x0), y0 + middle * (y1 - y0)];
      const isInBox = x >= box.x0 && x <= box.x1 && y >= box.y0 && y <= box.y1;
      if (isInBox) total += (shares[i] - shares[i - 1]) * Math.hypot(x1 - x0, y1 - y0);
    }
  }
  return total;
}

it("cuts lines at a box so that exactly their parts inside are left, and no point is outside", () => {
  const place = fc.integer({ min: -500, max: 500 }).map((n) => n / 7);
  const points = fc.array(fc.tuple(place, place), { minLength: 2, maxLength: 9 });
  const box = fc
    .tuple(
      place,
      place,
      fc.integer({ min: 1, max: 600 }).map((n) => n / 11),
    )
    .map(([x0, y0, side]): Box => ({ x0, y0, x1: x0 + side, y1: y0 + side / 2 }));
  fc.assert(
    fc.property(points, fc.boolean(), box, (open, isClosed, inside) => {
      const line = isClosed ? [...open, open[0]] : open;
      const builder = new LineBuilder();
      for (const [x, y] of line) builder.point(x, y);
      builder.end(7);
      const cut = clipLinesToBox(builder.finish(), inside);
      if (cut.xy.length > 0) expect(boxContains(inside, boxOfPoints(cut.xy))).toBe(true);
      expect(totalLength(cut)).toBeCloseTo(lengthInBox(line, inside), 4);
      expect(cut.tag.every((tag) => tag === 7)).toBe(true);
    }),
    { numRuns: cases(300, 20_000) },
  );
});
