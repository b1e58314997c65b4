import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PointIndex } from "../../../src/geometry/point-index.js";
import { cases } from "../../support/full-run.js";

/** Few different values, so that points coincide and are collinear. */
const value = fc.oneof(fc.integer({ min: 0, max: 5 }), fc.double({ min: -1e3, max: 1e3, noNaN: true }));
const points = fc.array(fc.tuple(value, value), { minLength: 1, maxLength: 60 });
const RUNS = { numRuns: cases() };

describe("PointIndex", () => {
  it("lists the nearest few, nearest first, without the point itself and the excluded one", () => {
    fc.assert(
      fc.property(points, fc.nat(59), fc.nat(59), fc.integer({ min: 1, max: 8 }), (given, a, b, count) => {
        const id = a % given.length;
        const except = b % given.length;
        const out = new Int32Array(count + 1).fill(-7);
        const found = new PointIndex(Float64Array.from(given.flat())).nearestMany(id, except, count, out, 1);
        const d2 = (i: number): number =>
          (given[i][0] - given[id][0]) ** 2 + (given[i][1] - given[id][1]) ** 2;
        const others = [...given.keys()].filter((i) => i !== id && i !== except);
        const expected = others
          .map(d2)
          .sort((p, q) => p - q)
          .slice(0, count);
        expect([...out.subarray(1, 1 + found)].map(d2)).toEqual(expected);
        expect(new Set(out.subarray(1, 1 + found)).size).toBe(found);
      }),
      RUNS,
    );
  });
});
