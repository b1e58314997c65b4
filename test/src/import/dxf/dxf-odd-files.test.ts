/** DXF files as programs write them: planes of their own, paper space, data of applications, missing ends, old units. */
import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../../src/import/registry.js";
import { drawParts as draw, lineOn } from "../../../support/import/dxf.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const LINE = lineOn("0", 0);
/** 100 mm high and wide; shapes are measured from its lower left corner, which is the origin. */
const FRAME = "|0 LWPOLYLINE|8 0|90 3|70 0|10 0|20 100|10 0|20 0|10 100|20 0";
/** The corners of the shape after the frame, mm, y up. */
async function boxOf(entities: string, blocks = ""): Promise<number[]> {
  const drawing = await draw(`${FRAME}${entities}`, { blocks });
  const [, [x, y]] = pointsOf(drawing, 0);
  const points = pointsOf(drawing, 1).map(([px, py]) => [px - x, y - py]);
  const [xs, ys] = [0, 1].map((i) => points.map((point) => point[i]));
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)].map(
    (mm) => Math.round(mm * 1e3) / 1e3 + 0,
  );
}
const facing = (x: number, y: number, z: number): string => `|210 ${x}|220 ${y}|230 ${z}`;
const HALF = Math.SQRT1_2;

describe("an entity in a plane of its own is drawn as seen from above", () => {
  it.each([
    [
      "a circle in the plane of the page",
      `|0 CIRCLE|8 0|10 50|20 50|40 20${facing(0, 0, 1)}`,
      [30, 30, 70, 70],
    ],
    ["from below", `|0 CIRCLE|8 0|10 -50|20 50|40 20${facing(0, 0, -1)}`, [30, 30, 70, 70]],
    ["an arc from below", `|0 ARC|8 0|10 -50|20 50|40 20|50 0|51 90${facing(0, 0, -1)}`, [30, 50, 50, 70]],
    ["tilted by 45°", `|0 CIRCLE|8 0|10 0|20 0|40 20${facing(0, -HALF, HALF)}`, [-20, -14.142, 20, 14.142]],
    ["on edge", `|0 CIRCLE|8 0|10 50|20 0|40 20${facing(0, -1, 0)}`, [30, 0, 70, 0]],
    [
      "on edge, away from the origin",
      `|0 CIRCLE|8 0|10 50|20 0|30 -30|40 20${facing(0, -1, 0)}`,
      [30, 30, 70, 30],
    ],
    [
      "a polyline with a height",
      `|0 LWPOLYLINE|8 0|90 2|70 0|38 40|10 10|20 0|10 60|20 0${facing(1, 0, 0)}`,
      [40, 10, 40, 60],
    ],
    [
      "an ellipse, whose axes are the world's",
      `|0 ELLIPSE|8 0|10 50|20 50|11 40|21 0|40 1${facing(0, -HALF, HALF)}`,
      [10, 21.716, 90, 78.284],
    ],
    [
      "with a long axis that rises",
      `|0 ELLIPSE|8 0|10 50|20 50|11 0|21 0|31 40|40 1${facing(0, 1, 0)}`,
      [10, 50, 90, 50],
    ],
    [
      "a line, which has no plane",
      `|0 LINE|8 0|10 10|20 10|11 60|21 20${facing(0, 0, -1)}`,
      [10, 10, 60, 20],
    ],
  ])("%s", async (_what, entity, box) => {
    const [x0, y0, x1, y1] = await boxOf(entity);
    [x0, y0, x1, y1].forEach((mm, i) => expect(mm).toBeCloseTo(box[i], 2));
  });

  it("a copy of a block, scaled differently, turned and from below", async () => {
    const blocks = "|0 BLOCK|2 B|10 0|20 0|0 LINE|8 0|10 0|20 0|11 10|21 5|0 ENDBLK";
    // (10, 5) scaled to (20, 5), turned to (-5, 20), moved by (-60, 0), mirrored to (65, 20).
    const copy = `|0 INSERT|8 0|2 B|10 -60|20 0|41 2|42 1|50 90${facing(0, 0, -1)}`;
    expect(await boxOf(copy, blocks)).toEqual([60, 0, 65, 20]);
  });

  it("a dimension, whose block is in the world's coordinates", async () => {
    const blocks = "|0 BLOCK|2 *D1|10 0|20 0|0 LINE|8 0|10 10|20 30|11 90|21 30|0 ENDBLK";
    const points = "|70 0|10 0|20 30|13 10|23 0|14 90|24 0";
    expect(await boxOf(`|0 DIMENSION|8 0|2 *D1${points}${facing(0, 0, -1)}`, blocks)).toEqual([
      10, 30, 90, 30,
    ]);
  });

  it("a text in paragraphs, whose place is the world's and whose letters are mirrored", async () => {
    const text = (more: string): Promise<number[]> => boxOf(`|0 MTEXT|8 0|10 50|20 50|40 10|71 7|1 L${more}`);
    const [x0, y0, x1, y1] = await text("");
    expect(await text(facing(0, 0, -1))).toEqual([100 - x1, y0, 100 - x0, y1]);
    // With a direction of its own it is upside down instead.
    expect(await text(`${facing(0, 0, -1)}|11 1|21 0|31 0`)).toEqual([x0, 100 - y1, x1, 100 - y0]);
  });
});

describe("a file", () => {
  const text = `0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n50\n21\n0\n0\nENDSEC\n0\nEOF\n`;
  const read = async (dxf: string): Promise<string[]> => shapesOf(await importDrawing("a.dxf", dxf));

  it("without EOF is read if its last section has an end", async () => {
    expect(await read(text.replace("0\nEOF\n", ""))).toEqual(["M0 0L50 0"]);
    await expect(read(text.replace("0\nENDSEC\n0\nEOF\n", ""))).rejects.toThrow(
      /a part of the file is missing/,
    );
    await expect(read(text.slice(0, text.indexOf("21\n")))).rejects.toThrow(/a part of the file is missing/);
  });

  it("without the end of a section is read", async () => {
    expect(await read(text.replace("0\nENDSEC\n", ""))).toEqual(["M0 0L50 0"]);
  });

  it.each(["\r\n", "\r", "\r\r\n"])("has lines that end with %j", async (end) => {
    expect(await read(text.replaceAll("\n", end))).toEqual(["M0 0L50 0"]);
  });

  it("of a million line ends is refused at once", { timeout: 10_000 }, async () => {
    await expect(read(`0\nSECTION\n2\nENTITIES\n${"\r".repeat(1_000_000)}x`)).rejects.toThrow(/is damaged/);
  });

  it("may have blanks before and behind its codes, and codes that no entity has", async () => {
    expect(
      await read(text.replaceAll(/^(\d+)$/gm, "   $1 ").replace("   8 ", "5001\nodd\n -5\n7\n   8 ")),
    ).toEqual(["M0 0L50 0"]);
  });

  it.each([
    [21, 304.8006],
    [22, 25.40005],
    [23, 914.4018],
    [12, 1e-6],
    [15, 10_000],
  ])("has the unit %i", async (unit, mm) => {
    const size = 1 / mm;
    const drawing = await importDrawing(
      "a.dxf",
      `0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n${unit}\n0\nENDSEC\n${text.replace("\n50\n", `\n${50 * size}\n`)}`,
    );
    expect(drawing.widthMm).toBeCloseTo(50, 3);
    expect(codes(drawing)).toEqual([]);
  });
});

describe("what is not drawn", () => {
  it("in paper space is counted, without the windows that show the model", async () => {
    const sheet = `${LINE.replace("|8 0", "|67 1|8 0")}|0 VIEWPORT|67 1|8 0|69 2|10 0|20 0`;
    const blocks = `|0 BLOCK|2 *Paper_Space0|10 0|20 0${LINE}|0 VIEWPORT|8 0|69 1|0 ENDBLK`;
    const { warnings } = await draw(`${LINE}${sheet}`, { blocks });
    expect(warnings).toMatchObject([{ code: "paper-space", count: 2 }]);
    // Without a model the sheet is the drawing.
    expect(codes(await draw(LINE.replace("|8 0", "|67 1|8 0")))).toEqual([]);
    expect(codes(await draw(`${LINE}|0 VIEWPORT|67 1|8 0|69 1|10 0|20 0`))).toEqual([]);
  });

  it("is the second colour of a fill", async () => {
    const corners = "|10 0|20 0|10 9|20 0|10 9|20 9";
    const hatch = `|0 HATCH|8 0|2 SOLID|70 1|71 0|91 1|92 3|72 0|73 1|93 3${corners}|97 0|75 0|76 1|98 0`;
    expect(codes(await draw(hatch))).toEqual([]);
    expect(codes(await draw(`${hatch}|450 1|453 2|463 0|63 5|463 1|63 2|470 LINEAR`))).toEqual([
      "gradient-fill",
    ]);
  });

  it("is a copy of size 0, which would be a dot", async () => {
    const blocks = `|0 BLOCK|2 B|10 0|20 0${LINE}|0 ENDBLK`;
    const drawing = await draw(`${LINE}|0 INSERT|8 0|2 B|10 9|20 9|41 0|42 0`, { blocks });
    expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
    expect(codes(drawing)).toEqual(["object-unreadable"]);
  });
});

it("Data of an application in an entity are no part of it", async () => {
  const data = "|102 {MYAPP|10 5|20 7|40 9|60 1|62 1|102 }";
  const plain = await draw(LINE);
  const drawing = await draw(LINE.replace("|8 0", `|8 0${data}`));
  expect(shapesOf(drawing)).toEqual(shapesOf(plain));
  expect(drawing.colors).toEqual(plain.colors);
});
