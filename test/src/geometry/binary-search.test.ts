import { describe, expect, it } from "vitest";
import { firstWhere } from "../../../src/geometry/binary-search.js";

describe("the first integer for which a condition holds", () => {
  it.each([
    [0, 10, 7],
    [0, 10, 0],
    [2, 2 ** 52, 2 ** 51 + 3],
    [2, 2 ** 52, 2],
  ])("in %d … %d is found", (from, end, first) => {
    expect(firstWhere(from, end, (i) => i >= first)).toBe(first);
  });

  it("is the end if there is none", () => {
    expect(firstWhere(3, 2 ** 40, () => false)).toBe(2 ** 40);
    expect(firstWhere(5, 5, () => true)).toBe(5);
  });
});
