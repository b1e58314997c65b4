import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, importSvg, plan, prepare } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { boxOfDrawn } from "../../../web/plotter/plotter-actions.js";

const settings = { ...DEFAULT_PLOT_SETTINGS.prepare, fit: false, joinMm: 0 };
const svg = (body: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="150mm" viewBox="0 0 200 150">
   <g fill="none" stroke="#000">${body}</g></svg>`;
const boxOf = async (body: string) => {
  const { strokes } = prepare(await importSvg(svg(body)), settings);
  return { box: boxOfDrawn(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN)), strokes };
};

describe("the frame that is traced", () => {
  it("goes around what the pen draws, not around its pen-up travel", async () => {
    const { box, strokes } = await boxOf('<path d="M50 40h60"/><path d="M90 70v30"/>');
    const xs = [...strokes.xy].filter((_, i) => i % 2 === 0);
    const ys = [...strokes.xy].filter((_, i) => i % 2 === 1);
    expect(box?.xMm).toBeCloseTo(Math.min(...xs), 3);
    expect(box?.yMm).toBeCloseTo(Math.min(...ys), 3);
    expect(box?.widthMm).toBeCloseTo(60, 3);
    expect(box?.heightMm).toBeCloseTo(60, 3);
    expect(box?.xMm).toBeGreaterThan(1);
  });

  it("is absent if nothing is drawn", async () => {
    expect((await boxOf("")).box).toBeNull();
  });
});
