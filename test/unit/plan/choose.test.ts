import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { clamped, greater, lesser } from "../../../src/plan/choose.js";

const number = fc.oneof(
  fc.double({ noNaN: true }),
  fc.constantFrom(0, 1, -1, 1e-300, 1e300, Infinity, -Infinity),
);

describe("the functions without a branch", () => {
  it("return exactly one of their arguments, like Math.min and Math.max", () => {
    fc.assert(
      fc.property(number, number, (a, b) => {
        expect(lesser(a, b) === Math.min(a, b)).toBe(true);
        expect(greater(a, b) === Math.max(a, b)).toBe(true);
      }),
    );
  });

  it("clamp to bounds that can be equal or infinite", () => {
    fc.assert(
      fc.property(number, number, number, (a, b, c) => {
        const [low, high] = [Math.min(b, c), Math.max(b, c)];
        expect(clamped(a, low, high) === Math.min(high, Math.max(low, a))).toBe(true);
        expect(clamped(low, low, high)).toBe(low);
        expect(clamped(high, low, high)).toBe(high);
      }),
    );
  });
});
