/** Masks that are plain light shapes are clips; others are reported. Checked against Chromium's pictures. */
import { describe, expect, it } from "vitest";
import { clipsOf, codes, draw } from "./support/shapes.js";

const SHAPE = '<rect x="20" y="10" width="40" height="20" mask="url(#m)"/>';
const WHITE = '<path d="M0 0H30V40z" fill="white" stroke="none"/>';

describe("a mask of light shapes", () => {
  it("clips to them, inside its own rectangle", () => {
    const body = `<mask id="m" maskUnits="userSpaceOnUse" x="1" y="2" width="40" height="20">${WHITE}</mask>${SHAPE}`;
    expect(clipsOf(body)).toEqual([
      [1, 2, 41, 2, 41, 22, 1, 22],
      [0, 0, 30, 0, 30, 40],
    ]);
    expect(codes(draw(body))).toEqual([]);
  });

  it("may be relative to the box of the shape", () => {
    const square = '<path d="M0 0H.5V1H0z" fill="white" stroke="none"/>';
    const units = 'maskContentUnits="objectBoundingBox" x="10%" y="0.25" width="0.5" height="50%"';
    expect(clipsOf(`<mask id="m" ${units}>${square}</mask>${SHAPE}`)).toEqual([
      [24, 15, 44, 15, 44, 25, 24, 25],
      [20, 10, 40, 10, 40, 30, 20, 30],
    ]);
  });

  it("has the fill rule of its shapes", () => {
    const body = `<mask id="m"><g/>${WHITE}</mask>`;
    expect(codes(draw(body + SHAPE))).toEqual(["mask-ignored"]);
    const odd = WHITE.replace("/>", ' fill-rule="evenodd"/>');
    expect([...draw(`<mask id="m">${odd}</mask>${SHAPE}`).clips.at(-1)!.rule]).toEqual([1]);
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
  ])("may contain %s", (_what, mask) => {
    expect(clipsOf(mask + SHAPE).at(-1)).toEqual([0, 0, 30, 0, 30, 40]);
    expect(codes(draw(mask + SHAPE))).toEqual([]);
  });

  it.each(["gray", "#fff8", "url(#g)"])("that is %s cuts, too, and is reported", (fill) => {
    const gradient = '<linearGradient id="g"><stop stop-color="white"/><stop offset="1"/></linearGradient>';
    const drawing = draw(`${gradient}<mask id="m">${WHITE.replace("white", fill)}</mask>${SHAPE}`);
    expect(drawing.clips).toHaveLength(1);
    expect(codes(drawing)).toEqual(["mask-ignored"]);
  });

  it("hides a shape if all of them are hidden", () => {
    expect(draw(`<mask id="m"><circle r="99" display="none"/></mask>${SHAPE}`).paths.count).toBe(0);
  });
});

describe("a mask of something else", () => {
  it.each([
    ["dark shapes", WHITE + WHITE.replace("white", "black")],
    ["lines", WHITE.replace('stroke="none"', 'stroke="white"')],
    ["a pattern", WHITE.replace("white", "url(#none)")],
    ["a picture", '<image width="9" height="9"/>'],
    ["text", '<text fill="white">a</text>'],
    ["masked shapes", WHITE.replace("<path", '<path mask="url(#m)"')],
  ])("is reported and not applied: %s", (_what, content) => {
    const drawing = draw(`<mask id="m">${content}</mask>${SHAPE}`);
    expect(drawing.clips).toEqual([]);
    expect(codes(drawing)).toEqual(["mask-ignored"]);
  });
});
