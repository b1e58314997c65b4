import { describe, expect, it } from "vitest";
import { lineGapMm, buildPickGrid } from "../../../web/scene/pick.js";
import { PIECE_BYTES, PIECE_FLOATS } from "../../../web/scene/pieces.js";
import { lineWidthPx, MIN_LINE_PX, type Frame } from "../../../web/scene/renderer.js";
import { makeFrame } from "../../support/jobs/jobs-on-page.js";

/** Vertical lines of 100 mm, `gapMm` apart, in pieces of 1 mm. */
const hatch = (gapMm: number): { gapMm: number; of: number } => {
  const lines = Math.round(100 / gapMm);
  const bytes = new ArrayBuffer(lines * 100 * PIECE_BYTES);
  const floats = new Float32Array(bytes);
  for (let k = 0; k < lines * 100; k++) {
    const x = Math.floor(k / 100) * gapMm;
    floats.set([x, k % 100, x, (k % 100) + 1], k * PIECE_FLOATS);
  }
  const grid = buildPickGrid({ count: lines * 100, bytes });
  return { gapMm, of: lineGapMm(grid, lines * 100) };
};

const frame = (scale: number, gap: number | undefined): Frame => ({
  ...makeFrame(0),
  view: { scale, offsetX: 0, offsetY: 0 },
  lineGapMm: gap,
});

describe("the gap between lines", () => {
  it.each([0.5, 1, 4])("is %s mm for a hatch with that spacing", (gapMm) => {
    expect(hatch(gapMm).of / gapMm).toBeCloseTo(1, 0);
  });
});

describe("a line on the screen", () => {
  it("has a minimum width if the lines have room", () => {
    expect(lineWidthPx(frame(3, 4), 0.1)).toBe(MIN_LINE_PX);
    expect(lineWidthPx(frame(3, undefined), 0.1)).toBe(MIN_LINE_PX);
  });

  it("leaves half of the paper free in a dense drawing, and grows with the zoom to its true width", () => {
    expect(lineWidthPx(frame(3, 0.5), 0.1)).toBeCloseTo(0.75);
    expect(lineWidthPx(frame(3, 0.1), 0.1)).toBe(0.5);
    expect(lineWidthPx(frame(40, 0.5), 0.1)).toBeCloseTo(4);
  });
});
