/** A line on the edge of its own clip, mask or cover: half of it is visible in a browser, so the pen draws it whole. */
import { describe, expect, it } from "vitest";
import type { StrokeSet } from "../../../src/drawing/stroke-set.js";
import { lineCount, totalLength } from "../../../src/geometry/polyline.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";

const AS_WRITTEN: PrepareSettings = {
  ...DEFAULT_PREPARE,
  paper: { widthMm: 100, heightMm: 100 },
  landscape: false,
  marginMm: 0,
  fit: false,
  clipToMargins: false,
  outlineFills: false,
};

async function strokesOf(body: string, settings: Partial<PrepareSettings> = {}): Promise<StrokeSet> {
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">${body}</svg>`;
  return prepare(await importSvg(svg), { ...AS_WRITTEN, ...settings }).strokes;
}

/** Strokes and their length, 0.1 mm. */
async function drawn(
  body: string,
  settings: Partial<PrepareSettings> = {},
): Promise<[strokes: number, mm: number]> {
  const { xy, offsets } = await strokesOf(body, settings);
  const lines = { xy, offsets, tag: new Uint32Array(offsets.length - 1) };
  return [lineCount(lines), Math.round(10 * totalLength(lines)) / 10];
}

const CIRCLE = '<circle cx="50" cy="50" r="30"/>';
const REVERSED = '<path d="M80 50A30 30 0 1 0 20 50A30 30 0 1 0 80 50Z"/>';
/** Begins at the angle whose cosine is 0.6. */
const ELSEWHERE = '<path d="M68 74A30 30 0 0 1 32 26A30 30 0 0 1 68 74Z"/>';
const STAR = "50,10 60,70 10,30 90,30 40,70";
const WHOLE = [1, 188.5];

const stroked = (shape: string, attributes: string): string =>
  `<g fill="none" stroke="black" ${attributes}>${shape}</g>`;

describe("a line on the edge of its own clip", () => {
  it.each([
    ["the same circle", CIRCLE],
    ["the circle as two arcs, reversed", REVERSED],
    ["the circle as two arcs that begin elsewhere", ELSEWHERE],
    ["a circle 1 µm smaller", '<circle cx="50" cy="50" r="29.999"/>'],
  ])("is drawn whole: %s", async (_, clip) => {
    const clipPath = `<clipPath id="c">${clip}</clipPath>`;
    expect(await drawn(clipPath + stroked(CIRCLE, 'clip-path="url(#c)"'))).toEqual(WHOLE);
    const nested = `<clipPath id="o">${CIRCLE}</clipPath><clipPath id="c" clip-path="url(#o)">${clip}</clipPath>`;
    expect(await drawn(nested + stroked(CIRCLE, 'clip-path="url(#c)"'))).toEqual(WHOLE);
    const mask = `<mask id="c" fill="white">${clip}</mask>`;
    expect(await drawn(mask + stroked(CIRCLE, 'stroke-width="2" mask="url(#c)"'))).toEqual(WHOLE);
  });

  it("is drawn whole on the edge of a hole in a mask", async () => {
    const mask = `<mask id="c" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"><rect width="100" height="100" fill="white"/>${ELSEWHERE}</mask>`;
    expect(await drawn(mask + stroked(CIRCLE, 'mask="url(#c)"'))).toEqual(WHOLE);
  });

  it("is drawn whole where it crosses itself", async () => {
    const star = `<polygon points="${STAR}"/>`;
    const clipPath = `<clipPath id="c">${star}</clipPath>`;
    expect(await drawn(clipPath + stroked(star, 'clip-path="url(#c)"'))).toEqual([1, 329.7]);
  });

  it.each([
    ["circle(30px at 50px 50px) view-box", CIRCLE, WHOLE],
    ["circle()", CIRCLE, WHOLE],
    [`path('M68 74A30 30 0 0 1 32 26A30 30 0 0 1 68 74Z') view-box`, CIRCLE, WHOLE],
    ["inset(0)", '<rect x="33.333333" y="10.000004" width="33.333333" height="50"/>', [1, 166.7]],
    ["polygon(0 0, 100% 0, 50% 100%)", '<path d="M10 10H90L50 90Z"/>', [1, 258.9]],
    ["ellipse()", '<ellipse cx="50" cy="50" rx="40" ry="20" transform="rotate(33 50 50)"/>', [1, 193.7]],
  ])("is drawn whole: %s", async (value, shape, whole) => {
    const clipped = shape.replace("/>", ` style="clip-path: ${value}"/>`);
    expect(await drawn(stroked(clipped.replace(/"([^"]*'[^"]*)"/, '"$1"'), ""))).toEqual(whole);
  });

  it("is drawn whole where the clip or the line is scaled and turned to the same place", async () => {
    const unit = '<ellipse cx="0.5" cy="0.5" rx="0.5" ry="0.5"/>';
    const ofBox = `<clipPath id="c" clipPathUnits="objectBoundingBox">${unit}</clipPath>`;
    expect(await drawn(ofBox + stroked(CIRCLE, 'clip-path="url(#c)"'))).toEqual(WHOLE);
    const clip = `<clipPath id="c">${CIRCLE}</clipPath>`;
    const small =
      '<circle cx="-10" cy="3" r="1.5" transform="rotate(77 50 50) translate(250 -10) scale(20)"/>';
    expect(await drawn(clip + stroked(small, 'clip-path="url(#c)"'))).toEqual(WHOLE);
    const turned = `<clipPath id="c" transform="translate(50 50) rotate(201) scale(3 -3)"><circle r="10"/></clipPath>`;
    expect(await drawn(turned + stroked(CIRCLE, 'clip-path="url(#c)"'))).toEqual(WHOLE);
  });

  it("keeps the dashes that it has without the clip", async () => {
    const dashed = stroked(CIRCLE, 'stroke-dasharray="3 0.7 0.1 0.7" clip-path="url(#c)"');
    const clip = `<clipPath id="c">${ELSEWHERE}</clipPath>`;
    expect(await drawn(clip + dashed)).toEqual(await drawn(dashed.replace('clip-path="url(#c)"', "")));
  });

  it("is drawn whole where only a part of it is on the edge, and where it leaves the clip by less than a pen", async () => {
    const half = '<clipPath id="c"><path d="M20 50A30 30 0 0 1 80 50Z"/></clipPath>';
    const line = "M10 50H20A30 30 0 0 1 71.213 28.787";
    const [strokes, mm] = await drawn(half + stroked(`<path d="${line}L90 10"/>`, 'clip-path="url(#c)"'));
    expect(strokes).toBe(1);
    // Three quarters of the half circle.
    expect(mm).toBeCloseTo(0.75 * 30 * Math.PI, 1);
  });

  it("is drawn whole in a drawing that is enlarged after its clips were combined", async () => {
    const mask = `<mask id="c" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"><rect width="100" height="100" fill="white"/>${ELSEWHERE}</mask>`;
    const enlarged = { fit: true, paper: { widthMm: 600, heightMm: 600 } };
    const [strokes, mm] = await drawn(mask + stroked(CIRCLE, 'mask="url(#c)"'), enlarged);
    expect(strokes).toBe(1);
    expect(mm).toBeCloseTo(600 * Math.PI, 0);
  });
});

describe("a line beside the edge of its clip", () => {
  it.each([
    ["a circle 0.1 mm larger than a circle", '<circle cx="50" cy="50" r="30.1"/>', CIRCLE],
    ["a circle 0.05 mm larger than a circle", '<circle cx="50" cy="50" r="30.05"/>', CIRCLE],
    ["a square 0.01 mm larger than a square", "M9.99 9.99H90.01V90.01H9.99Z", "M10 10H90V90H10Z"],
  ])("is cut: %s", async (_, line, clip) => {
    const shape = (d: string): string => (d.startsWith("<") ? d : `<path d="${d}"/>`);
    const clipPath = `<clipPath id="c">${shape(clip)}</clipPath>`;
    expect(await drawn(clipPath + stroked(shape(line), 'clip-path="url(#c)"'))).toEqual([0, 0]);
  });

  it("is cut exactly at the edge where it crosses it, straight or curved", async () => {
    const clip = '<clipPath id="c"><path d="M20 20H80V60C60 50 40 50 20 60Z"/></clipPath>';
    const line = '<path d="M10 30L90 40M0 21H100M0 19.9H100M30 10Q40 70 50 10"/>';
    const { xy, offsets } = await strokesOf(clip + stroked(line, 'clip-path="url(#c)"'), { order: "none" });
    const ends = [...offsets.slice(0, -1)].flatMap((first, i) => [
      ...xy.subarray(2 * first, 2 * first + 2),
      ...xy.subarray(2 * offsets[i + 1] - 2, 2 * offsets[i + 1]),
    ]);
    const curveAt = 5 * (1 - Math.sqrt(2 / 3)) * 2;
    const expected = [20, 31.25, 80, 38.75, 20, 21, 80, 21, 30 + curveAt, 20, 50 - curveAt, 20];
    expect(ends).toHaveLength(expected.length);
    // The curve's chords are up to 0.02 mm beside it.
    for (const [k, at] of expected.entries()) expect(ends[k]).toBeCloseTo(at, at % 1 === 0 || k < 8 ? 6 : 1);
  });
});

describe("a line on the edge of its own cover", () => {
  const hidden = { hideCovered: true };

  it.each([
    ["the same circle", CIRCLE],
    ["the circle reversed", REVERSED],
    ["the circle begun elsewhere", ELSEWHERE],
  ])("is drawn whole: %s", async (_, cover) => {
    expect(await drawn(`${stroked(CIRCLE, "")}<g fill="white">${cover}</g>`, hidden)).toEqual(WHOLE);
    expect(await drawn(`<g fill="white" stroke="black">${CIRCLE}${cover}</g>`, hidden)).toEqual([2, 376.9]);
    // Drawn once where repeats are left out.
    const once = await drawn(`<g fill="white" stroke="black">${CIRCLE}${cover}</g>`, {
      ...hidden,
      dropRepeatsMm: 0.1,
    });
    expect(once).toEqual(WHOLE);
  });

  it("is drawn whole in a drawing of so many that it is hidden in parts", async () => {
    const rows = Array.from({ length: 400 }, (_, k) => {
      const at = `transform="translate(${5 * (k % 20)} ${5 * Math.floor(k / 20)}) scale(0.05)"`;
      return `<g ${at} fill="none" stroke="black">${CIRCLE}</g><g ${at} fill="white">${ELSEWHERE}</g>`;
    });
    const [strokes, mm] = await drawn(rows.join(""), { hideCovered: false, order: "none" });
    expect(strokes).toBe(400);
    expect(await drawn(rows.join(""), { ...hidden, order: "none" })).toEqual([400, mm]);
  });

  it("is drawn whole between two parts of the drawing that are hidden apart", async () => {
    const below = Array.from(
      { length: 400 },
      (_, k) => `<circle cx="${2.5 + 5 * (k % 20)}" cy="${2.5 + 5 * Math.floor(k / 20)}" r="2"/>`,
    );
    // The frame puts the edge of square and cover in the middle of the drawing.
    const circles = `<g fill="white" stroke="black">${below.join("")}</g>`;
    const lines = stroked('<path d="M0 0H50V50H0Z"/><path d="M0 0H100V100H0Z"/>', "");
    const cover = '<path fill="white" d="M0 0H50.001V50.001H0Z"/>';
    const [strokes, mm] = await drawn(circles + lines + cover, hidden);
    // 300 circles that are not covered, the square and the frame.
    expect(strokes).toBe(302);
    expect(mm).toBeCloseTo(600 + 300 * 4 * Math.PI, -2);
  });

  it("is drawn by both shapes that share it, and only there", async () => {
    const beside =
      '<g fill="white" stroke="black"><path d="M10 10H50V90H10Z"/><path d="M50 10H90V90H50Z"/></g>';
    expect(await drawn(beside, hidden)).toEqual([2, 480]);
  });

  it("is hidden where the cover goes beyond it by more than the curves' gaps", async () => {
    expect(
      (await drawn(`${stroked(CIRCLE, "")}<circle cx="50" cy="50" r="30.1" fill="white"/>`, hidden))[0],
    ).toBe(0);
  });
});
