/** Filled shapes that only colour the paper are not drawn, in the forms in which programs write them. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/import/svg/import-svg.js";
import { prepare } from "../../../../src/prepare/prepare.js";
import type { PrepareSettings } from "../../../../src/settings/prepare.js";
import { codes } from "../../../support/import/shapes.js";

const INK = '<path d="M10 10H60V60" stroke="black" fill="none"/>';

const page = (body: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">${body}</svg>`;

/** Drawn length in mm at true size. */
const drawnMm = async (svg: string, settings: Partial<PrepareSettings> = {}): Promise<number> =>
  prepare(await importSvg(svg), { fit: false, order: "none", outside: "allow", ...settings }).drawMm;

const FULL = 'width="100" height="100"';

const BACKGROUNDS: readonly (readonly [program: string, body: string])[] = [
  ["in %", `<rect width="100%" height="100%" fill="white"/>${INK}`],
  [
    "Figma",
    `<g clip-path="url(#c)"><rect ${FULL} fill="white"/>${INK}</g><clipPath id="c"><rect ${FULL} fill="white"/></clipPath>`,
  ],
  ["Figma's grey", `<rect ${FULL} fill="#F5F5F5"/>${INK}`],
  [
    "p5.js",
    `<g transform="scale(0.5)"><rect fill="rgb(255,255,255)" stroke="none" x="0" y="0" width="200" height="200"/></g>${INK}`,
  ],
  [
    "matplotlib",
    `<g id="figure_1"><g id="patch_1"><path d="M 0 100 L 100 100 L 100 0 L 0 0 z " style="fill: #ffffff"/></g><g id="axes_1"><path d="M 12 88 L 90 88 L 90 12 L 12 12 z" style="fill: #ffffff"/>${INK}</g></g>`,
  ],
  [
    "svglite",
    `<style>.svglite rect { fill: none; stroke: #000000; }</style><g class="svglite"><rect width="100%" height="100%" style="stroke: none; fill: #FFFFFF;"/>${INK}</g>`,
  ],
  [
    "Cairo",
    `<g id="surface1"><rect x="0" y="0" ${FULL} style="fill:rgb(100%,100%,100%);fill-opacity:1;stroke:none;"/>${INK}</g>`,
  ],
  [
    "R with Cairo",
    `<path fill-rule="nonzero" fill="rgb(100%, 100%, 100%)" fill-opacity="1" d="M 0 100 L 100 100 L 100 0 L 0 0 Z M 0 100"/>${INK}`,
  ],
  [
    "Processing",
    `<g style="fill:white; stroke:none;"><rect x="0" ${FULL} y="0" style="stroke:none;"/></g>${INK}`,
  ],
  ["Illustrator, by class", `<style>.st0{fill:#FFFFFF;}</style><rect class="st0" ${FULL}/>${INK}`],
  ["a polygon", `<polygon points="0,0 100,0 100,100 0,100" fill="snow"/>${INK}`],
  ["a path by relative commands", `<path d="m0 0h100v100h-100z" fill="#fff"/>${INK}`],
  ["turned by a quarter", `<rect ${FULL} fill="#fffef8" transform="rotate(90 50 50)"/>${INK}`],
  [
    "turned, larger than the page",
    `<rect x="-50" y="-50" width="200" height="200" fill="navy" transform="rotate(30 50 50)"/>${INK}`,
  ],
  ["a circle around the page", `<circle cx="50" cy="50" r="80" fill="tan"/>${INK}`],
  ["partly transparent", `<g opacity=".5"><rect ${FULL} fill="white" fill-opacity=".9"/></g>${INK}`],
  ["black", `<rect ${FULL}/>${INK}`],
  [
    "a gradient",
    `<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient><rect ${FULL} fill="url(#g)"/>${INK}`,
  ],
  ["rounded at its corners", `<rect ${FULL} rx="3" fill="teal"/>${INK}`],
  ["rounded to whole pixels", `<rect x=".3" y=".3" width="99.4" height="99.4" fill="gold"/>${INK}`],
  ["white inside margins", `<rect x="10" y="5" width="80" height="90" fill="ivory"/>${INK}`],
  [
    "a white card on a white page",
    `<rect ${FULL} fill="#fff"/><rect x="5" y="5" width="90" height="90" fill="#fefefe"/>${INK}`,
  ],
  [
    "two white axes side by side",
    `<rect width="50" height="100" fill="#fff"/><rect x="50" width="50" height="100" fill="#fff"/>${INK}`,
  ],
  ["by use", `<defs><rect id="r" ${FULL}/></defs><use href="#r" fill="white"/>${INK}`],
  ["painted again", `<rect ${FULL} fill="white"/>${INK}<rect ${FULL} fill="white"/>`],
];

describe("a background is not drawn, and said to be left out", () => {
  it.each(BACKGROUNDS)("%s", async (_program, body) => {
    const drawing = await importSvg(page(body));
    expect(await drawnMm(page(body))).toBeCloseTo(100, 6);
    expect(codes(drawing)).toContain("background");
  });

  it("also by colour, without a layer of its own", async () => {
    const drawing = await importSvg(page(`<rect ${FULL} fill="white"/>${INK}`));
    const { layers } = prepare(drawing, { layers: "stroke" });
    expect(layers.map(({ name }) => name)).toEqual(["#000000"]);
  });

  it("and is not hatched", async () => {
    const hatch = { spacingMm: 1, angleDeg: 0, cross: false };
    expect(await drawnMm(page(`<rect ${FULL} fill="white"/>${INK}`), { hatch })).toBeCloseTo(100, 6);
  });

  it("and what is drawn fills the paper when it is fitted", async () => {
    const paper = { widthMm: 120, heightMm: 120 };
    const { size } = prepare(await importSvg(page(`<rect ${FULL} fill="white"/>${INK}`)), {
      fit: true,
      marginMm: 10,
      paper,
    });
    expect(size.widthMm).toBeCloseTo(100, 6);
  });

  it("but hides what is painted before it, if hidden lines are left out", async () => {
    const body = `<path d="M5 5H95" stroke="red"/><rect ${FULL} fill="white"/>${INK}`;
    expect(await drawnMm(page(body))).toBeCloseTo(190, 6);
    expect(await drawnMm(page(body), { hideCovered: true })).toBeCloseTo(100, 6);
  });

  it("in a file without a page, if it lies around the drawing", async () => {
    const svg = `<svg xmlns="http://www.w3.org/2000/svg"><rect width="400" height="400" fill="beige"/><path d="M10 10H106" stroke="red"/></svg>`;
    expect(await drawnMm(svg)).toBeCloseTo(96 / (96 / 25.4), 6);
  });
});

const SQUARE = 'x="20" y="20" width="50" height="50"';

describe("a filled shape is drawn", () => {
  it.each([
    ["white with a stroke", `<rect ${FULL} fill="white" stroke="black"/>${INK}`, 500],
    [
      "white over a line, which it hides",
      `<path d="M0 30H100" stroke="red"/><rect ${SQUARE} fill="white"/>`,
      300,
    ],
    ["white on a dark page", `<rect ${FULL} fill="black"/><rect ${SQUARE} fill="white"/>`, 200],
    [
      "white on a coloured shape",
      `<rect ${SQUARE} fill="red"/><rect x="30" y="30" width="10" height="10" fill="white"/>`,
      240,
    ],
    ["grey inside margins", `<rect ${SQUARE} fill="#ebebeb"/>${INK}`, 300],
    ["yellow inside margins", `<rect ${SQUARE} fill="yellow"/>${INK}`, 300],
    ["in any colour, if there is nothing else", `<rect ${FULL} fill="teal"/>`, 400],
    ["white, if there is nothing else", `<rect ${SQUARE} fill="white"/>`, 200],
    [
      "around the page with a hole",
      `<path fill-rule="evenodd" d="M0 0H100V100H0ZM20 20H70V70H20Z"/>${INK}`,
      700,
    ],
    [
      "cut to a part of the page",
      `<clipPath id="c"><rect ${SQUARE}/></clipPath><rect ${FULL} fill="red" clip-path="url(#c)"/>${INK}`,
      300,
    ],
    ["as a frame 2 mm inside the page", `<rect x="2" y="2" width="96" height="96" fill="red"/>${INK}`, 484],
  ])("%s", async (_what, body, mm) => {
    const drawing = await importSvg(page(body));
    expect(await drawnMm(page(body))).toBeCloseTo(mm, 2);
    if (!body.includes('fill="black"')) expect(codes(drawing)).not.toContain("background");
  });
});

it("Nothing that is visible on screen is taken for background", { timeout: 20_000 }, async () => {
  const side = fc.integer({ min: 5, max: 60 });
  const color = fc.constantFrom("white", "#fefefe", "red", "#88a");
  const rect = fc.record({ x: side, y: side, width: side, height: side, color });
  await fc.assert(
    fc.asyncProperty(fc.array(rect, { minLength: 1, maxLength: 8 }), async (rects) => {
      const body = rects.map(
        ({ x, y, width, height, color: fill }) =>
          `<rect x="${x}" y="${y}" width="${width}" height="${height}" fill="${fill}"/>`,
      );
      const { background } = (await importSvg(page(`<rect ${FULL} fill="white"/>${body.join("")}${INK}`)))
        .paths;
      const isWhite = (k: number): boolean => rects[k].color === "white" || rects[k].color === "#fefefe";
      const isOver = (k: number, j: number): boolean =>
        rects[k].x < rects[j].x + rects[j].width &&
        rects[j].x < rects[k].x + rects[k].width &&
        rects[k].y < rects[j].y + rects[j].height &&
        rects[j].y < rects[k].y + rects[k].height;
      const expected: boolean[] = [];
      rects.forEach((_, k) => {
        const liesOnInk = rects.slice(0, k).some((_one, j) => !expected[j] && isOver(k, j));
        expected.push(isWhite(k) && !liesOnInk);
      });
      expect(Array.from(background ?? [], Boolean)).toEqual([true, ...expected, false]);
    }),
    { numRuns: 60 },
  );
});
