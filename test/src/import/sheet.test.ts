/** Sheets: several files placed on one sheet, as one text that every reader of drawings takes. */
import { describe, expect, it } from "vitest";
import { importDrawing, PlotwrightError } from "../../../src/index.js";
import { shapesOf } from "../../support/import/shapes.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10"><path stroke="#000" d="M0 0L20 10"/></svg>`;
const HPGL = "IN;SP1;PU0,0;PD400,0;PU;";
const JSON_LINES = `{"widthMm": 10, "heightMm": 10, "layers": [{"name": "Ink", "strokes": [[1, 2, 3, 4]]}]}`;

const sheet = (more: object = {}): string =>
  JSON.stringify({
    format: "plotwright-sheet",
    version: 1,
    widthMm: 297,
    heightMm: 210,
    files: [
      { name: "leaf", text: SVG },
      { name: "dots", text: JSON_LINES },
    ],
    items: [
      { file: 0, matrix: [1, 0, 0, 1, 30, 40] },
      { file: 1, matrix: [0, 2, -2, 0, 100, 50] },
      { file: 0, matrix: [2, 0, 0, 2, 0, 0] },
    ],
    ...more,
  });

const faultOf = async (text: string): Promise<string> => {
  try {
    await importDrawing("", text);
  } catch (error) {
    expect(error).toBeInstanceOf(PlotwrightError);
    expect((error as PlotwrightError).code).toBe("bad-file");
    return (error as PlotwrightError).message;
  }
  throw new Error("it was read");
};

describe("a sheet", () => {
  it("is the drawing of its files where their matrices place them, in the order of its items", async () => {
    const drawing = await importDrawing("poster", sheet());
    expect([drawing.widthMm, drawing.heightMm]).toEqual([297, 210]);
    expect(shapesOf(drawing)).toEqual(["M30 40L50 50", "M96 52L92 56", "M0 0L40 20"]);
    expect(drawing.groups.map(({ id }) => id)).toEqual(["layer-1", "2/layer-1"]);
    expect(drawing.groups.map(({ name }) => name)).toEqual(["Layer 1 (leaf)", "Ink (dots)"]);
  });

  it("may have files of every format, and a sheet as a file", async () => {
    const inner = sheet({
      files: [{ name: "pen", text: HPGL }],
      items: [{ file: 0, matrix: [1, 0, 0, 1, 5, 5] }],
    });
    const drawing = await importDrawing(
      "",
      sheet({ files: [{ name: "inner", text: inner }], items: [{ file: 0, matrix: [1, 0, 0, 1, 1, 1] }] }),
    );
    expect(drawing.paths.count).toBe(1);
  });

  it("may name its keys in any order before its lists", async () => {
    const { format, version, ...rest } = JSON.parse(sheet()) as Record<string, unknown>;
    const drawing = await importDrawing(
      "",
      JSON.stringify({ widthMm: 1, version, format, ...rest }, null, 2),
    );
    expect(drawing.paths.count).toBe(3);
  });

  it("says what is wrong with it, and in which file or item", async () => {
    expect(await faultOf(`${sheet().slice(0, -5)}`)).toMatch(/^The sheet is damaged/);
    expect(await faultOf(sheet({ version: 2 }))).toMatch(/its version is 2/);
    expect(await faultOf(sheet({ widthMm: 0 }))).toMatch(/widthMm must be a number of mm above 0/);
    expect(await faultOf(sheet({ files: 3 }))).toMatch(/no list of files/);
    expect(await faultOf(sheet({ files: [{ name: "a" }] }))).toMatch(/file 1 has no text/);
    expect(await faultOf(sheet({ items: [{ file: 2, matrix: [1, 0, 0, 1, 0, 0] }] }))).toMatch(
      /item 1 names a file that is not in the list/,
    );
    expect(await faultOf(sheet({ items: [{ file: 0, matrix: [1, 0, 0, 1, 0] }] }))).toMatch(
      /the matrix of item 1 is not a list of 6 numbers/,
    );
    expect(await faultOf(sheet({ files: [{ name: "leaf", text: "<svg" }], items: [] }))).toMatch(
      /^"leaf" of the sheet: /,
    );
  });

  it("refuses so many copies that they would not fit in memory, before it makes them", async () => {
    const strokes = [Array.from({ length: 40_000 }, (_, i) => i % 100)];
    const text = JSON.stringify({ widthMm: 10, heightMm: 10, layers: [{ strokes }] });
    const items = Array.from({ length: 5_000 }, () => ({ file: 0, matrix: [1, 0, 0, 1, 0, 0] }));
    expect(await faultOf(sheet({ files: [{ name: "big", text }], items }))).toMatch(
      /more than 25 million points together/,
    );
  });
});
