/**
 * The effect of the codes inside an MTEXT on its letters. Height 7 makes an em of 10: boxes of 5 × 7, 7 from
 * one to the next.
 */
import { describe, expect, it } from "vitest";
import type { ImportOptions } from "../../../../src/import/import-options.js";
import type { TextFont } from "../../../../src/import/text/text-font.js";
import { boxes, drawDxf } from "../../../support/import/dxf.js";
import { codes, shapesOf } from "../../../support/import/shapes.js";

/** The text hangs from 10, 10 of the page. */
const draw = (written: string, more = "", options: ImportOptions = { text: "outline", font: boxes }) =>
  drawDxf(`0 MTEXT\n8 0\n10 10\n20 90\n40 7${more}\n1 ${written}`, options);
/** Corners of letters and bars, in drawing order. */
const drawn = async (written: string, more = ""): Promise<string[]> =>
  shapesOf(await draw(written, more))
    .slice(1)
    .flatMap((shape) => shape.split(/(?=M)/));
/** Lower left corners. */
const feet = async (written: string, more = ""): Promise<string[]> =>
  (await drawn(written, more)).map((shape) => /^M([^L]*)/.exec(shape)![1]);

describe("formats inside an MTEXT", () => {
  it("set the height, or multiply it, until their brace ends", async () => {
    expect(await drawn("{\\H14;a}b")).toEqual(["M10 24L20 24L20 10L10 10Z", "M24 24L29 24L29 17L24 17Z"]);
    expect(await drawn("{\\H2x;a}b")).toEqual(await drawn("{\\H14;a}b"));
    expect(await feet("\\H2x;\\H0.5x;a")).toEqual(["10 17"]);
  });

  it("set width, slant, and the space between letters", async () => {
    expect(await drawn("\\W2;ab")).toEqual(["M10 17L20 17L20 10L10 10Z", "M24 17L34 17L34 10L24 10Z"]);
    expect(await drawn("\\Q45;a")).toEqual(["M10 17L15 17L22 10L17 10Z"]);
    expect(await feet("\\T2;ab")).toEqual(["10 17", "24 17"]);
  });

  it("put smaller letters on the base line, in the middle, or at the top of their line", async () => {
    const small = async (align: number): Promise<string> => (await feet(`\\A${align};a{\\H3.5;b}`))[1];
    expect(await Promise.all([0, 1, 2].map(small))).toEqual(["17 17", "17 15.25", "17 13.5"]);
  });

  it("space lines as their tallest letters need", async () => {
    // 5/3 of 14 below the first, whose letters are 7 high; then 5/3 of 7.
    expect(await feet("a\\P\\H14;b\\P\\H7;c")).toEqual(["10 17", "10 40.3333", "10 52"]);
    // Standing on its point; the page grows to where its top is.
    expect(await feet("\\H14;a\\P\\H7;b", "\n71 7")).toEqual(["10 14", "10 25.6667"]);
  });

  it("stack fractions over a bar, centred on each other", async () => {
    // The bar is 0.1 heights longer on both sides; parts are 0.4 heights apart.
    expect(await drawn("\\S12/3;")).toEqual([
      "M10.7 17L15.7 17L15.7 10L10.7 10Z",
      "M17.7 17L22.7 17L22.7 10L17.7 10Z",
      "M14.2 26.8L19.2 26.8L19.2 19.8L14.2 19.8Z",
      "M10 18.4L25.4 18.4",
    ]);
    expect(await feet("a\\S1/2;b")).toEqual(["10 26.8", "17.7 17", "17.7 26.8", "17 18.4", "25.4 26.8"]);
  });

  it("stack about the middle of the line, tolerances flush left and without a bar, others along a slash", async () => {
    expect(await feet("\\A1;a\\S+1^ -2;")).toEqual(["10 21.9", "17 17", "24 17", "17 26.8", "24 26.8"]);
    expect(await drawn("\\S1#2;")).toEqual([
      "M10 17L15 17L15 10L10 10Z",
      "M20.5 26.8L25.5 26.8L25.5 19.8L20.5 19.8Z",
      "M17 21.9L20.5 14.9",
    ]);
  });

  it("keep lines apart that stacks would overlap", async () => {
    // 4.9 below the first base line, then 0.4 heights, then 7.
    const [a, , , , b] = (await feet("\\A1;a\\S1/2;\\Pb")).map((foot) => Number(foot.split(" ")[1]));
    expect(b - a).toBeCloseTo(4.9 + 2.8 + 7, 3);
  });

  it("align paragraphs within the text's width, or within its longest line", async () => {
    const at = async (align: string, more: string): Promise<string> =>
      (await feet(`\\pxq${align};a\\Pabc`, more))[0];
    expect(await Promise.all(["l", "c", "r"].map((align) => at(align, "\n41 50")))).toEqual([
      "10 17",
      "31.5 17",
      "53 17",
    ]);
    expect(await Promise.all(["l", "c", "r"].map((align) => at(align, "")))).toEqual([
      "10 17",
      "17 17",
      "24 17",
    ]);
    expect(await at("r", "\n41 50\n71 2")).toBe("28 17");
  });

  it("indent first lines and all lines by the text's height", async () => {
    expect(await feet("\\pi-1,l2;aa bb\\Pc", "\n41 35")).toEqual([
      "17 17",
      "24 17",
      "24 28.6667",
      "31 28.6667",
      "17 40.3333",
    ]);
    expect(await feet("\\pi1;a\\P\\pi*;b")).toEqual(["17 17", "10 28.6667"]);
  });

  it("break lines between words of several formats, never within a stack", async () => {
    expect(await feet("aa {\\W2;bb}", "\n41 30")).toEqual(["10 17", "17 17", "10 28.6667", "24 28.6667"]);
    expect(await feet("a\\~a b", "\n41 25")).toEqual(["10 17", "24 17", "10 28.6667"]);
  });

  it("set colours by index and as RGB, each as its own shape, and restore the text's colour", async () => {
    const { paths, colors } = await draw("a{\\C1;b\\c65280;c}\\C7;d\\C256;e", "\n62 5");
    const fills = Array.from({ length: paths.count - 1 }, (_, i) => colors[paths.fill[i + 1]]);
    expect(fills).toEqual(["#0000ff", "#ff0000", "#00ff00", "#000000"]);
    expect(shapesOf(await draw("a{\\C1;b}c"))[1].match(/M/g)).toHaveLength(2);
  });

  it("are left out without their letters if they are unknown or incomplete", async () => {
    expect(await feet("a\\Zb\\M+1D7F0c")).toEqual(["10 17", "17 17", "24 17"]);
    expect(await feet("a\\Hb}}")).toEqual(["10 17", "17 17"]);
    expect(await feet("{{{a\\W;b\\H-3;c\\Q")).toEqual(["10 17", "17 17", "24 17"]);
    expect(await feet("\\S12;a\\L\\O\\kb")).toHaveLength(4);
    expect(await feet("\\")).toHaveLength(1);
  });

  it("choose the letters by the name of a font, and are drawn as single strokes by default", async () => {
    const asked: string[] = [];
    const font: TextFont = {
      ...boxes,
      layout: (line, style) => {
        asked.push(style.family);
        return boxes.layout(line, style);
      },
    };
    await draw("a{\\fBrush Script|b0|i0|c0|p66;b}", "\n7 NOTES", { text: "outline", font });
    expect(asked).toEqual(["NOTES", "Brush Script"]);
    expect(codes(await draw("{\\H2x;\\S1/2;}", "", {}))).toEqual(["text-substituted"]);
  });
});
