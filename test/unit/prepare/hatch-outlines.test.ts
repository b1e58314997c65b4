/** Filling a drawing that has only lines: warns that there is nothing to fill, or fills its closed outlines. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, importSvg, prepare, type PrepareSettings } from "../../../src/index.js";

const HATCH = { spacingMm: 2, angleDeg: 0, cross: false };
const TRUE_SIZE: PrepareSettings = { ...DEFAULT_PREPARE, fit: false, order: "none", hatch: HATCH };
const svgOf = (shapes: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">${shapes}</svg>`;
const LINES = svgOf(
  `<g fill="none" stroke="#000"><path d="M20 20h40v40h-40z"/><path d="M100 20v40h40"/></g>`,
);

describe("filling a drawing without filled shapes", () => {
  it("warns that there is nothing to fill, and says what to do", () => {
    expect(prepare(importSvg(LINES), TRUE_SIZE).warnings).toEqual([
      expect.stringMatching(/nothing to fill.*closed outlines/) as string,
    ]);
  });

  it("fills closed outlines on request, and no open lines", () => {
    const plain = prepare(importSvg(LINES), { ...TRUE_SIZE, hatch: DEFAULT_PREPARE.hatch });
    const filled = prepare(importSvg(LINES), { ...TRUE_SIZE, hatchOutlines: true, joinMm: 0 });
    expect(filled.warnings).toEqual([]);
    // A square of 40 mm in lines 2 mm apart: 800 mm, give or take a line and the links between lines.
    expect(Math.abs(filled.drawMm - plain.drawMm - 800)).toBeLessThanOrEqual(50);
  });

  it("warns too if there is no closed line", () => {
    const open = svgOf(`<path d="M20 20h40v40" fill="none" stroke="#000"/>`);
    const { warnings } = prepare(importSvg(open), { ...TRUE_SIZE, hatchOutlines: true });
    expect(warnings).toEqual([expect.stringMatching(/no filled shape and no closed line/) as string]);
  });

  it("hides nothing under an outline", () => {
    const both = `<path d="M30 40h60" fill="none" stroke="#000"/><path d="M20 20h40v40h-40z" fill="none" stroke="#000"/>`;
    const settings = { ...TRUE_SIZE, hatchOutlines: true, joinMm: 0 };
    const { drawMm } = prepare(importSvg(svgOf(both)), settings);
    expect(prepare(importSvg(svgOf(both)), { ...settings, hideCovered: true }).drawMm).toBeCloseTo(drawMm, 6);
  });
});
