/** Masks of plain shapes and lines are clips; others are reported. Checked against Chromium's pictures. */
import { describe, expect, it } from "vitest";
import { VERB_CLOSE, VERB_MOVE, type Drawing } from "../../../../src/drawing/drawing.js";
import { clipsOf, codes, draw } from "../../../support/import/shapes.js";

const SHAPE = '<rect x="20" y="10" width="40" height="20" mask="url(#m)"/>';
const WHITE = '<path d="M0 0H30V40z" fill="white" stroke="none"/>';

describe("a mask of light shapes", () => {
  it("clips to them, inside its own rectangle", async () => {
    const body = `<mask id="m" maskUnits="userSpaceOnUse" x="1" y="2" width="40" height="20">${WHITE}</mask>${SHAPE}`;
    expect(await clipsOf(body)).toEqual([
      [1, 2, 41, 2, 41, 22, 1, 22],
      [0, 0, 30, 0, 30, 40],
    ]);
    expect(codes(await draw(body))).toEqual([]);
  });

  it("may be relative to the box of the shape", async () => {
    const square = '<path d="M0 0H.5V1H0z" fill="white" stroke="none"/>';
    const units = 'maskContentUnits="objectBoundingBox" x="10%" y="0.25" width="0.5" height="50%"';
    expect(await clipsOf(`<mask id="m" ${units}>${square}</mask>${SHAPE}`)).toEqual([
      [24, 15, 44, 15, 44, 25, 24, 25],
      [20, 10, 40, 10, 40, 30, 20, 30],
    ]);
  });

  it("has the fill rule of its shapes", async () => {
    const odd = WHITE.replace("/>", ' fill-rule="evenodd"/>');
    expect([...(await draw(`<mask id="m">${odd}</mask>${SHAPE}`)).clips.at(-1)!.rule]).toEqual([1]);
  });

  it.each([
    [
      "copies",
      `<defs><path id="p" d="M0 0H30V40z"/></defs><mask id="m" fill="white" stroke="none"><use href="#p"/></mask>`,
    ],
    [
      "shapes of any colour, by their opacity",
      `<mask id="m" style="mask-type:alpha">${WHITE.replace("white", "blue")}</mask>`,
    ],
    ["shapes that are not displayed", `<mask id="m"><circle r="99" display="none"/>${WHITE}</mask>`],
  ])("may contain %s", async (_what, mask) => {
    expect((await clipsOf(mask + SHAPE)).at(-1)).toEqual([0, 0, 30, 0, 30, 40]);
    expect(codes(await draw(mask + SHAPE))).toEqual([]);
  });

  it.each(["gray", "#fff8", "url(#g)"])("that is %s cuts, too, and is reported", async (fill) => {
    const gradient = '<linearGradient id="g"><stop stop-color="white"/><stop offset="1"/></linearGradient>';
    const drawing = await draw(`${gradient}<mask id="m">${WHITE.replace("white", fill)}</mask>${SHAPE}`);
    expect(drawing.clips).toHaveLength(1);
    expect(codes(drawing)).toEqual(["mask-ignored"]);
  });

  it("hides a shape if all of them are hidden", async () => {
    expect((await draw(`<mask id="m"><circle r="99" display="none"/></mask>${SHAPE}`)).paths.count).toBe(0);
  });
});

/** mm² of the innermost clip, whose rings are wound so that holes count as negative. */
function areaOf(drawing: Drawing): number {
  const { verbs, coords } = drawing.clips.at(-1)!;
  let twice = 0;
  let first = 0;
  for (let i = 0, at = 0; i < verbs.length; i++) {
    if (verbs[i] === VERB_MOVE) first = at;
    const next = verbs[i] === VERB_CLOSE ? first : at;
    if (i > 0 && verbs[i] !== VERB_MOVE)
      twice += coords[at - 2] * coords[next + 1] - coords[next] * coords[at - 1];
    if (verbs[i] !== VERB_CLOSE) at += 2;
  }
  return Math.abs(twice) / 2;
}

describe("a mask of several shapes and lines", () => {
  const square = (x: number, side: number, fill: string): string =>
    `<rect x="${x}" y="${x}" width="${side}" height="${side}" fill="${fill}" stroke="none"/>`;
  const whole = square(0, 40, "white");

  it.each([
    ["black shapes cut holes", whole + square(10, 10, "black") + square(15, 10, "black"), 1600 - 175],
    [
      "light shapes on top of black ones add",
      whole + square(10, 20, "black") + square(15, 10, "white"),
      1300,
    ],
    ["black shapes below light ones do nothing", square(10, 20, "black") + whole, 1600],
    ["light lines add their width", '<path d="M0 5H40" stroke="white" stroke-width="4"/>', 160],
    [
      "closed lines are rings",
      '<rect x="10" y="10" width="10" height="10" stroke="#fff" stroke-width="2"/>',
      80,
    ],
    ["black lines cut", whole + '<path d="M0 5H40" stroke="black" stroke-width="4"/>', 1440],
    [
      "groups pass on style and transform",
      `<g fill="white" stroke="none" transform="scale(2)"><rect width="20" height="20"/><g fill="black" transform="rotate(45)"><rect width="5" height="5"/></g></g>`,
      1600 - 50,
    ],
    [
      "copies of groups",
      `<defs><g id="g">${square(0, 10, "white")}${square(2, 4, "black")}</g></defs><use href="#g"/><use href="#g" x="20"/>`,
      168,
    ],
    [
      "clips inside",
      `<clipPath id="c"><rect width="10" height="40"/></clipPath><g clip-path="url(#c)">${whole}${square(5, 20, "black")}</g>`,
      300,
    ],
    [
      "masks inside",
      `<mask id="n" maskUnits="userSpaceOnUse" x="0" y="0" width="99" height="99">${square(0, 20, "white")}</mask><g mask="url(#n)">${whole}${square(10, 5, "black")}</g>`,
      375,
    ],
  ])("%s", async (_what, content, area) => {
    const drawing = await draw(`<mask id="m">${content}</mask>${SHAPE}`);
    expect(codes(drawing)).toEqual([]);
    expect(areaOf(drawing)).toBeCloseTo(area, 1);
  });

  it("hides everything if all of them are black", async () => {
    expect((await draw(`<mask id="m">${square(0, 99, "black")}</mask>${SHAPE}`)).paths.count).toBe(0);
  });

  it("stays quick with masks in masks that double at each level", { timeout: 60_000 }, async () => {
    const masks = Array.from({ length: 40 }, (_, i) => {
      const inner = `<g transform="scale(.9)" mask="url(#m${i + 1})">${whole}</g>`;
      return `<mask id="m${i}">${inner}<g transform="translate(1)">${inner}</g></mask>`;
    });
    const drawing = await draw(masks.join("") + SHAPE.replace("#m", "#m0"));
    expect(codes(drawing)).toEqual(["mask-ignored"]);
  });

  it.each([3000, 499])(
    "stays quick with %i shapes and thousands of uses",
    { timeout: 60_000 },
    async (count) => {
      const many = Array.from({ length: count }, (_, i) =>
        square(i % 40, 9, i % 2 === 0 ? "white" : "black"),
      );
      const uses = Array.from({ length: 3000 }, (_, i) => `<g transform="translate(${i / 99})">${SHAPE}</g>`);
      const drawing = await draw(`<mask id="m">${many.join("")}</mask><g>${uses.join("")}</g>`);
      expect(codes(drawing)).toContain("mask-ignored");
    },
  );
});

describe("a mask of something else", () => {
  it.each([
    ["transparent dark shapes", WHITE + WHITE.replace("white", "#0008")],
    ["dashed lines", '<path d="M0 9H30" stroke="white" stroke-width="4" stroke-dasharray="2"/>'],
    ["a filter", WHITE.replace("<path", '<path filter="url(#f)"')],
    ["a pattern", WHITE.replace("white", "url(#none)")],
    ["a picture", '<image width="9" height="9"/>'],
    ["text", '<text fill="white">a</text>'],
    ["masked shapes", WHITE.replace("<path", '<path mask="url(#m)"')],
  ])("is reported and not applied: %s", async (_what, content) => {
    const drawing = await draw(`<mask id="m">${content}</mask>${SHAPE}`);
    expect(drawing.clips).toEqual([]);
    expect(codes(drawing)).toEqual(["mask-ignored"]);
  });
});
