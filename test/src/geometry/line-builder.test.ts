import { describe, expect, it } from "vitest";
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
  it("keeps the tags and points of many lines", () => {
    const lines = manyLines();
    expect(lineCount(lines)).toBe(COUNT);
    for (let i = 0; i < COUNT; i++) {
      expect(lines.tag[i]).toBe(3 * i);
      expect(lines.offsets[i + 1] - lines.offsets[i]).toBe(2 + (i % 3));
      expect(lines.xy[2 * lines.offsets[i]]).toBe(i);
    }
  });

  it("leaves out a point that repeats the one before it, however it is added", () => {
    const xy = Float64Array.of(1, 1, 2, 2, 0, 0, 5, 5, 5, 5, 9, 9, 3, 3, 4, 4);
    const lines = { xy, offsets: Uint32Array.of(0, 2, 6, 8), tag: Uint32Array.of(6, 7, 8) };
    const builder = new LineBuilder();
    for (let i = 0; i < 3; i++) builder.copy(lines, i, lines.tag[i]);
    builder.copy(lines, 1, 3, true);
    const built = builder.finish();
    const copied = [1, 1, 2, 2, 0, 0, 5, 5, 9, 9, 3, 3, 4, 4];
    expect([...built.xy]).toEqual([...copied, 9, 9, 5, 5, 0, 0]);
    expect([...built.offsets]).toEqual([0, 2, 5, 7, 10]);
    expect([...built.tag]).toEqual([6, 7, 8, 3]);
  });
});
