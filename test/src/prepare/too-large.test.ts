/** Small drawings that would take minutes to prepare: work is bounded by counts, and the error says what to do. */
import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { LineBuilder, lineCount } from "../../../src/geometry/polyline.js";
import { regionOf, ringOf, type Region } from "../../../src/geometry/region.js";
import { hideCovered } from "../../../src/prepare/steps/hidden-lines.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { randomFrom } from "../../../src/prepare/work.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const range = (count: number): number[] => Array.from({ length: count }, (_, i) => i);

function faultOf(work: () => unknown): Pick<PlotwrightError, "code" | "message"> {
  try {
    work();
  } catch (error) {
    if (error instanceof PlotwrightError) return error;
    throw error;
  }
  throw new Error("it came to an end");
}

describe("hiding covered lines", () => {
  /** Hides the lines of filled polygons with at most so many comparisons. Returns the number of lines that are left. */
  function visibleOf(polygons: readonly (readonly number[])[], maxPairs?: number): number {
    const builder = new LineBuilder();
    const areas = new Map<number, Region>();
    polygons.forEach((xy, shape) => {
      for (let k = 0; k <= xy.length; k += 2) builder.point(xy[k % xy.length], xy[(k + 1) % xy.length]);
      builder.end(shape);
      areas.set(shape, regionOf([ringOf(xy)]));
    });
    return lineCount(
      hideCovered(builder.finish(), areas, () => true, new Float64Array(polygons.length), {}, maxPairs),
    );
  }

  /** Circles that cover each other many times. */
  function circles(count: number): number[][] {
    const random = randomFrom(1);
    return range(count).map(() => {
      const [x, y, r] = [30 + 140 * random(), 30 + 140 * random(), 5 + 20 * random()];
      return range(20).flatMap((k) => [
        x + r * Math.cos((k / 10) * Math.PI),
        y + r * Math.sin((k / 10) * Math.PI),
      ]);
    });
  }
  /** Long and thin, so that each crosses most others, and nearly all of each is visible. */
  function needles(count: number): number[][] {
    const random = randomFrom(2);
    return range(count).map(() => {
      const [x0, y0, x1] = [200 * random(), 0, 200 * random()];
      return [x0, y0, x0 + 0.01, y0, x1, 200];
    });
  }

  it("needs comparisons in proportion to the number of overlapping circles", () => {
    for (const count of [250, 1_000, 2_000]) {
      expect(visibleOf(circles(count), 12_000 * count)).toBeGreaterThan(30);
    }
  });

  it("ends with what to do if too many shapes cross too many lines", () => {
    expect(visibleOf(needles(60), 1_000_000)).toBeGreaterThan(1_000);
    const { code, message } = faultOf(() => visibleOf(needles(600), 1_000_000));
    expect(code).toBe("too-large");
    expect(message).toMatch(/^Hiding covered lines takes too long here: .*Draw hidden lines too, or plot/);
  });
});

describe("dashed lines", () => {
  const pageOf = (lengths: readonly number[], lines: number) =>
    drawingOf(
      range(lines).map((k) => ({ d: `M0 ${k / 10}L200 ${k / 10}`, dash: 0 })),
      { widthMm: 200, heightMm: 200, dashes: [{ lengths, offset: 0 }] },
    );
  const countOf = (drawing: ReturnType<typeof pageOf>): number =>
    prepare(drawing, { fit: false, marginMm: 0, joinMm: 0, order: "none" }).strokes.offsets.length - 1;

  it("are drawn with a hundred thousand dashes", () => {
    expect(countOf(pageOf([0.1, 0.1], 100))).toBe(100_000);
  });

  it.each([
    ["tiny dashes", [0.03, 0.03]],
    ["thousands of dashes without length", [...range(2_000).map(() => 0), 0.06]],
  ])("end with what to do if they have %s", (_name, lengths) => {
    const { code, message } = faultOf(() => countOf(pageOf(lengths, 2_000)));
    expect(code).toBe("too-large");
    expect(message).toMatch(/more than 1 million dashes\. Make the dashes longer or the lines solid/);
  });
});
