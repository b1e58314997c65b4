import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { PlotwrightError } from "../../../../src/errors.js";
import { openOutlineFont } from "../../../../src/import/text/outline-font.js";
import type { TextFont } from "../../../../src/import/text/text-font.js";
import { codes, draw, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const text = (body: string, attributes = 'x="10" y="50"'): string =>
  `<text stroke="none" fill="red" font-size="10" ${attributes}>${body}</text>`;

/** x0, y0, x1, y1 of everything drawn. */
function extent(drawing: Drawing): [number, number, number, number] {
  const points = Array.from({ length: drawing.paths.count }, (_, i) => pointsOf(drawing, i)).flat();
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

describe("single-stroke letters", () => {
  it("are on the baseline, capitals 0.7 em high, as strokes in the text's colour", async () => {
    const drawing = await draw(text("H"));
    const [x0, y0, x1, y1] = extent(drawing);
    expect([y0, y1]).toEqual([43, 50]);
    expect(x0).toBeGreaterThan(10);
    expect(x1).toBeLessThan(18);
    expect(drawing.colors).toEqual(["#ff0000"]);
    expect([...drawing.paths.stroke]).toEqual([0]);
    expect([...drawing.paths.fill]).toEqual([-1]);
  });

  it("report that they replace the file's font, and where", async () => {
    const { warnings } = await draw(text("Hi"));
    expect(warnings.map((warning) => warning.code)).toEqual(["text-substituted"]);
    expect(warnings[0].boxes[0][0]).toBeGreaterThan(10);
  });

  it("advance by their widths and by letter-spacing", async () => {
    const width = async (attributes: string): Promise<number> => {
      const [x0, , x1] = extent(await draw(text("HH", `x="10" y="50" ${attributes}`)));
      return x1 - x0;
    };
    expect((await width('letter-spacing="5"')) - (await width(""))).toBeCloseTo(5, 6);
  });

  it("are anchored at their middle and end", async () => {
    const at = async (anchor: string): Promise<number> =>
      extent(await draw(text("HHH", `x="50" y="50" text-anchor="${anchor}"`)))[0];
    const start = await at("start");
    expect(start - (await at("middle"))).toBeCloseTo((await at("middle")) - (await at("end")), 6);
    // Chromium begins a text that runs backwards at its anchor.
    expect(await at("middle" + '" letter-spacing="-99')).toBeCloseTo(
      await at("start" + '" letter-spacing="-99'),
    );
    const [x0, , x1] = extent(await draw(text("HHH", 'x="50" y="50" text-anchor="middle"')));
    expect((x0 + x1) / 2).toBeCloseTo(50, 6);
  });

  it("start again at a tspan's position and continue after its shift", async () => {
    const drawing = await draw(text('H<tspan x="30" y="70">H</tspan><tspan dy="-10">H</tspan>'));
    const feet = [0, 1, 2].map((i) => Math.max(...pointsOf(drawing, i).map(([, y]) => y)));
    expect(feet).toEqual([50, 70, 60]);
    expect(Math.min(...pointsOf(drawing, 1).map(([x]) => x))).toBeGreaterThan(30);
  });

  it("take one position each from lists", async () => {
    const drawing = await draw(text("HHH", 'x="10 30 60" y="50"'));
    const lefts = [0, 1, 2].map((i) => Math.min(...pointsOf(drawing, i).map(([x]) => x)));
    expect(lefts[1] - lefts[0]).toBeCloseTo(20, 6);
    expect(lefts[2] - lefts[1]).toBeCloseTo(30, 6);
  });

  it("turn by rotate and by transforms", async () => {
    const [x0, , x1] = extent(await draw(text("H", 'x="50" y="50" rotate="90"')));
    expect([x0, x1]).toEqual([50, 57]);
    const [, y0, , y1] = extent(await draw(text("H", 'transform="scale(2)" x="5" y="25"')));
    expect(y1 - y0).toBeCloseTo(14, 6);
  });

  it("follow the style of their span", async () => {
    const drawing = await draw(
      text('H<tspan fill="blue" font-size="20">H</tspan><tspan visibility="hidden">H</tspan>'),
    );
    expect(drawing.colors).toEqual(["#ff0000", "#0000ff"]);
    expect(drawing.paths.count).toBe(2);
    const ys = pointsOf(drawing, 1).map(([, y]) => y);
    expect(Math.max(...ys) - Math.min(...ys)).toBeCloseTo(14, 6);
  });

  it("collapse spaces, unless they are preserved", async () => {
    const left = async (body: string, attributes = ""): Promise<number> =>
      Math.min(...pointsOf(await draw(text(body, `x="10" y="50" ${attributes}`)), 1).map(([x]) => x));
    expect(await left("H \n\t H")).toBeCloseTo(await left("H H"), 9);
    expect(await left("  H H")).toBeCloseTo(await left("H H"), 9);
    expect(await left("H  H", 'xml:space="preserve"')).toBeGreaterThan((await left("H H")) + 3);
  });

  it("have accents, quotes and dashes", async () => {
    const drawing = await draw(text("ÄéçñÅ “–” ß…"));
    expect(codes(drawing)).toEqual(["text-substituted"]);
    expect(extent(await draw(text("É")))[1]).toBeLessThan(extent(await draw(text("E")))[1] - 1);
  });

  it("name the missing characters", async () => {
    const drawing = await draw(text("A漢字B"));
    expect(drawing.paths.count).toBe(2);
    const missing = drawing.warnings.find((warning) => warning.code === "glyphs-missing");
    expect(missing?.count).toBe(2);
    expect(missing?.message).toContain("漢");
  });

  it("are in script if the font is", async () => {
    expect(shapesOf(await draw(text("a", 'x="10" y="50" font-family="Brush Script"')))).not.toEqual(
      shapesOf(await draw(text("a"))),
    );
  });

  it("have every printable character of ASCII", async () => {
    const all = Array.from({ length: 94 }, (_, i) => `&#${33 + i};`).join("");
    const drawing = await draw(text(all, 'x="0" y="50" style="font-size: 1px"'));
    expect(drawing.paths.count).toBe(94);
    expect(codes(drawing)).toEqual(["text-substituted"]);
  });

  it("are left out if text is excluded, with a warning at its place", async () => {
    const drawing = await draw(text("Hi"), { text: "none" });
    expect(drawing.paths.count).toBe(0);
    expect(drawing.warnings[0].code).toBe("text-not-drawn");
    expect(drawing.warnings[0].boxes[0].map(Math.round)).toEqual([10, 40, 20, 50]);
  });
});

/** A font of one letter: a square of one em on the baseline. */
const square: TextFont = {
  kind: "outline",
  layout: (line) => ({
    glyphs: [...line].map(() => ({ path: "M0 0L1 0L1 -1L0 -1Z", x: 0, y: 0, advance: 1.5 })),
    missing: [],
  }),
};

describe("outlines of a font", () => {
  it("are filled shapes of the font's size", async () => {
    const drawing = await draw(text("ab"), { text: "outline", font: square });
    expect(shapesOf(drawing)).toEqual(["M10 50L20 50L20 40L10 40Z", "M25 50L35 50L35 40L25 40Z"]);
    expect([...drawing.paths.stroke]).toEqual([-1, -1]);
    expect([...drawing.paths.fill]).toEqual([0, 0]);
    expect(drawing.warnings).toEqual([]);
  });

  it("refuse bytes that are not a font", async () => {
    await expect(openOutlineFont(new Uint8Array([1, 2, 3, 4, 5, 6, 7, 8]))).rejects.toThrow(PlotwrightError);
  });

  it("are refused as a bad file if the font's measures are damaged", async () => {
    const file = createRequire(import.meta.url).resolve("bootstrap-icons/font/fonts/bootstrap-icons.woff");
    const bytes = new Uint8Array(readFileSync(file));
    const table = Buffer.from(bytes).indexOf("post");
    // Each entry of a WOFF's directory is a name, then the table's place in the file.
    bytes.set([0x7f, 0xff, 0xff, 0xff], table + 4);
    await expect(openOutlineFont(bytes)).rejects.toMatchObject({ name: "PlotwrightError", code: "bad-file" });
  });

  it("come from a real font file", async () => {
    const file = createRequire(import.meta.url).resolve("bootstrap-icons/font/fonts/bootstrap-icons.woff");
    const font = await openOutlineFont(new Uint8Array(readFileSync(file)));
    const drawing = await draw(text("\uf584\uf103A"), { text: "outline", font });
    expect(drawing.paths.count).toBe(2);
    // Icons are drawn in their em.
    const [x0, y0, x1, y1] = extent(drawing);
    expect(x0).toBeGreaterThanOrEqual(10);
    expect(x1).toBeLessThanOrEqual(30.01);
    expect(x1 - x0).toBeGreaterThan(14);
    expect(y1 - y0).toBeGreaterThan(5);
    expect(y1 - y0).toBeLessThanOrEqual(10.01);
    expect(codes(drawing)).toEqual(["glyphs-missing"]);
  });

  it("get stacked accents in the order that fonts expect: those below the letter first", async () => {
    const file = createRequire(import.meta.url).resolve("bootstrap-icons/font/fonts/bootstrap-icons.woff");
    const font = await openOutlineFont(new Uint8Array(readFileSync(file)));
    const { missing } = font.layout("\u0301\u0323a\u0300", { family: "" });
    expect(missing).toEqual(["\u0323", "\u0301", "a", "\u0300"]);
  });
});

describe("text on a path", () => {
  const PATHS = `
    <path id="level" stroke="none" d="M10 50H90"/>
    <path id="down" stroke="none" d="M50 10V90"/>
    <path id="short" stroke="none" d="M10 50H30"/>
    <path id="shifted" stroke="none" transform="translate(0 20)" d="M10 50H90"/>
    <path id="counted" stroke="none" pathLength="8" d="M10 50H90"/>
    <path id="two" stroke="none" d="M10 50H20M40 60H80"/>
    <circle id="round" stroke="none" cx="50" cy="50" r="30"/>`;
  const onPath = (body: string, attributes = "", textAttributes = ""): Promise<Drawing> =>
    draw(`${PATHS}${text(`<textPath ${attributes}>${body}</textPath>`, textAttributes)}`, {
      text: "outline",
      font: square,
    });

  it("follows it letter by letter, as on a line if the path is straight", async () => {
    const drawing = await onPath("ab", 'href="#level"');
    expect(shapesOf(drawing)).toEqual(["M10 50L20 50L20 40L10 40Z", "M25 50L35 50L35 40L25 40Z"]);
    expect(codes(drawing)).toEqual([]);
  });

  it("turns with it", async () => {
    expect(shapesOf(await onPath("a", 'href="#down"'))).toEqual(["M50 10L50 20L60 20L60 10Z"]);
  });

  it.each([
    ["a length", 'startOffset="20"', ["M30 50L40 50L40 40L30 40Z"]],
    ["a share of the path", 'startOffset="50%"', ["M50 50L60 50L60 40L50 40Z"]],
    ["a length in the path's own units", 'href="#counted" startOffset="2"', ["M30 50L40 50L40 40L30 40Z"]],
  ])("begins %s along", async (_what, attributes, shapes) => {
    const href = attributes.includes("href") ? "" : 'href="#level"';
    expect(shapesOf(await onPath("a", `${href} ${attributes}`))).toEqual(shapes);
  });

  it("is anchored about its start offset", async () => {
    const anchored = async (anchor: string): Promise<string[]> =>
      shapesOf(await onPath("ab", 'href="#level" startOffset="50%"', `text-anchor="${anchor}"`));
    // 30 wide with the gap after the second letter.
    expect((await anchored("middle"))[0]).toBe("M35 50L45 50L45 40L35 40Z");
    expect((await anchored("end"))[0]).toBe("M20 50L30 50L30 40L20 40Z");
  });

  it("takes x and dx along the path, dy across it, and no y", async () => {
    expect(shapesOf(await onPath("a", 'href="#down"', 'x="5" y="99" dx="1" dy="-2"'))).toEqual([
      "M52 16L52 26L62 26L62 16Z",
    ]);
  });

  it("leaves out letters whose middle is off the path", async () => {
    expect(shapesOf(await onPath("abc", 'href="#short"'))).toHaveLength(1);
    expect(shapesOf(await onPath("abc", 'href="#short" startOffset="-10"'))).toEqual([
      "M15 50L25 50L25 40L15 40Z",
    ]);
  });

  it("runs around a circle, upright outside of it, and over its seam", async () => {
    // Clockwise from the right: twelve letters of 15 on a path of 188.5.
    const drawing = await onPath("abcdefghijkl", 'href="#round" startOffset="25%" text-anchor="middle"');
    expect(drawing.paths.count).toBe(12);
    for (let i = 0; i < 12; i++) {
      const radii = pointsOf(drawing, i).map(([x, y]) => Math.hypot(x - 50, y - 50));
      // The letter's box is 7.5 before and 2.5 behind its middle, and 10 high.
      expect(radii[0]).toBeCloseTo(Math.hypot(30, 7.5), 2);
      expect(radii[1]).toBeCloseTo(Math.hypot(30, 2.5), 2);
      expect(radii[2]).toBeCloseTo(Math.hypot(40, 2.5), 2);
    }
  });

  it("is on the left side, as in browsers, and another side is reported", async () => {
    const drawing = await onPath("a", 'href="#level" side="right"');
    expect(shapesOf(drawing)).toEqual(["M10 50L20 50L20 40L10 40Z"]);
    expect(codes(drawing)).toEqual(["text-style-ignored"]);
  });

  it("may have its path in an attribute, which applies before a reference", async () => {
    expect(shapesOf(await onPath("a", 'path="M10 60H90"'))).toEqual(["M10 60L20 60L20 50L10 50Z"]);
    expect(shapesOf(await onPath("a", 'path="M10 60H90" href="#level"'))).toEqual([
      "M10 60L20 60L20 50L10 50Z",
    ]);
  });

  it("follows the shape's own transform, and jumps with its moves", async () => {
    expect(shapesOf(await onPath("a", 'href="#shifted"'))).toEqual(["M10 70L20 70L20 60L10 60Z"]);
    const turned =
      '<path id="t" stroke="none" d="M10 50H90" transform="rotate(90)" transform-origin="center"/>';
    const body = text('<textPath href="#t">a</textPath>', "");
    expect(shapesOf(await draw(turned + body, { text: "outline", font: square }))).toEqual([
      "M50 10L50 20L60 20L60 10Z",
    ]);
    expect(shapesOf(await onPath("ab", 'xlink:href="#two"'))[1]).toBe("M45 60L55 60L55 50L45 50Z");
  });

  it("is followed by the next text at the path's end", async () => {
    const drawing = await draw(`${PATHS}${text('<textPath href="#short">a</textPath>b', "")}`, {
      text: "outline",
      font: square,
    });
    expect(shapesOf(drawing)[1]).toBe("M30 50L40 50L40 40L30 40Z");
  });

  it("follows the style of inner spans, in single strokes too", async () => {
    const body = text('<textPath href="#down">H<tspan fill="blue" font-size="20">H</tspan></textPath>', "");
    const drawing = await draw(PATHS + body);
    expect(drawing.colors).toEqual(["#ff0000", "#0000ff"]);
    // Capitals are 0.7 em high, to the right of a path that points down.
    expect(extent(drawing).map((mm) => Math.round(mm * 1e6) / 1e6)[0]).toBe(50);
    expect(extent(drawing)[2]).toBeCloseTo(64, 6);
    expect(codes(drawing)).toEqual(["text-substituted"]);
  });

  it.each(['href="#nowhere"', "", 'href="other.svg#p"'])(
    "is reported if its path is missing: %j",
    async (href) => {
      const drawing = await onPath("along", href);
      expect(drawing.paths.count).toBe(0);
      expect(codes(drawing)).toContain("text-not-drawn");
    },
  );
});
