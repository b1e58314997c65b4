import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../../src/import/registry.js";
import type { ImportOptions } from "../../../../src/import/import-options.js";
import type { TextFont } from "../../../../src/import/text/text-font.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const ETX = "\u0003";

/** A frame of 100 × 100 mm, then the commands; letters of 4 × 8 mm by default: 6 mm from one to the next. */
const draw = (commands: string, options: ImportOptions = {}) =>
  importDrawing("a.plt", `IN;SP1;PU0,0;EA4000,4000;SI0.4,0.8;${commands}`, options);

/** Every letter is a box of the size of a plain capital, in the middle of a cell of the same width. */
const boxes: TextFont = {
  kind: "outline",
  layout: (line) => ({
    glyphs: [...line].map((char) => ({
      path: char === " " ? "" : `M0 0L${14 / 30} 0L${14 / 30} -0.7L0 -0.7Z`,
      x: 0,
      y: 0,
      advance: 14 / 30,
    })),
    missing: [],
  }),
};

/** The boxes as "left bottom" mm on the page, whose y points down from 100 at the plotter's 0. */
const feet = async (commands: string): Promise<string[]> =>
  shapesOf(await draw(commands, { text: "outline", font: boxes }))
    .slice(1)
    .flatMap((shape) => shape.split(/(?=M)/))
    .map((box) => /^M([^L]*)/.exec(box)![1]);

describe("labels of HPGL", () => {
  it("are at the pen's position in letters of the size that SI sets", async () => {
    const drawing = await draw(`PU400,800;LBH${ETX}`);
    const points = pointsOf(drawing, 1);
    const round = (values: number[]): number[] => values.map((v) => Math.round(v * 1e4) / 1e4);
    // An H of 4 × 8 mm at 10, 20.
    expect(round([Math.min(...points.map(([x]) => x)), Math.max(...points.map(([x]) => x))])).toEqual([
      10, 14,
    ]);
    expect(round([Math.min(...points.map(([, y]) => y)), Math.max(...points.map(([, y]) => y))])).toEqual([
      72, 80,
    ]);
    expect(drawing.paths.fill[1]).toBe(-1);
    expect(codes(drawing)).toEqual([]);
  });

  it("advance by one and a half letters, and leave the pen after the last one", async () => {
    expect(await feet(`PU400,800;LBab c${ETX}LBd${ETX}`)).toEqual(["10 80", "16 80", "28 80", "34 80"]);
  });

  it("are text up to their end, whatever commands they contain", async () => {
    expect(await feet(`PU400,800;LBPD;PU1${ETX}`)).toHaveLength(6);
    expect(await feet(`DT#;PU400,800;LBa;b#PU0,0;LBc#`)).toEqual(["10 80", "16 80", "22 80", "0 100"]);
    expect(await feet(`DTA;DT;PU400,800;LBA${ETX}`)).toHaveLength(1);
    expect(await feet(`PU400,800;LB12${ETX}`)).toHaveLength(2);
  });

  it("begin a new line two letters below", async () => {
    expect(await feet(`PU400,1600;LBa\r\nb${ETX}`)).toEqual(["10 60", "10 76"]);
    expect(await feet(`PU400,1600;LBa\nb${ETX}`)).toEqual(["10 60", "16 76"]);
    expect(await feet(`PU400,1600;LBa${ETX}CP;LBb${ETX}`)).toEqual(["10 60", "10 76"]);
    expect(await feet(`PU400,1600;CP2,-0.5;LBa${ETX}`)).toEqual(["22 68"]);
  });

  // "ab" is 10 wide and 8 high; the pen is at 50, 50 on the page.
  it.each([
    [1, "50 50"],
    [2, "50 54"],
    [3, "50 58"],
    [4, "45 50"],
    [5, "45 54"],
    [6, "45 58"],
    [7, "40 50"],
    [8, "40 54"],
    [9, "40 58"],
    [11, "52 46"],
    [13, "52 62"],
    [15, "45 54"],
    [17, "38 46"],
    [19, "38 62"],
  ])("are placed about the pen's position by LO%i", async (origin, first) => {
    expect((await feet(`LO${origin};PU2000,2000;LBab${ETX}`))[0]).toBe(first);
  });

  // Letters of 4 × 8 mm: 6 mm from one to the next, 16 from a line to the next.
  it("have extra space between letters and lines", async () => {
    expect(await feet(`ES0.5;PU400,800;LBab${ETX}LBc${ETX}`)).toEqual(["10 80", "19 80", "28 80"]);
    expect(await feet(`ES-0.5,0.25;PU400,1600;LBa\r\nbc${ETX}`)).toEqual(["10 60", "10 80", "13 80"]);
    expect(await feet(`ES0,0.25;PU400,1600;LBa${ETX}CP;LBb${ETX}`)).toEqual(["10 60", "10 80"]);
    expect(await feet(`ES1,1;ES;PU400,800;LBab${ETX}`)).toEqual(["10 80", "16 80"]);
    // The middle of "ab", which is 4 + 9 wide.
    expect(await feet(`ES0.5;LO4;PU2000,2000;LBab${ETX}`)).toEqual(["43.5 50", "52.5 50"]);
  });

  it.each([
    ["to the right", "DV;LO1", ["50 50", "56 50"], ["62 50"]],
    ["down", "DV1;LO3", ["50 58", "50 74"], ["50 90"]],
    ["to the left", "DV2;LO7", ["46 50", "40 50"], ["34 50"]],
    ["up", "DV3;LO1", ["50 50", "50 34"], ["50 18"]],
  ])("run %s, and the next label continues from there", async (_way, settings, first, next) => {
    expect(await feet(`${settings};PU2000,2000;LBab${ETX}LBc${ETX}`)).toEqual([...first, ...next]);
  });

  it("are placed as a whole column about the pen's position, which is unchanged if they do not begin there", async () => {
    // 24 high: 8, 16 apart.
    expect(await feet(`DV1;LO1;PU2000,2000;LBab${ETX}LBc${ETX}`)).toEqual(["50 34", "50 50", "50 50"]);
    expect(await feet(`DV1;LO5;PU2000,2000;LBab${ETX}`)).toEqual(["48 46", "48 62"]);
    expect(await feet(`DV3;LO9;PU2000,2000;LBab${ETX}`)).toEqual(["46 74", "46 58"]);
  });

  it("begin a new line clockwise from their direction, or the other way round", async () => {
    expect(await feet(`DV1;LO3;PU2000,2000;LBa\r\nb${ETX}`)).toEqual(["50 58", "44 58"]);
    expect(await feet(`DV1,1;LO3;PU2000,2000;LBa\r\nb${ETX}`)).toEqual(["50 58", "56 58"]);
    expect(await feet(`DV0,1;PU2000,2000;LBa\r\nb${ETX}`)).toEqual(["50 50", "50 34"]);
    expect(await feet(`DV2;LO7;PU2000,2000;LBa\r\nb${ETX}`)).toEqual(["46 50", "46 34"]);
    expect(await feet(`DV3;PU2000,2000;LBa\r\nb${ETX}`)).toEqual(["50 50", "56 50"]);
    expect(await feet(`DV1,1;IN;SP1;SI0.4,0.8;PU2000,2000;LBab${ETX}`)).toEqual(["50 50", "56 50"]);
  });

  it("have the given direction and slant", async () => {
    const box = async (commands: string): Promise<string> =>
      shapesOf(await draw(`${commands};PU2000,2000;LBa${ETX}`, { text: "outline", font: boxes }))[1];
    expect(await box("DI0,1")).toBe("M50 50L50 46L42 46L42 50Z");
    expect(await box("IP0,0,1000,2000;DR1,0.5")).toBe(await box("DI1,1"));
    expect(await box("SL1")).toBe("M50 50L54 50L62 42L58 42Z");
    expect(await box("IP0,0,4000,8000;SR2,3")).toBe("M50 50L52 50L52 44L50 44Z");
    expect(await box("DI0,1;DI")).toBe("M50 50L54 50L54 42L50 42Z");
  });

  it("are drawn with the pen up, by the pen in the holder, and not without one", async () => {
    const drawing = await draw(`SP2;PU400,800;LBH${ETX}SP0;PU800,800;LBH${ETX}`);
    expect(drawing.paths.count).toBe(2);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Pen 1", "Pen 2"]);
  });

  it("are reported if text is excluded, and if letters are missing", async () => {
    expect(codes(await draw(`PU400,800;LBH${ETX}PD500,800;`, { text: "none" }))).toEqual(["text-not-drawn"]);
    expect(codes(await draw(`PU400,800;LBA漢${ETX}`))).toEqual(["glyphs-missing"]);
  });
});
