/** Letters that a font shapes together, and the heights stored in a font file. */
import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import type { TextFont } from "../../../../src/import/text/text-font.js";
import { codes, draw, pointsOf, shapes, shapesOf } from "../../../support/import/shapes.js";

const MARK = "\u0301";

/** A square for each letter, closer after "A"; a combining mark is a small square above the letter before it. */
const font: TextFont = {
  kind: "outline",
  metrics: {
    ascent: 0.8,
    descent: 0.2,
    xHeight: 0.5,
    subscript: 0.1,
    superscript: 0.4,
    underline: -0.1,
    strikeout: 0.3,
    lineThickness: 0.05,
  },
  layout: (line, { hasLigatures = true, hasKerning = true }) => ({
    glyphs: [...(hasLigatures ? line.replace("fi", "ﬁ") : line)].map((char, at, all) =>
      char === MARK
        ? { path: "M0 0H.2V.2H0Z", x: -0.7, y: -1, advance: 0, at }
        : {
            path: char === " " ? "" : "M0 0H1V-1H0Z",
            x: 0,
            y: 0,
            advance: hasKerning && all[at - 1] === "A" ? 0.9 : 1,
            at,
          },
    ),
    missing: [],
  }),
};

const text = (body: string, attributes = ""): string =>
  `<text x="10" y="50" font-size="10" stroke="none" fill="red" ${attributes}>${body}</text>`;
const drawn = (body: string): Promise<Drawing> => draw(body, { text: "outline", font });

/** x0, y0, x1, y1 of shape `index`, in tenths of a mm. */
function boxOf(drawing: Drawing, index: number): number[] {
  const points = pointsOf(drawing, index);
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)].map((mm) =>
    Math.round(10 * mm),
  );
}

describe("kerning", () => {
  it.each([
    ["auto", 290],
    ["none", 300],
  ])("%s places the third letter at %d", async (value, left) => {
    expect(boxOf(await drawn(text("AVA", `style="font-kerning:${value}"`)), 2)[0]).toBe(left);
  });
});

describe("letters with separate shifts", () => {
  it("stay as close as the font sets them", async () => {
    const lefts = async (attributes: string): Promise<number[]> =>
      await Promise.all([0, 1, 2].map(async (i) => boxOf(await drawn(text("AVA", attributes)), i)[0]));
    expect(await lefts("")).toEqual([100, 200, 290]);
    expect(await lefts('dx="0 5"')).toEqual([100, 250, 340]);
    expect(await lefts('dy="1 0 1"')).toEqual([100, 200, 290]);
    expect(await lefts('rotate="0"')).toEqual([100, 200, 290]);
  });

  it("are not joined into a ligature", async () => {
    expect((await drawn(text("fi"))).paths.count).toBe(1);
    expect((await drawn(text("fi", 'dx="0 1"'))).paths.count).toBe(2);
    expect((await drawn(text("fi", 'letter-spacing="1"'))).paths.count).toBe(2);
  });

  it("take their marks with them", async () => {
    const plain = await drawn(text(`e${MARK}`));
    expect(boxOf(plain, 1)).toEqual([130, 400, 150, 420]);
    // A quarter turn about the letter's origin at 10, 50.
    const turned = await drawn(text(`e${MARK}`, 'rotate="90 0"'));
    expect(boxOf(turned, 0)).toEqual([100, 500, 200, 600]);
    expect(boxOf(turned, 1)).toEqual([180, 530, 200, 550]);
  });

  it("are not turned by a faulty list of angles", async () => {
    expect(shapesOf(await drawn(text("ab", 'rotate="5mm 10"')))).toEqual(shapesOf(await drawn(text("ab"))));
  });

  it("keep accents that are written apart on their letters, in single strokes too", async () => {
    expect(await shapes(text(`e${MARK}x`))).toEqual(await shapes(text("\u00e9x")));
    expect((await shapes(text(`e${MARK}x`, 'dx="0 0 3"'))).length).toBe(2);
  });
});

describe("a font's own heights", () => {
  it.each([
    ["hanging", 564],
    ["central", 530],
    ["middle", 525],
    ["text-before-edge", 580],
    ["text-after-edge", 480],
  ])("place the baseline %s", async (baseline, bottom) => {
    expect(boxOf(await drawn(text("a", `dominant-baseline="${baseline}"`)), 0)[3]).toBe(bottom);
  });

  it("place subscripts, superscripts and decorations", async () => {
    expect(boxOf(await drawn(text('<tspan baseline-shift="super">a</tspan>')), 0)[3]).toBe(460);
    expect(boxOf(await drawn(text('<tspan baseline-shift="sub">a</tspan>')), 0)[3]).toBe(510);
    expect(boxOf(await drawn(text("a", 'text-decoration="underline"')), 0)).toEqual([100, 508, 200, 513]);
    expect(boxOf(await drawn(text("a", 'text-decoration="line-through"')), 0)).toEqual([100, 468, 200, 473]);
  });

  it("give a text its box", async () => {
    const clip =
      '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="1" height=".5"/></clipPath>';
    const { clips } = await drawn(clip + text("a", 'clip-path="url(#c)"'));
    expect([...clips[0].coords]).toEqual([10, 42, 20, 42, 20, 47, 10, 47]);
  });
});

describe("properties that a text does not inherit", () => {
  it("include the baseline shift", async () => {
    const grouped = `<g baseline-shift="super" alignment-baseline="hanging">${text("a")}</g>`;
    expect(shapesOf(await drawn(grouped))).toEqual(shapesOf(await drawn(text("a"))));
    const shifted = text("a", 'baseline-shift="super"');
    expect(shapesOf(await drawn(shifted))).toEqual(shapesOf(await drawn(text("a"))));
  });

  it("include a writing mode of one span: the whole text has one", async () => {
    expect(shapesOf(await drawn(text('<tspan writing-mode="tb">ab</tspan>')))).toEqual(
      shapesOf(await drawn(text("ab"))),
    );
  });

  it("include the position of a textPath", async () => {
    const on = async (attributes: string): Promise<string[]> =>
      shapesOf(
        await drawn(
          `<path id="p" stroke="none" d="M10 50H90"/><text font-size="10" stroke="none" fill="red"><textPath href="#p" ${attributes}>a</textPath></text>`,
        ),
      );
    expect(await on('x="20" y="3" dx="4"')).toEqual(await on(""));
  });
});

describe("text as a clip", () => {
  const clipped =
    '<clipPath id="c"><text y="50" font-size="10">ab</text></clipPath><rect width="90" height="90" fill="red" clip-path="url(#c)"/>';

  it("cuts to the outlines of its letters", async () => {
    const drawing = await drawn(clipped);
    expect([...drawing.clips[0].coords]).toEqual([
      0, 50, 10, 50, 10, 40, 0, 40, 10, 50, 20, 50, 20, 40, 10, 40,
    ]);
    expect(codes(drawing)).toEqual([]);
  });

  it("reports the styles that the font does not have", async () => {
    const face = { family: "Square", isBold: false, isItalic: false };
    const bold = clipped.replace("ab", '<tspan font-weight="bold">ab</tspan>');
    const drawing = await draw(bold, { text: "outline", font: { ...font, face } });
    expect(codes(drawing)).toEqual(["text-style-ignored"]);
    expect(drawing.warnings[0].message).toContain("bold");
  });

  it("is reported where letters have no outlines", async () => {
    expect(codes(await draw(clipped))).toEqual(["clip-text", "empty-drawing"]);
  });
});

describe("the styles of a text's spans that are not drawn", () => {
  const face = { family: "Plain Sans", isBold: false, isItalic: false };
  const messages = async (body: string): Promise<string[]> =>
    (await draw(body, { text: "outline", font: { ...font, face } })).warnings.map(({ message }) => message);

  it.each([
    ['filter="url(#f)"', "filter effect is ignored"],
    ['clip-path="url(#c)"', "(url(#c) on tspan)"],
    ['mask="url(#m)"', "mask is not fully drawn"],
    ['opacity=".5"', "partly transparent"],
    ['font-weight="bold"', "(bold)"],
    ['font-style="italic"', "(italic)"],
    ['font-family="Courier, monospace"', "(font Courier)"],
  ])("are reported: %s", async (attributes, expected) => {
    expect(await messages(text(`a<tspan ${attributes}>b</tspan>`))).toEqual([
      expect.stringContaining(expected),
    ]);
  });

  it("do not include a family that is the font's own", async () => {
    expect(await messages(text("a", "font-family=\"'plain sans', serif\""))).toEqual([]);
  });
});
