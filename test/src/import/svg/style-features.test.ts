/** Small SVGs, one per feature of colours, CSS and visibility. */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/import/svg/import-svg.js";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { codes, draw, page, shapes } from "../../../support/import/shapes.js";

const PATH = 'd="M0 0h1"';

/** The stroke colour of each shape; "-" for none. */
const strokes = ({ paths, colors }: Drawing): string[] =>
  Array.from(paths.stroke, (color) => (color < 0 ? "-" : colors[color]));
const fills = ({ paths, colors }: Drawing): string[] =>
  Array.from(paths.fill, (color) => (color < 0 ? "-" : colors[color]));

describe("colours", () => {
  it.each([
    ["#F00", "#ff0000"],
    ["#ff000080", "#ff0000"],
    ["red", "#ff0000"],
    ["ReD", "#ff0000"],
    ["rgb(255, 128, 0)", "#ff8000"],
    ["rgb(100%, 50%, 0%)", "#ff8000"],
    ["rgb(255 128 0 / 50%)", "#ff8000"],
    ["rgba(1,2,3,.5)", "#010203"],
    ["hsl(120, 100%, 25%)", "#008000"],
    ["hsl(0.5turn 100% 50%)", "#00ffff"],
    ["hwb(0 0% 0%)", "#ff0000"],
    ["currentColor", "#00ff00"],
    ["rgba(0,0,0,0)", "-"],
    ["transparent", "-"],
    ["none", "-"],
  ])("reads the stroke %s", async (color, expected) => {
    const drawing = await draw(`<path ${PATH} fill="blue" color="lime" stroke="${color}"/>`);
    expect(strokes(drawing)).toEqual([expected]);
  });

  it("keeps the inherited value if a colour is malformed", async () => {
    expect(strokes(await draw(`<path ${PATH} stroke="#ggg"/>`))).toEqual(["#000000"]);
  });

  it("lists each colour once, in order of first use", async () => {
    const drawing = await draw(
      `<path ${PATH} stroke="blue"/><path ${PATH} stroke="red"/><path ${PATH} stroke="#00F" fill="red"/>`,
    );
    expect(drawing.colors).toEqual(["#0000ff", "#ff0000"]);
    expect(fills(drawing)).toEqual(["-", "-", "#ff0000"]);
  });

  it("draws a gradient stroke in its first colour, found through href, and reports it", async () => {
    const drawing = await draw(
      `<defs><linearGradient id="a"><stop stop-color="teal"/><stop stop-color="red"/></linearGradient><linearGradient id="b" xlink:href="#a"/></defs><path d="M0 0l9 9" stroke="url(#b)"/>`,
    );
    expect(strokes(drawing)).toEqual(["#008080"]);
    expect(codes(drawing)).toEqual(["gradient-stroke"]);
    expect(drawing.warnings[0].boxes).toEqual([[0, 0, 0, 0]]);
  });

  it("uses the fallback of a missing gradient", async () => {
    expect(strokes(await draw(`<path ${PATH} stroke="url(#none) red"/>`))).toEqual(["#ff0000"]);
  });

  it("warns of a missing gradient without fallback", async () => {
    expect(codes(await draw(`<path ${PATH} stroke="url(#none)"/>`))).toContain("paint-missing");
  });
});

describe("the cascade", () => {
  const stroke = async (style: string, element: string): Promise<string[]> =>
    strokes(await draw(`<style>${style}</style>${element}`));

  it.each([
    ["a class", ".a{stroke:red}", `<path class="b a" ${PATH}/>`],
    ["an id", "#a{stroke:red}", `<path id="a" ${PATH}/>`],
    ["a type", "path{stroke:red}", `<path ${PATH}/>`],
    ["everything", "*{stroke:red}", `<path ${PATH}/>`],
    ["a list", ".x,.a{stroke:red}", `<path class="a" ${PATH}/>`],
    ["an attribute", "[data-x='1']{stroke:red}", `<path data-x="1" ${PATH}/>`],
    ["a child", "g > .a{stroke:red}", `<g><path class="a" ${PATH}/></g>`],
    ["a descendant", ".g path{stroke:red}", `<g class="g"><g><path ${PATH}/></g></g>`],
    ["a sibling", ".g + path{stroke:red}", `<g class="g"/><path ${PATH}/>`],
    [":not", "path:not(.b){stroke:red}", `<path ${PATH}/>`],
    [":nth-child", "path:nth-child(2){stroke:red}", `<g><g/><path ${PATH}/></g>`],
    [":first-child", "g path:first-child{stroke:red}", `<g><path ${PATH}/></g>`],
    ["id over class", "#a{stroke:red}.b{stroke:blue}", `<path id="a" class="b" ${PATH}/>`],
    ["class over type, whatever the order", ".b{stroke:red}path{stroke:blue}", `<path class="b" ${PATH}/>`],
    ["the later of equals", ".a{stroke:blue}.b{stroke:red}", `<path class="b a" ${PATH}/>`],
    ["a rule over an attribute", ".a{stroke:red}", `<path class="a" stroke="blue" ${PATH}/>`],
    ["style over rules", "#a{stroke:blue}", `<path id="a" style="stroke:red" ${PATH}/>`],
    ["!important over style", "path{stroke:red!important}", `<path style="stroke:blue" ${PATH}/>`],
    [
      "!important in style over all",
      "#a{stroke:blue !important}",
      `<path id="a" style="stroke:red !important" ${PATH}/>`,
    ],
    ["an attribute over what is inherited", "", `<g stroke="blue"><path stroke="red" ${PATH}/></g>`],
    ["what is inherited through groups", "", `<g style="stroke:red"><g><path ${PATH}/></g></g>`],
    ["inherit", ".g{stroke:red}path{stroke:inherit}", `<g class="g"><path stroke="blue" ${PATH}/></g>`],
    ["variables", ":root{--pen:red}path{stroke:var(--pen)}", `<path ${PATH}/>`],
    ["fallbacks of variables", "path{stroke:var(--none, red)}", `<path ${PATH}/>`],
    ["@media screen", "@media screen{path{stroke:red}}", `<path ${PATH}/>`],
    ["no @media print", "path{stroke:red}@media print{path{stroke:blue}}", `<path ${PATH}/>`],
    [
      "no dark mode",
      "path{stroke:red}@media (prefers-color-scheme:dark){path{stroke:blue}}",
      `<path ${PATH}/>`,
    ],
    ["comments", "/* a */path{/* b */stroke:/* c */red}", `<path ${PATH}/>`],
    [
      "rules after a broken one",
      "path{stroke:blue;;x;:y} p..q{fill:red} .a{stroke:red}",
      `<path class="a" ${PATH}/>`,
    ],
  ])("obeys %s", async (_name, style, element) => {
    expect(await stroke(style, element)).toEqual(["#ff0000"]);
  });

  it.each([
    ["odd", [1, 3, 5, 7]],
    ["2n", [2, 4, 6]],
    ["3n+2", [2, 5]],
    ["-n+3", [1, 2, 3]],
    ["4", [4]],
    [" n + 6 ", [6, 7]],
  ])("counts children: :nth-child(%s)", async (formula, expected) => {
    const body = `<style>path:nth-child(${formula}){stroke:red}</style><g>${`<path ${PATH}/>`.repeat(7)}</g>`;
    const red = strokes(await draw(body)).flatMap((color, i) => (color === "#ff0000" ? [i + 1] : []));
    expect(red).toEqual(expected);
  });

  it("counts children from the end", async () => {
    const body = `<style>path:nth-last-child(2),path:last-child{stroke:red}</style><g>${`<path ${PATH}/>`.repeat(4)}</g>`;
    expect(strokes(await draw(body))).toEqual(["#000000", "#000000", "#ff0000", "#ff0000"]);
  });

  it("counts among 50 000 siblings without counting them each time", async () => {
    const body = `<style>path:nth-child(2n) + path{stroke:red}</style><g>${`<path ${PATH}/>`.repeat(50_000)}</g>`;
    expect(strokes(await draw(body)).filter((color) => color === "#ff0000").length).toBe(24_999);
  });

  it("reads style sheets in CDATA, and those at the end", async () => {
    expect(
      strokes(await draw(`<path ${PATH}/><style><![CDATA[ g > x, path { stroke: red } ]]></style>`)),
    ).toEqual(["#ff0000"]);
  });

  it("reads geometry from CSS", async () => {
    expect(await shapes("<style>rect{width:4px;height:3px;x:1px}</style><rect/>")).toEqual([
      "M1 0L5 0L5 3L1 3Z",
    ]);
  });

  it("warns of @import, of linked sheets and of selectors it cannot read", async () => {
    expect(codes(await draw(`<style>@import url(a.css);</style><path ${PATH}/>`))).toEqual([
      "style-external",
    ]);
    const linked = `<?xml-stylesheet href="a.css"?>${page(`<path ${PATH}/>`)}`;
    expect(codes(await importSvg(linked))).toEqual(["style-external"]);
    expect(codes(await draw(`<style>path:frobnicate(2) g{stroke:red}</style><path ${PATH}/>`))).toEqual([
      "style-fault",
    ]);
  });
});

describe("what is invisible is not drawn", () => {
  it.each([
    ["display:none", `<path ${PATH} display="none"/>`],
    ["display:none above", `<g style="display:none"><g><path ${PATH}/></g></g>`],
    ["display:none by a class", `<style>.h{display:none}</style><path class="h" ${PATH}/>`],
    ["visibility:hidden", `<path ${PATH} visibility="hidden"/>`],
    ["visibility:hidden above", `<g visibility="hidden"><path ${PATH}/></g>`],
    ["visibility:collapse", `<path ${PATH} visibility="collapse"/>`],
    ["opacity 0", `<g opacity="0"><path ${PATH}/></g>`],
    ["opacity 0%", `<path style="opacity:0%" ${PATH}/>`],
    ["stroke-opacity 0", `<path stroke-opacity="0" ${PATH}/>`],
    ["stroke none", `<path stroke="none" ${PATH}/>`],
    ["defs", `<defs><path ${PATH}/></defs>`],
    ["symbol", `<symbol><path ${PATH}/></symbol>`],
    ["clipPath", `<clipPath><path ${PATH}/></clipPath>`],
    ["mask", `<mask><path ${PATH}/></mask>`],
    ["pattern", `<pattern><path ${PATH}/></pattern>`],
    ["marker", `<marker><path ${PATH}/></marker>`],
    ["unknown elements", `<frame><path ${PATH}/></frame>`],
    ["other vocabularies", `<i:pgf xmlns:i="x"><path ${PATH}/></i:pgf>`],
    ["metadata", `<metadata><path ${PATH}/></metadata>`],
  ])("%s", async (_name, body) => {
    expect(await shapes(body)).toEqual([]);
  });

  it("draws the visible child of a hidden group", async () => {
    expect(await shapes(`<g visibility="hidden"><path visibility="visible" ${PATH}/></g>`)).toEqual([
      "M0 0L1 0",
    ]);
  });

  it("keeps filled shapes without a stroke, marked as such", async () => {
    const drawing = await draw(`<path ${PATH} stroke="none" fill="red"/>`);
    expect([...drawing.paths.stroke]).toEqual([-1]);
    expect(fills(drawing)).toEqual(["#ff0000"]);
  });

  it("warns of lines of width 0", async () => {
    expect(codes(await draw(`<path ${PATH} stroke-width="0"/>`))).toContain("zero-width-stroke");
  });

  it.each([
    ["image", '<image x="10" y="20" width="30" height="40"/>', "image-not-drawn", [10, 20, 40, 60]],
    ["mask", `<rect x="1" y="2" width="3" height="4" mask="url(#m)"/>`, "mask-ignored", [1, 2, 4, 6]],
    [
      "filter",
      `<g filter="url(#f)"><rect x="1" y="2" width="3" height="4"/></g>`,
      "filter-ignored",
      [1, 2, 4, 6],
    ],
  ])("reports what is lost and where: %s", async (_name, body, code, box) => {
    const [warning] = (await draw(body)).warnings;
    expect(warning.code).toBe(code);
    expect(warning.boxes[0].map((mm) => Math.round(mm * 1e6) / 1e6)).toEqual(box);
    expect(warning.message).toMatch(/\.$/);
  });

  it("counts its warnings and names only the first places", async () => {
    const [warning] = (await draw('<image x="1" width="1" height="1"/>'.repeat(50))).warnings;
    expect(warning.count).toBe(50);
    expect(warning.boxes.length).toBe(20);
    expect(warning.message).toContain("50 pictures");
  });

  it("warns of embedded web pages and animations", async () => {
    expect(codes(await draw(`<foreignObject><p>hi</p></foreignObject><path ${PATH}/>`))).toEqual([
      "foreign-object",
    ]);
    expect(codes(await draw(`<path ${PATH}/><animate/>`))).toEqual(["animation-ignored"]);
  });

  it.each([
    ["the first child", `<switch><path d="M0 0h1"/><path d="M0 0h2"/></switch>`, ["M0 0L1 0"]],
    [
      "the language",
      `<switch><path systemLanguage="de" d="M0 0h1"/><path d="M0 0h2"/></switch>`,
      ["M0 0L2 0"],
    ],
    [
      "a regional language",
      `<switch><path systemLanguage="en-GB" d="M0 0h1"/><path d="M0 0h2"/></switch>`,
      ["M0 0L1 0"],
    ],
    [
      "what needs no extension",
      `<switch><g requiredExtensions="x"/><path d="M0 0h2"/></switch>`,
      ["M0 0L2 0"],
    ],
    [
      "the other side of a foreignObject",
      `<switch><foreignObject/><g><path d="M0 0h3"/></g></switch>`,
      ["M0 0L3 0"],
    ],
  ])("switch draws %s", async (_name, body, expected) => {
    expect(await shapes(body)).toEqual(expected);
  });
});
