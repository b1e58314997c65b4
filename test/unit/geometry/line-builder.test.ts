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
      expect(lines.offsets[i + 1] - lines.offsets[i]).toBe(2 + (i % 3));
      expect(lines.xy[2 * lines.offsets[i]]).toBe(i);
    }
  });

  it("copies ranges and mapped points like point by point", () => {
    const lines = manyLines();
    const byPoint = new LineBuilder();
    const atOnce = new LineBuilder();
    for (const builder of [byPoint, atOnce]) {
      builder.point(-1, -1);
      builder.end(7);
    }
    for (let i = 2; i < COUNT; i++) byPoint.copy(lines, i, i < 1000 ? lines.tag[i] : i);
    atOnce.copyRange(lines, 2, 1000);
    const numbers = lines.offsets.map((point) => 2 * point);
    expect(atOnce.addMapped(lines.xy, numbers, 1000, COUNT, IDENTITY)).toBe(COUNT);
    expect(atOnce.finish()).toEqual(byPoint.finish());
  });

  it("leaves out a point that repeats the one before it, however it is added", () => {
    const xy = Float64Array.of(1, 1, 2, 2, 0, 0, 5, 5, 5, 5, 9, 9, 3, 3, 4, 4);
    const lines = { xy, offsets: Uint32Array.of(0, 2, 6, 8), tag: Uint32Array.of(6, 7, 8) };
    const builder = new LineBuilder();
    expect(builder.addMapped(xy, Uint32Array.of(0, 4, 12, 16), 0, 3, IDENTITY)).toBe(1);
    builder.copyRange(lines, 0, 3);
    builder.copy(lines, 1, 3, true);
    const built = builder.finish();
    const copied = [1, 1, 2, 2, 0, 0, 5, 5, 9, 9, 3, 3, 4, 4];
    expect([...built.xy]).toEqual([1, 1, 2, 2, ...copied, 9, 9, 5, 5, 0, 0]);
    expect([...built.offsets]).toEqual([0, 2, 4, 7, 9, 12]);
    expect([...built.tag]).toEqual([0, 6, 7, 8, 3]);
  });
});
