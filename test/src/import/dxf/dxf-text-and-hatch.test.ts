import { describe, expect, it } from "vitest";
import type { ImportOptions } from "../../../../src/import/import-options.js";
import { boxes, drawDxf } from "../../../support/import/dxf.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const BOXES: ImportOptions = { text: "outline", font: boxes };

/** Corners of the boxes after the frame, in the order in which they were drawn. */
const letters = async (entities: string): Promise<string[]> =>
  shapesOf(await drawDxf(entities, BOXES))
    .slice(1)
    .flatMap((shape) => shape.split(/(?=M)/));

describe("TEXT of a DXF", () => {
  // Height 7 makes an em of 10: boxes of 5 × 7, 7 apart. On the page y points down from 100.
  const text = (more: string, written = "a"): Promise<string[]> =>
    letters(`0 TEXT\n8 0\n10 10\n20 20\n40 7\n1 ${written}${more}`);

  it("has its baseline on its point, and capitals as high as its height", async () => {
    expect(await text("")).toEqual(["M10 80L15 80L15 73L10 73Z"]);
    expect((await text("", "a b"))[1]).toBe("M24 80L29 80L29 73L24 73Z");
  });

  it("is widened by its width factor, turned, slanted, and mirrored", async () => {
    expect(await text("\n41 2")).toEqual(["M10 80L20 80L20 73L10 73Z"]);
    expect(await text("\n50 90")).toEqual(["M10 80L10 75L3 75L3 80Z"]);
    expect(await text("\n51 45")).toEqual(["M10 80L15 80L22 73L17 73Z"]);
    expect(await text("\n71 2")).toEqual(["M10 80L5 80L5 73L10 73Z"]);
    expect(await text("\n71 4")).toEqual(["M10 80L15 80L15 87L10 87Z"]);
  });

  // "ab" is 14 wide.
  it.each([
    ["centre", 1, 0, "M43 40L48 40L48 33L43 33Z"],
    ["right", 2, 0, "M36 40L41 40L41 33L36 33Z"],
    ["middle of all", 4, 0, "M43 42.3333L48 42.3333L48 35.3333L43 35.3333Z"],
    ["left bottom", 0, 1, "M50 37.6667L55 37.6667L55 30.6667L50 30.6667Z"],
    ["left middle", 0, 2, "M50 43.5L55 43.5L55 36.5L50 36.5Z"],
    ["right top", 2, 3, "M36 47L41 47L41 40L36 40Z"],
  ])("is aligned at its second point: %s", async (_name, halign, valign, first) => {
    expect((await text(`\n11 50\n21 60\n72 ${halign}\n73 ${valign}`, "ab"))[0]).toBe(first);
  });

  it("is fitted between two points: in size, or only in width", async () => {
    // 14 wide on 28: twice as large.
    expect((await text("\n11 38\n21 20\n72 3", "ab"))[1]).toBe("M24 80L34 80L34 66L24 66Z");
    expect((await text("\n11 38\n21 20\n72 5", "ab"))[1]).toBe("M24 80L34 80L34 73L24 73Z");
  });

  it("reads codes for symbols", async () => {
    const drawing = await drawDxf(
      "0 TEXT\n8 0\n10 10\n20 20\n40 5\n1 %%c20%%p0.1 %%uA%%u 45%%d \\U+00C4 %%065",
    );
    expect(codes(drawing)).toEqual(["text-substituted"]);
    expect(await text("", "%%uA%%u")).toHaveLength(1);
    expect(await text("", "50%%%")).toHaveLength(3);
  });

  it("is drawn in single strokes by default, in its colour, and reports its place", async () => {
    const drawing = await drawDxf("0 TEXT\n8 0\n62 1\n10 10\n20 20\n40 7\n1 H");
    expect(drawing.colors[drawing.paths.stroke[1]]).toBe("#ff0000");
    expect(drawing.paths.fill[1]).toBe(-1);
    const ys = pointsOf(drawing, 1).map(([, y]) => y);
    expect([Math.max(...ys), Math.min(...ys)].map((y) => Math.round(y * 1e6) / 1e6)).toEqual([80, 73]);
    expect(drawing.warnings.map(({ code }) => code)).toEqual(["text-substituted"]);
    expect(drawing.warnings[0].boxes[0][3]).toBeCloseTo(80, 6);
  });

  it("is reported if text is excluded, and if the font lacks its characters", async () => {
    const entity = "0 TEXT\n8 0\n10 10\n20 20\n40 7\n1 ";
    expect(codes(await drawDxf(`${entity}H`, { text: "none" }))).toEqual(["text-not-drawn"]);
    expect(codes(await drawDxf(`${entity}漢`))).toEqual(["glyphs-missing"]);
  });

  it("has the values of block attributes, but not their prompts", async () => {
    const blocks =
      "0 BLOCK\n8 0\n2 B\n70 2\n10 0\n20 0\n3 B\n0 ATTDEF\n8 0\n10 0\n20 0\n40 7\n1 x\n2 TAG\n3 Which?\n70 0\n0 ENDBLK";
    const insert = "0 INSERT\n8 0\n2 B\n66 1\n10 5\n20 5";
    const answer = (flags: number): string =>
      `0 ATTRIB\n8 0\n10 10\n20 20\n40 7\n1 a\n2 TAG\n70 ${flags}\n11 50\n21 60\n74 3\n0 SEQEND`;
    const drawing = await drawDxf(`${insert}\n${answer(0)}`, BOXES, blocks);
    expect(shapesOf(drawing).slice(1)).toEqual(["M50 47L55 47L55 40L50 40Z"]);
    expect(codes(drawing)).toEqual([]);
    expect((await drawDxf(`${insert}\n${answer(1)}`, BOXES, blocks)).paths.count).toBe(1);
  });
});

describe("MTEXT of a DXF", () => {
  const mtext = (written: string, more = ""): Promise<string[]> =>
    letters(`0 MTEXT\n8 0\n10 50\n20 60\n40 7${more}\n1 ${written}`);

  it("hangs from its point, lines spaced at 5/3 of its height", async () => {
    expect(await mtext("a\\Pb")).toEqual([
      "M50 47L55 47L55 40L50 40Z",
      "M50 58.6667L55 58.6667L55 51.6667L50 51.6667Z",
    ]);
    expect((await mtext("a\\Pb", "\n44 1.2"))[1]).toBe("M50 61L55 61L55 54L50 54Z");
  });

  // Two lines are 7 + 11.667 high.
  it.each([
    ["top centre", 2, "M46.5 47L51.5 47L51.5 40L46.5 40Z"],
    ["top right", 3, "M43 47L48 47L48 40L43 40Z"],
    ["middle left", 4, "M50 37.6667L55 37.6667L55 30.6667L50 30.6667Z"],
    ["bottom right", 9, "M43 28.3333L48 28.3333L48 21.3333L43 21.3333Z"],
  ])("is attached at its point: %s", async (_name, attachment, first) => {
    expect((await mtext("a\\Pb", `\n71 ${attachment}`))[0]).toBe(first);
  });

  it("turns by an angle or by the direction of its lines", async () => {
    const turned = "M57 40L57 35L50 35L50 40Z";
    expect(await mtext("a", "\n50 90")).toEqual([turned]);
    expect(await mtext("a", "\n11 0\n21 2")).toEqual([turned]);
  });

  it("breaks lines at its width, between words", async () => {
    // "aa bb" is 35 wide: five letters of 7.
    const feet = async (width: number): Promise<number[]> =>
      (await mtext("aa bb", `\n41 ${width}`)).map((box) => Math.round(Number(box.split(/[ L]/)[1])));
    expect(await feet(36)).toEqual([47, 47, 47, 47]);
    expect(await feet(34)).toEqual([47, 47, 59, 59]);
    expect(await feet(3)).toEqual([47, 47, 59, 59]);
    expect(await feet(0)).toEqual([47, 47, 47, 47]);
  });

  it.each([
    ["\\A1;{\\fArial|b0|i0|c0|p34;\\H2.5;ab}", 2],
    ["\\C1;a\\Lb\\l\\~c", 3],
    // Six letters and the bar of the first.
    ["\\S1/2; \\S+1^-2;", 7],
    ["\\{\\}\\\\", 3],
    ["%%c\\U+00C4^Ia", 3],
    ["\\pxqc;a", 1],
  ])("does not draw formatting codes: %s", async (written, count) => {
    expect(await mtext(written)).toHaveLength(count);
  });

  it("joins its pieces", async () => {
    expect(await mtext("c", "\n3 a\n3 b")).toHaveLength(3);
  });
});

describe("HATCH of a DXF", () => {
  const hatch = (paths: string, solid = 1): string =>
    `0 HATCH\n8 0\n62 3\n10 0\n20 0\n30 0\n2 SOLID\n70 ${solid}\n71 0\n${paths}\n75 0\n76 1\n98 1\n10 5\n20 5`;
  const square = (from: number, to: number): string =>
    `92 2\n72 0\n73 1\n93 4\n${[from, from, to, from, to, to, from, to].map((v, i) => `${10 + 10 * (i % 2)} ${v}`).join("\n")}\n97 0`;

  it("is a filled shape without a line, its islands left out", async () => {
    const drawing = await drawDxf(hatch(`91 2\n${square(10, 50)}\n${square(20, 30)}`));
    expect(shapesOf(drawing)[1]).toBe("M10 90L50 90L50 50L10 50ZM20 80L30 80L30 70L20 70Z");
    expect(drawing.paths.stroke[1]).toBe(-1);
    expect(drawing.colors[drawing.paths.fill[1]]).toBe("#00ff00");
    expect(drawing.paths.fillRule[1]).toBe(1);
    expect(codes(drawing)).toEqual([]);
  });

  it("reports that a pattern is drawn as one colour", async () => {
    expect(codes(await drawDxf(hatch(`91 1\n${square(10, 50)}`, 0)))).toEqual(["gradient-fill"]);
  });

  it("follows bulges", async () => {
    // A circle of two half circles about 50, 50.
    const path = "92 2\n72 1\n73 1\n93 2\n10 40\n20 50\n42 1\n10 60\n20 50\n42 1\n97 0";
    const points = pointsOf(await drawDxf(hatch(`91 1\n${path}`)), 1);
    for (const [x, y] of points) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(10, 4);
    expect(Math.min(...points.map(([, y]) => y))).toBeCloseTo(40, 2);
    expect(Math.max(...points.map(([, y]) => y))).toBeCloseTo(60, 2);
  });

  it("chains edges in either direction into one ring", async () => {
    const line = (...at: number[]): string => `72 1\n10 ${at[0]}\n20 ${at[1]}\n11 ${at[2]}\n21 ${at[3]}`;
    const path = ["92 1", "93 3", line(30, 10, 10, 10), line(30, 10, 30, 30), line(10, 10, 30, 30), "97 0"];
    expect(shapesOf(await drawDxf(hatch(`91 1\n${path.join("\n")}`)))[1]).toBe("M10 90L30 90L30 70L10 90Z");
  });

  it("reads arcs in both directions, ellipses, splines and whole circles", async () => {
    const chord = "72 1\n10 60\n20 50\n11 40\n21 50";
    const arc = (ccw: number, start: number, end: number): string =>
      `72 2\n10 50\n20 50\n40 10\n50 ${start}\n51 ${end}\n73 ${ccw}`;
    const top = async (path: string): Promise<number[]> => {
      const points = pointsOf(await drawDxf(hatch(`91 1\n92 1\n93 2\n${path}\n97 0`)), 1);
      for (const [x, y] of points) {
        if (Math.abs(y - 50) > 1e-6) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(10, 4);
      }
      return [Math.min(...points.map(([, y]) => y)), Math.max(...points.map(([, y]) => y))].map(Math.round);
    };
    expect(await top(`${arc(1, 0, 180)}\n${chord}`)).toEqual([40, 50]);
    // Clockwise angles are counted clockwise: from 180° back over the top would be −180° to 0.
    expect(await top(`${arc(0, 180, 360)}\n${chord}`)).toEqual([40, 50]);
    expect(await top(`${arc(0, 0, 180)}\n${chord}`)).toEqual([50, 60]);
    expect(await top(arc(1, 0, 360))).toEqual([40, 60]);

    const ellipse = "72 3\n10 50\n20 50\n11 20\n21 0\n40 0.5\n50 0\n51 360\n73 1";
    for (const [x, y] of pointsOf(await drawDxf(hatch(`91 1\n92 1\n93 1\n${ellipse}\n97 0`)), 1))
      expect(Math.hypot((x - 50) / 20, (y - 50) / 10)).toBeCloseTo(1, 4);

    const knots = [0, 0, 0, 0, 1, 1, 1, 1].map((knot) => `40 ${knot}`).join("\n");
    const spline = `72 4\n94 3\n73 0\n74 0\n95 8\n96 4\n${knots}\n10 10\n20 10\n10 10\n20 90\n10 90\n20 90\n10 90\n20 10\n97 0`;
    const drawing = await drawDxf(
      hatch(`91 1\n92 1\n93 2\n${spline}\n72 1\n10 90\n20 10\n11 10\n21 10\n97 0`),
    );
    expect(shapesOf(drawing)[1]).toBe("M10 90C10 10 90 10 90 90L10 90Z");
  });

  it("is skipped if its boundary is damaged", async () => {
    expect((await drawDxf(hatch("91 1\n92 1\n93 1\n72 1"))).paths.count).toBe(1);
    expect((await drawDxf("0 HATCH\n8 0")).paths.count).toBe(1);
  });
});

describe("colours of a DXF's index", () => {
  it("are the same for all kinds of entities", async () => {
    for (let index = 1; index < 256; index += index < 10 || index >= 249 ? 1 : 3) {
      const drawing = await drawDxf(
        `0 LINE\n8 0\n62 ${index}\n10 0\n20 0\n11 9\n21 9\n0 TEXT\n8 0\n62 ${index}\n10 1\n20 1\n1 H`,
      );
      expect(drawing.paths.stroke[2], `index ${index}`).toBe(drawing.paths.stroke[1]);
    }
  });
});
