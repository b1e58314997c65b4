import { describe, expect, it } from "vitest";
import { IDENTITY } from "../../../src/geometry/affine.js";
import { LineBuilder, lineCount, type Lines } from "../../../src/geometry/polyline.js";

const COUNT = 5000;

/** Lines of two to four points, line i at x = i and with the tag 3 i. */
function manyLines(): Lines {
  const builder = new LineBuilder();
  for (let i = 0; i < COUNT; i++) {
    for (let p = 0; p < 2 + (i % 3); p++) builder.point(i, p);
    builder.end(3 * i);
  }
  return builder.finish();
}

describe("a line builder", () => {
  it("keeps the tag and the points of every one of many lines", () => {
    const lines = manyLines();
    expect(lineCount(lines)).toBe(COUNT);
    for (let i = 0; i < COUNT; i++) {
      expect(lines.tag[i]).toBe(3 * i);
      expect(lines.offsets[i + 1]! - lines.offsets[i]!).toBe(2 + (i % 3));
      expect(lines.xy[2 * lines.offsets[i]!]).toBe(i);
    }
  });

  it("copies ranges and mapped points to what it makes of them point by point", () => {
    const lines = manyLines();
    const byPoint = new LineBuilder();
    const atOnce = new LineBuilder();
    for (const builder of [byPoint, atOnce]) {
      builder.point(-1, -1);
      builder.end(7);
    }
    for (let i = 2; i < COUNT; i++) byPoint.copy(lines, i, lines.tag[i]!);
    atOnce.copyRange(lines, 2, 1000);
    for (let i = 1000; i < COUNT; i++) {
      const [from, to] = [2 * lines.offsets[i]!, 2 * lines.offsets[i + 1]!];
      expect(atOnce.addMapped(lines.xy, from, to, IDENTITY, lines.tag[i]!)).toBe(true);
    }
    expect(atOnce.finish()).toEqual(byPoint.finish());
  });

  it("leaves out a point that repeats the one before it, whichever way it comes", () => {
    const xy = Float64Array.of(0, 0, 5, 5, 5, 5, 9, 9);
    const lines = { xy, offsets: Uint32Array.of(0, 4), tag: Uint32Array.of(2) };
    const builder = new LineBuilder();
    expect(builder.addMapped(xy, 0, 8, IDENTITY, 2)).toBe(false);
    builder.copyRange(lines, 0, 1);
    builder.copy(lines, 0, 3, true);
    const built = builder.finish();
    expect([...built.xy]).toEqual([0, 0, 5, 5, 9, 9, 9, 9, 5, 5, 0, 0]);
    expect([...built.offsets]).toEqual([0, 3, 6]);
    expect([...built.tag]).toEqual([2, 3]);
  });
});
