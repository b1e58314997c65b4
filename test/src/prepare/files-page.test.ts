/** Placing a file's page on the paper, and turning both. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PREPARE,
  PAPER_SIZES,
  importSvg,
  prepare,
  type PrepareSettings,
} from "../../../src/index.js";
import {
  boxOfPoints,
  isOnFilesPage,
  onFilesPage,
  layOutDrawing,
  quarterTurned,
  quarterTurnedBox,
} from "../../../src/internal.js";

const V3 = { widthMm: 300, heightMm: 218 };
const A3_PLOTTER = { widthMm: 430, heightMm: 297 };
const page = (widthMm: number, heightMm: number) => ({ widthMm, heightMm });
const svgOf = (width: number, height: number, d: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
    <path d="${d}" fill="none" stroke="#000"/></svg>`;
const drawn = async (svg: string, settings: PrepareSettings) =>
  boxOfPoints(prepare(await importSvg(svg), settings).strokes.xy);

const mm = (values: readonly number[]): number[] => values.map((value) => Math.round(value * 1e6) / 1e6);

describe("a file whose page is the paper", () => {
  it("is drawn at true size, past the margins too", async () => {
    // A ruler of 279 mm on A4: inside the margins of 15 mm it would be 267 mm long.
    const { x0, x1, y0 } = await drawn(svgOf(297, 210, "M9 100H288"), DEFAULT_PREPARE);
    expect(mm([x0, x1, y0])).toEqual([9, 288, 100]);
  });

  it("is also recognised if its page is in whole pixels", async () => {
    const svg = svgOf(297, 210, "M9 100H288").replace("297mm", "1123px").replace("210mm", "794px");
    const { x0, x1 } = await drawn(svg, DEFAULT_PREPARE);
    expect(x1 - x0).toBeCloseTo(279, 0);
  });

  it("is turned by itself if it fits the paper only that way, and turns back with the paper", async () => {
    const svg = svgOf(210, 297, "M20 10V200");
    const turned = await drawn(svg, DEFAULT_PREPARE);
    expect(mm([turned.x0, turned.x1, turned.y0])).toEqual([97, 287, 20]);
    const upright = await drawn(svg, { ...DEFAULT_PREPARE, landscape: false });
    expect(mm([upright.x0, upright.y0, upright.y1])).toEqual([20, 10, 200]);
  });

  it("keeps a rotation that the user has chosen", async () => {
    const { size, outside } = prepare(await importSvg(svgOf(210, 297, "M20 10V200")), {
      ...DEFAULT_PREPARE,
      rotateDeg: 0,
    });
    expect(size.scaleX).toBeCloseTo(180 / 190, 3);
    expect([size.turnedDeg, outside]).toEqual([0, null]);
  });
});

describe("the file's page as the paper", () => {
  it("has the name of a paper if it has that size, and otherwise a custom size", () => {
    expect(onFilesPage(DEFAULT_PREPARE, page(420, 297), A3_PLOTTER).paper).toEqual(PAPER_SIZES.A3);
    const own = onFilesPage(DEFAULT_PREPARE, page(200, 120), null);
    expect([own.paper, own.landscape]).toEqual([page(120, 200), true]);
    expect([
      isOnFilesPage(own, page(200, 120)),
      isOnFilesPage({ ...own, fit: true }, page(200, 120)),
    ]).toEqual([true, false]);
  });

  it("lies as the page does, or the other way if the machine reaches only that", () => {
    expect(onFilesPage(DEFAULT_PREPARE, page(210, 297), A3_PLOTTER).landscape).toBe(false);
    expect(onFilesPage(DEFAULT_PREPARE, page(210, 297), V3).landscape).toBe(true);
  });
});

describe("a quarter turn of paper and drawing", () => {
  const svg = svgOf(60, 40, "M0 0L60 40M6 20H16");
  it.each<[string, Partial<PrepareSettings>]>([
    ["fitted", { fit: true }],
    ["at true size", { fit: false }],
    ["on the file's page", onFilesPage(DEFAULT_PREPARE, page(60, 40), null)],
    ["with four margins", { margins: { topMm: 5, rightMm: 10, bottomMm: 30, leftMm: 50 } }],
    ["placed", { layout: { xMm: 20, yMm: 30, widthMm: 80, heightMm: null } }],
    ["placed and turned", { layout: { xMm: 20, yMm: 60, widthMm: null, heightMm: 40, turnDeg: 30 } }],
    ["mirrored", { fit: true, mirror: "leftRight", rotateDeg: 30 }],
  ])("leaves the same plot on the sheet: %s", async (_how, change) => {
    const settings = { ...DEFAULT_PREPARE, landscape: false, ...change };
    const placement = layOutDrawing(await importSvg(svg), settings);
    const after = await drawn(svg, quarterTurned(settings, placement, page(60, 40)));
    // At true size the page is at the paper's corner before and after.
    const heightMm = placement.choice.how === "corner" ? 40 : 297;
    const expected = quarterTurnedBox(await drawn(svg, settings), heightMm);
    for (const side of ["x0", "y0", "x1", "y1"] as const) expect(after[side]).toBeCloseTo(expected[side], 3);
  });

  it("leaves a drawing that follows the paper by itself so", async () => {
    const portrait = { ...DEFAULT_PREPARE, landscape: false };
    const placement = layOutDrawing(await importSvg(svgOf(210, 297, "M20 10V200")), portrait);
    const turned = quarterTurned(portrait, placement, page(210, 297));
    expect([turned.landscape, turned.rotateDeg]).toEqual([true, "auto"]);
  });
});
