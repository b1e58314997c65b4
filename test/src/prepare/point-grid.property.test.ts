import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { NearestPoints, PointGrid } from "../../../src/geometry/point-grid.js";
import { cases } from "../../support/runs/full-run.js";

/** Few different values, so that points coincide and lie in rows and columns; and a few far from the rest. */
const value = fc.oneof(
  fc.integer({ min: 0, max: 5 }),
  fc.double({ min: -1e3, max: 1e3, noNaN: true }),
  fc.double({ min: -1e-5, max: 1e-5, noNaN: true }),
  fc.constant(1e9),
);
const points = fc.array(fc.tuple(value, value), { maxLength: 120 });
const RUNS = { numRuns: cases() };

describe("PointGrid", () => {
  it("finds the nearest points within a limit, ordered by distance and then by number, while points are removed", () => {
    fc.assert(
      fc.property(
        points,
        fc.integer({ min: 1, max: 8 }),
        fc.constantFrom(0.3, 2, 50),
        fc.array(fc.tuple(value, value, fc.nat(119), fc.constantFrom(0.5, 3, Infinity)), { maxLength: 60 }),
        (given, max, pointsInCell, queries) => {
          const grid = new PointGrid(Float64Array.from(given.flat()), pointsInCell);
          const found = new NearestPoints(max);
          const left = new Set(given.keys());
          for (const [someX, someY, own, limit] of queries) {
            const [x, y] = left.has(own) ? given[own] : [someX, someY];
            const d2 = (i: number): number => (given[i][0] - x) ** 2 + (given[i][1] - y) ** 2;
            grid.find(x, y, limit, found);
            const expected = [...left]
              .filter((i) => d2(i) <= limit * limit)
              .sort((a, b) => d2(a) - d2(b) || a - b)
              .slice(0, max);
            const ids = [...found.ids.subarray(0, found.count)];
            expect(ids).toEqual(expected);
            if (ids.length === 0) continue;
            grid.remove(ids[0]);
            left.delete(ids[0]);
          }
          expect([...grid.inSpaceOrder()].sort((a, b) => a - b)).toEqual([...left].sort((a, b) => a - b));
        },
      ),
      RUNS,
    );
  });

  it("takes linear time for many points at one place", () => {
    const count = 100_000;
    const grid = new PointGrid(new Float64Array(2 * count).fill(7));
    const found = new NearestPoints(24);
    let lowest = 0;
    for (let id = 0; id < count; id++) {
      grid.find(7, 7, 1, found);
      if (found.ids[0] === id) lowest++;
      grid.remove(id);
    }
    expect(lowest).toBe(count);
    grid.find(7, 7, 1, found);
    expect(found.count).toBe(0);
  }, 20_000);
});
