/**
 * The report lists everything that is not drawn as in a browser: all elements of SVG 1.1 and 2 and of HTML in SVG, and
 * the properties that may be written on them.
 */
import { describe, expect, it } from "vitest";
import { NOT_DRAWN_PROPERTIES, PRESENTATION } from "../../../src/import/svg/css/properties.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { codes, draw, page } from "../../support/import/shapes.js";

const TEXT = '<text x="9" y="9">a</text>';
const LINE = '<path d="M10 10H50" stroke="red"/>';

const DRAWN = "a circle ellipse g line path polygon polyline rect svg switch symbol text use";
/** Elements that browsers do not draw in place. Elements that refer to them are reported or drawn. */
const INVISIBLE = `clipPath color-profile cursor defs desc discard filter font font-face hatch linearGradient marker mask
  meshgradient metadata mpath pattern radialGradient script solidcolor stop style symbol title view
  WCB wcb plotdata eggbot EggBot MergeData namedview`;
const REPORTED: Record<string, string> = {
  "image-not-drawn": "image",
  "foreign-object": "foreignObject",
  "animation-ignored": "animate animateMotion animateTransform animateColor set",
  "not-supported": `audio canvas embed feBlend feImage flowRoot glyph iframe mesh missing-glyph object textArea textPath
    tref tspan unknown video hkern vkern altGlyph altGlyphDef glyphRef meshpatch frobnicate`,
};

/** The codes for an element of this name beside a line. */
const codesOf = async (tag: string): Promise<string[]> =>
  codes(await draw(`${LINE}<${tag} width="5" height="5" href="#none"/>`));

describe("elements", () => {
  it.each(INVISIBLE.trim().split(/\s+/))("%s draws nothing and needs no warning", async (tag) => {
    expect(await codesOf(tag)).toEqual([]);
  });

  it.each(
    Object.entries(REPORTED).flatMap(([code, tags]) =>
      tags
        .trim()
        .split(/\s+/)
        .map((tag) => [tag, code]),
    ),
  )("%s is reported as %s", async (tag, code) => {
    expect(await codesOf(tag)).toEqual([code]);
  });

  it.each(DRAWN.split(" "))("%s is drawn", async (tag) => {
    expect((await codesOf(tag)).filter((code) => code !== "reference-missing")).toEqual([]);
  });

  it("that are empty are reported for a filter, which can paint by itself", async () => {
    expect(codes(await draw(`${LINE}<g filter="url(#f)"/><g opacity=".5"/>`))).toEqual(["filter-ignored"]);
  });

  it("that stack accents on a letter are reported", async () => {
    expect(codes(await draw('<text x="9" y="9">a\u0301\u0302\u0303</text>'))).toContain("text-style-ignored");
    expect(codes(await draw('<text x="9" y="9">a\u0301\u0302b</text>'))).not.toContain("text-style-ignored");
  });

  it("in a text are reported, too", async () => {
    expect(codes(await draw('<text x="9" y="9">a<tref href="#x"/></text>'))).toEqual([
      "text-substituted",
      "text-not-drawn",
    ]);
  });
});

/** Properties that change nothing that a pen draws: colours between pixels, ends and corners of wide lines, hints. */
const WITHOUT_EFFECT = `clip color-interpolation color-interpolation-filters color-rendering cursor enable-background
  flood-color flood-opacity image-rendering isolation kerning lighting-color mask-type pointer-events shape-rendering
  stroke-linecap stroke-linejoin stroke-miterlimit text-overflow text-rendering font-size-adjust`;

/** All presentation attributes of SVG 2 (§6.6) and 1.1. */
const ALL = `alignment-baseline baseline-shift clip-path clip-rule color color-interpolation color-interpolation-filters
  cursor direction display dominant-baseline fill fill-opacity fill-rule filter flood-color flood-opacity font-family
  font-size font-size-adjust font-stretch font-style font-variant font-weight glyph-orientation-vertical image-rendering
  letter-spacing lighting-color marker-end marker-mid marker-start mask mask-type opacity overflow paint-order
  pointer-events shape-rendering stop-color stop-opacity stroke stroke-dasharray stroke-dashoffset stroke-linecap
  stroke-linejoin stroke-miterlimit stroke-opacity stroke-width text-anchor text-decoration text-overflow text-rendering
  transform transform-origin unicode-bidi vector-effect visibility white-space word-spacing writing-mode clip
  color-rendering enable-background kerning`;

describe("properties", () => {
  it("are each drawn, reported, or without effect on lines", () => {
    const known = new Set<string>([
      ...PRESENTATION,
      ...NOT_DRAWN_PROPERTIES.keys(),
      ...WITHOUT_EFFECT.split(/\s+/),
    ]);
    expect(ALL.split(/\s+/).filter((property) => !known.has(property))).toEqual([]);
  });

  it.each([...NOT_DRAWN_PROPERTIES])("%s is reported as %s", async (property, code) => {
    const isOfText = code === "text-style-ignored";
    const styledOn = async (style: string, body: string): Promise<string[]> =>
      codes(await draw(`<g ${style}>${body}</g>`)).filter((other) => other !== "text-substituted");
    const styled = (style: string): Promise<string[]> => styledOn(style, isOfText ? TEXT : LINE);
    // Nothing is missing where there is no text.
    if (isOfText) expect(await styledOn(`style="${property}:some 3px value"`, LINE)).toEqual([]);
    expect(await styled(`style="${property}:some 3px value"`)).toEqual([code]);
    expect(await styled(`${property}="some"`)).toEqual([code]);
    expect(await styled(`style="${property}:none"`)).toEqual([]);
  });

  it.each([
    ['mask="url(#m)"', "mask-ignored"],
    ['filter="blur(2px)"', "filter-ignored"],
    ['style="mix-blend-mode:multiply"', "blend-ignored"],
    ['paint-order="stroke"', "paint-order-ignored"],
    ['opacity="0.5"', "opacity-ignored"],
    ['stroke-opacity="50%"', "opacity-ignored"],
    ['stroke="rgb(0 0 0 / 0.3)"', "opacity-ignored"],
    ['color="#0008" stroke="currentColor"', "opacity-ignored"],
    ['clip-path="rect(1px 2px 3px 4px)"', "clip-ignored"],
    ['stroke="color-mix(in srgb, red, blue)"', "color-unknown"],
    ['fill="blu"', "color-unknown"],
    ['font-size="2ex"', "length-approximate"],
    ['stroke="url(#none)"', "paint-missing"],
    ['transform="rotate3d(1 1 1 45deg)"', "attribute-fault"],
  ])("%s is reported as %s", async (attributes, code) => {
    expect(codes(await draw(`<path d="M10 10H50" ${attributes}/>`))).toContain(code);
  });

  it.each(['font-weight="300"', 'style="font-weight:lighter"'])(
    "%s is reported for text, and nowhere else",
    async (attributes) => {
      const reported = async (body: string): Promise<boolean> =>
        codes(await draw(body)).includes("text-style-ignored");
      expect(await reported(`<text x="9" y="9" ${attributes}>a</text>`)).toBe(true);
      expect(await reported(`<g ${attributes}><g>${LINE}${TEXT}</g></g>`)).toBe(true);
      expect(await reported(`${TEXT}<g ${attributes}>${LINE}</g>`)).toBe(false);
      expect(await reported(`<path d="M10 10H50" stroke="red" ${attributes}/>${TEXT}`)).toBe(false);
    },
  );

  it.each([
    ["background-color:red", ["effect-ignored"]],
    ["background:url(a.png)", ["effect-ignored"]],
    ["background:#fff", []],
    ["background-color:transparent", []],
  ])("%s on the outermost element is reported as %j", async (style, expected) => {
    expect(codes(await importSvg(page(LINE, `style="${style}"`)))).toEqual(expected);
  });

  it("with a length relative to a font's letters are named, with a count", async () => {
    const [{ code, message }] = (await draw('<rect width="3ch" height="2" x="-1.5ex"/>'.repeat(2))).warnings;
    expect(code).toBe("length-approximate");
    expect(message).toMatch(/^2 lengths are in ex or ch/);
  });

  it("with a length of an unknown unit are named", async () => {
    const [{ code, message }] = (await draw(`${LINE}<rect width="3lh" height="2"/>`)).warnings;
    expect(code).toBe("attribute-fault");
    expect(message).toContain('"3lh" is not a length');
  });

  it("are not reported for solid colours, nor where nothing is drawn", async () => {
    expect(codes(await draw(`<g opacity="1" fill-opacity="100%">${LINE}</g><g opacity=".5"/>`))).toEqual([]);
  });
});

describe("colours", () => {
  it.each([
    ["lab(50% 40 59.5)", "#bf5700"],
    ["lch(52.2% 72.2 50)", "#cd561a"],
    ["oklab(59% 0.1 0.1)", "#c05d2b"],
    ["oklch(60% 0.15 50)", "#c46016"],
    ["color(display-p3 1 0.5 0)", "#ff7600"],
    ["color(srgb 1 0 0)", "#ff0000"],
  ])("%s is %s", async (color, hex) => {
    expect((await draw(`<path d="M0 0H9" stroke="${color}"/>`)).colors).toEqual([hex]);
  });
});

describe("markers", () => {
  it("are drawn at a path that only moves, and at one that turns back", async () => {
    const marker =
      '<marker id="m" markerUnits="userSpaceOnUse" overflow="visible"><path d="M0 0H1"/></marker>';
    const drawing = await draw(`${marker}<path d="M5 5" marker-start="url(#m)"/>`);
    expect([...drawing.paths.coords]).toEqual([5, 5, 6, 5]);
    expect(codes(drawing)).toEqual([]);
  });

  it.each([
    ['<svg overflow="visible">', "</svg>"],
    ["<g>", "</g>"],
  ])("inherit overflow from %s", async (open, close) => {
    const body = `${open}<marker id="m" overflow="inherit"><path d="M-9 0H1"/></marker>${close}<path d="M5 5H9" marker-end="url(#m)"/>`;
    expect([...(await draw(body)).paths.clip]).toEqual([-1, -1]);
  });
});

describe("references that lead nowhere", () => {
  it("from a gradient to something else leave it without colours", async () => {
    const stops = '<rect id="r"><stop stop-color="red"/></rect><linearGradient id="g" href="#r"/>';
    expect(
      (await draw(`<defs>${stops}</defs><path d="M0 0H9V9z" stroke="none" fill="url(#g)"/>`)).paths.count,
    ).toBe(0);
  });

  it("from a clip to itself are dropped and reported", async () => {
    const clips = `<clipPath id="a"><rect width="30" height="30" clip-path="url(#b)"/></clipPath>
      <clipPath id="b"><rect x="5" width="30" height="30" clip-path="url(#a)"/></clipPath>`;
    const drawing = await draw(`${clips}<path d="M0 5H90" clip-path="url(#a)"/>`);
    expect(codes(drawing)).toEqual(["clip-ignored"]);
    const xs = drawing.clips[0].coords.filter((_, i) => i % 2 === 0);
    expect([Math.min(...xs), Math.max(...xs)]).toEqual([5, 30]);
  });
});
