/** Lines that a program computes: as strokes in their own order, or through the same steps as a drawing. */
import { describe, expect, it } from "vitest";
import { importSvg, PAPER_SIZES, prepare, strokesOf, type Line, type StrokeSet } from "../../../src/index.js";

const pointsOf = ({ xy, offsets }: StrokeSet): number[][] =>
  Array.from(offsets.subarray(1), (end, i) => Array.from(xy.subarray(2 * offsets[i], 2 * end)));

const FAR: Line = [[200, 100], [210, 100]]; // prettier-ignore
const NEAR: Line = [[10, 10], [20, 10], [20, 15]]; // prettier-ignore
const AFTER_NEAR: Line = [[20.05, 15], [30, 15]]; // prettier-ignore
const DOT: Line = [[5, 5]];

describe("lines that a program computes", () => {
  it("keep their order as strokes", () => {
    expect(pointsOf(strokesOf([FAR, DOT, NEAR]))).toEqual([
      [200, 100, 210, 100],
      [5, 5],
      [10, 10, 20, 10, 20, 15],
    ]);
  });

  it("are ordered and joined by prepare, with their points in mm on the paper", () => {
    const { strokes, travelMm, travelMmUnordered, size } = prepare([FAR, NEAR, DOT, AFTER_NEAR], {
      order: "best",
    });
    expect(pointsOf(strokes)).toEqual([
      [5, 5],
      [10, 10, 20, 10, 20, 15, 20.05, 15, 30, 15],
      [200, 100, 210, 100],
    ]);
    expect(travelMm).toBeLessThan(travelMmUnordered);
    expect([size.scaleX, size.scaleY, size.turnedDeg]).toEqual([1, 1, 0]);
  });

  it("are placed, repeated and cut like the lines of a drawing of the paper's size", async () => {
    const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="148mm" viewBox="0 0 210 148" fill="none" stroke="black"><path d="M200 100H210"/><path d="M10 10H20V15"/></svg>`;
    const settings = { paper: PAPER_SIZES.A5, marginMm: 12, clipToMargins: true, rotateDeg: 90 };
    const ofLines = prepare([FAR, NEAR], settings);
    const ofDrawing = prepare(await importSvg(svg), settings);
    expect(pointsOf(ofLines.strokes)).toEqual(pointsOf(ofDrawing.strokes));
    expect(ofLines.warnings).toEqual(ofDrawing.warnings);
  });

  it("are refused with what to pass instead", () => {
    expect(() => prepare([[1, 2, 3]] as never)).toThrow(
      /prepare takes a list of lines, each a list of points/,
    );
    expect(() => prepare([[[0, 0], [NaN, 1]]])).toThrow(/line 0 has the point NaN, 1/); // prettier-ignore
    expect(() => prepare({} as never)).toThrow(/importDrawing returns, or a list of lines/);
  });
});
