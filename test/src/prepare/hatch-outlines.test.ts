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
  it("warns that there is nothing to fill, and says what to do", async () => {
    expect(prepare(await importSvg(LINES), TRUE_SIZE).warnings).toEqual([
      expect.stringMatching(/nothing to fill.*--hatch-outlines/) as string,
    ]);
  });

  it("fills closed outlines on request, and no open lines", async () => {
    const plain = prepare(await importSvg(LINES), { ...TRUE_SIZE, hatch: DEFAULT_PREPARE.hatch });
    const filled = prepare(await importSvg(LINES), { ...TRUE_SIZE, hatchOutlines: true, joinMm: 0 });
    expect(filled.warnings).toEqual([]);
    // A square of 40 mm in lines 2 mm apart: 800 mm, give or take a line and the links between lines.
    expect(Math.abs(filled.drawMm - plain.drawMm - 800)).toBeLessThanOrEqual(50);
  });

  it("warns too if there is no closed line", async () => {
    const open = svgOf(`<path d="M20 20h40v40" fill="none" stroke="#000"/>`);
    const { warnings } = prepare(await importSvg(open), { ...TRUE_SIZE, hatchOutlines: true });
    expect(warnings).toEqual([expect.stringMatching(/no filled shape and no closed line/) as string]);
  });

  it("hides nothing under an outline", async () => {
    const both = `<path d="M30 40h60" fill="none" stroke="#000"/><path d="M20 20h40v40h-40z" fill="none" stroke="#000"/>`;
    const settings = { ...TRUE_SIZE, hatchOutlines: true, joinMm: 0 };
    const { drawMm } = prepare(await importSvg(svgOf(both)), settings);
    expect(prepare(await importSvg(svgOf(both)), { ...settings, hideCovered: true }).drawMm).toBeCloseTo(
      drawMm,
      6,
    );
  });

  it.each([
    ["in a row", ""],
    ["in a row inside a frame", `<path d="M0 0h200v20h-200z" fill="none" stroke="#000"/>`],
  ])("fills thousands of small outlines %s", async (_, frame) => {
    const count = 5_000;
    const small = Array.from({ length: count }, (_unused, k) => `M${k * 0.04} 5h.02v6h-.02z`).join("");
    const svg = svgOf(`<path d="${small}" fill="none" stroke="#000"/>${frame}`);
    const hatch = { spacingMm: 0.05, angleDeg: 90, cross: false };
    const settings = { ...TRUE_SIZE, joinMm: 0, clipToMargins: false, hatchOutlines: true };
    const { drawMm } = prepare(await importSvg(svg), { ...settings, hatch });
    const outlines = prepare(await importSvg(svg), { ...settings, hatch: DEFAULT_PREPARE.hatch }).drawMm;
    // The small ones are thinner than the pen, and the frame is a shape of its own.
    const filledMm = frame === "" ? 0 : (200 * 20) / 0.05;
    expect(Math.abs(drawMm - outlines - filledMm)).toBeLessThanOrEqual(filledMm * 0.02);
  });

  it("fills a comb of thousands of teeth, which are side by side at each level", async () => {
    const teeth = Array.from(
      { length: 4_000 },
      (_, k) => `V20H${(k * 0.05 + 0.04).toFixed(3)}V10H${((k + 1) * 0.05).toFixed(3)}`,
    );
    const svg = svgOf(`<path d="M0 5${teeth.join("")}V5z" fill="#000"/>`);
    const hatch = { spacingMm: 0.2, angleDeg: 0, cross: false };
    const settings = { ...TRUE_SIZE, joinMm: 0, clipToMargins: false, outlineFills: false, hatch };
    const { drawMm } = prepare(await importSvg(svg), settings);
    // The bar of 5 mm; the teeth are thinner than the pen.
    expect(Math.abs(drawMm - (200 * 5) / 0.2)).toBeLessThanOrEqual(250);
  });
});
