/** Placing a file's page on the paper if the user has chosen no position, and turning it to fit the machine's reach. */
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
  placeDrawing,
  placedForPage,
  quarterTurned,
  quarterTurnedBox,
  withoutFilesPage,
} from "../../../src/internal.js";

const V3 = { widthMm: 300, heightMm: 218 };
const A3_PLOTTER = { widthMm: 430, heightMm: 297 };
const page = (widthMm: number, heightMm: number) => ({ widthMm, heightMm });
const svgOf = (width: number, height: number, d: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
    <path d="${d}" fill="none" stroke="#000"/></svg>`;
const drawn = (svg: string, settings: PrepareSettings) =>
  boxOfPoints(prepare(importSvg(svg), settings).strokes.xy);

describe("a file whose page is the paper", () => {
  it("is drawn at true size, past the margins too", () => {
    // A ruler of 279 mm on A4: inside the margins of 15 mm it would be 267 mm long.
    const settings = placedForPage(DEFAULT_PREPARE, page(297, 210), V3);
    const { x0, x1, y0 } = drawn(svgOf(297, 210, "M9 100H288"), settings);
    expect([x0, x1, y0].map((mm) => Math.round(mm * 1e6) / 1e6)).toEqual([9, 288, 100]);
  });

  it("is also recognised if its page is in whole pixels, and the paper keeps its name", () => {
    const letter = { ...DEFAULT_PREPARE, paper: PAPER_SIZES.Letter };
    const { fit, paper, landscape } = placedForPage(letter, page((1056 * 25.4) / 96, (817 * 25.4) / 96), V3);
    expect({ fit, paper, landscape }).toEqual({ fit: false, paper: PAPER_SIZES.Letter, landscape: true });
  });

  it("is portrait if the machine reaches that, and is otherwise turned with its paper", () => {
    const svg = svgOf(210, 297, "M20 10V200");
    const upright = placedForPage(DEFAULT_PREPARE, page(210, 297), A3_PLOTTER);
    expect([upright.landscape, upright.rotateDeg]).toEqual([false, 0]);
    const turned = placedForPage(DEFAULT_PREPARE, page(210, 297), V3);
    expect([turned.landscape, turned.rotateDeg]).toEqual([true, 90]);
    const { x0, x1, y0 } = drawn(svg, turned);
    expect([x0, x1, y0].map((mm) => Math.round(mm * 1e6) / 1e6)).toEqual([97, 287, 20]);
  });

  it("is cut at the edge of its page", () => {
    const settings = placedForPage(DEFAULT_PREPARE, page(297, 210), V3);
    expect(drawn(svgOf(297, 210, "M-20 100H400"), settings).x1).toBeCloseTo(297, 3);
  });
});

describe("a place chosen by hand", () => {
  it.each([
    ["true size", { fit: false }],
    ["a place", { place: { xMm: 1, yMm: 1, widthMm: 50, heightMm: null } }],
    ["a turn", { rotateDeg: 30 }],
    ["no cut at the margins", { clipToMargins: false }],
  ])("stays unchanged: %s", (_what, change) => {
    const settings = { ...DEFAULT_PREPARE, ...change };
    expect(placedForPage(settings, page(297, 210), V3)).toBe(settings);
  });

  it("is not the place on the file's page: the next drawing starts from the defaults", () => {
    const first = placedForPage(DEFAULT_PREPARE, page(210, 297), V3);
    expect(isOnFilesPage(first, page(210, 297))).toBe(true);
    expect(placedForPage(withoutFilesPage(first), page(100, 100), V3)).toEqual(DEFAULT_PREPARE);
  });
});

describe("a drawing that is fitted", () => {
  it("has its paper turned if the machine reaches only that", () => {
    const portrait = { ...DEFAULT_PREPARE, landscape: false };
    expect(placedForPage(portrait, page(100, 100), V3).landscape).toBe(true);
    expect(placedForPage(portrait, page(100, 100), A3_PLOTTER).landscape).toBe(false);
    const tooLarge = { ...portrait, paper: PAPER_SIZES.A2 };
    expect(placedForPage(tooLarge, page(100, 100), V3)).toBe(tooLarge);
  });
});

describe("the file's page as the paper", () => {
  it("has the name of a paper if it has that size, and otherwise a custom size", () => {
    expect(onFilesPage(DEFAULT_PREPARE, page(420, 297), A3_PLOTTER).paper).toEqual(PAPER_SIZES.A3);
    const own = onFilesPage(DEFAULT_PREPARE, page(200, 120), null);
    expect([own.paper, own.landscape]).toEqual([page(120, 200), true]);
  });
});

describe("a quarter turn of paper and drawing", () => {
  const svg = svgOf(60, 40, "M0 0L60 40M6 20H16");
  it.each<[string, Partial<PrepareSettings>]>([
    ["fitted", {}],
    ["at true size", { fit: false, clipToMargins: false }],
    ["on the file's page", onFilesPage(DEFAULT_PREPARE, page(60, 40), null)],
    ["with four margins", { margins: { topMm: 5, rightMm: 10, bottomMm: 30, leftMm: 50 } }],
    ["placed", { place: { xMm: 20, yMm: 30, widthMm: 80, heightMm: null } }],
    ["placed and turned", { place: { xMm: 20, yMm: 60, widthMm: null, heightMm: 40, turnDeg: 30 } }],
    ["mirrored", { mirror: "leftRight", rotateDeg: 30 }],
  ])("leaves the same plot on the sheet: %s", (_how, change) => {
    const settings = { ...DEFAULT_PREPARE, landscape: false, ...change };
    const { frame } = placeDrawing(importSvg(svg), settings);
    const after = drawn(svg, quarterTurned(settings, frame));
    // At true size the page is at the paper's corner before and after.
    const heightMm = settings.fit || settings.place ? 297 : 40;
    const expected = quarterTurnedBox(drawn(svg, settings), heightMm);
    for (const side of ["x0", "y0", "x1", "y1"] as const) expect(after[side]).toBeCloseTo(expected[side], 3);
  });
});
