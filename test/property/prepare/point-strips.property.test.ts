import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PointStrips } from "../../../src/geometry/point-strips.js";
import { cases } from "../../support/full-run.js";

/** Few different values, so that points coincide and stand in rows and columns; and a few that are far from the rest. */
const value = fc.oneof(
  fc.integer({ min: 0, max: 5 }),
  fc.double({ min: -1e3, max: 1e3, noNaN: true }),
  fc.double({ min: -1e-5, max: 1e-5, noNaN: true }),
  fc.constant(1e9),
);
const points = fc.array(fc.tuple(value, value), { maxLength: 120 });
const RUNS = { numRuns: cases() };

describe("PointStrips", () => {
  it("finds as near a point as a look at all of them, from anywhere and from points of its own, while points are removed", () => {
    fc.assert(
      fc.property(
        points,
        fc.array(fc.tuple(value, value, fc.nat(119), fc.boolean(), fc.boolean()), { maxLength: 100 }),
        (given, queries) => {
          const strips = new PointStrips(Float64Array.from(given.flat()));
          const left = new Set(given.keys());
          for (const [someX, someY, some, isOwn, remove] of queries) {
            const id = isOwn && given.length > 0 ? some % given.length : -1;
            const [x, y] = id < 0 ? [someX, someY] : given[id];
            const d2 = (i: number): number => (given[i][0] - x) ** 2 + (given[i][1] - y) ** 2;
            const found = id < 0 ? strips.nearest(x, y) : strips.nearestTo(id);
            if (left.size === 0) expect(found).toBe(-1);
            else {
              expect(left.has(found)).toBe(true);
              expect(d2(found)).toBe(Math.min(...[...left].map(d2)));
              if (!remove) continue;
              strips.removeAll(found, found + 1);
              left.delete(found);
            }
          }
        },
      ),
      RUNS,
    );
  });
});
