/** Small SVGs, one per feature of CSS, visibility, copies, layers, clips, markers and dashes. */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../src/import/import-svg.js";
import type { Drawing } from "../../../src/drawing/drawing.js";
import { codes, draw, page, shapes, shapesOf } from "./support/shapes.js";

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
  ])("reads the stroke %s", (color, expected) => {
    const drawing = draw(`<path ${PATH} fill="blue" color="lime" stroke="${color}"/>`);
    expect(strokes(drawing)).toEqual([expected]);
  });

  it("keeps what was inherited where a colour is malformed", () => {
    expect(strokes(draw(`<path ${PATH} stroke="#ggg"/>`))).toEqual(["#000000"]);
  });

  it("lists each colour once, in order of first use", () => {
    const drawing = draw(
      `<path ${PATH} stroke="blue"/><path ${PATH} stroke="red"/><path ${PATH} stroke="#00F" fill="red"/>`,
    );
    expect(drawing.colors).toEqual(["#0000ff", "#ff0000"]);
    expect(fills(drawing)).toEqual(["-", "-", "#ff0000"]);
  });

  it("draws a gradient stroke in its first colour, found through href, and says so", () => {
    const drawing = draw(
      `<defs><linearGradient id="a"><stop stop-color="teal"/><stop stop-color="red"/></linearGradient><linearGradient id="b" xlink:href="#a"/></defs><path ${PATH} stroke="url(#b)"/>`,
    );
    expect(strokes(drawing)).toEqual(["#008080"]);
    expect(codes(drawing)).toEqual(["gradient-stroke"]);
    expect(drawing.warnings[0].boxes).toEqual([[0, 0, 0, 0]]);
  });

  it("uses the fallback of a missing gradient", () => {
    expect(strokes(draw(`<path ${PATH} stroke="url(#none) red"/>`))).toEqual(["#ff0000"]);
  });

  it("warns of a missing gradient without fallback", () => {
    expect(codes(draw(`<path ${PATH} stroke="url(#none)"/>`))).toContain("paint-missing");
  });
});

describe("the cascade", () => {
  const stroke = (style: string, element: string): string[] =>
    strokes(draw(`<style>${style}</style>${element}`));

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
  ])("obeys %s", (_name, style, element) => {
    expect(stroke(style, element)).toEqual(["#ff0000"]);
  });

  it.each([
    ["odd", [1, 3, 5, 7]],
    ["2n", [2, 4, 6]],
    ["3n+2", [2, 5]],
    ["-n+3", [1, 2, 3]],
    ["4", [4]],
    [" n + 6 ", [6, 7]],
  ])("counts children: :nth-child(%s)", (formula, expected) => {
    const body = `<style>path:nth-child(${formula}){stroke:red}</style><g>${`<path ${PATH}/>`.repeat(7)}</g>`;
    const red = strokes(draw(body)).flatMap((color, i) => (color === "#ff0000" ? [i + 1] : []));
    expect(red).toEqual(expected);
  });

  it("counts children from the end", () => {
    const body = `<style>path:nth-last-child(2),path:last-child{stroke:red}</style><g>${`<path ${PATH}/>`.repeat(4)}</g>`;
    expect(strokes(draw(body))).toEqual(["#000000", "#000000", "#ff0000", "#ff0000"]);
  });

  it("counts among 50 000 siblings without counting them each time", () => {
    const body = `<style>path:nth-child(2n) + path{stroke:red}</style><g>${`<path ${PATH}/>`.repeat(50_000)}</g>`;
    expect(strokes(draw(body)).filter((color) => color === "#ff0000").length).toBe(24_999);
  });

  it("reads style sheets in CDATA, and those that come last", () => {
    expect(strokes(draw(`<path ${PATH}/><style><![CDATA[ g > x, path { stroke: red } ]]></style>`))).toEqual([
      "#ff0000",
    ]);
  });

  it("reads geometry from CSS", () => {
    expect(shapes("<style>rect{width:4px;height:3px;x:1px}</style><rect/>")).toEqual(["M1 0L5 0L5 3L1 3Z"]);
  });

  it("warns of @import, of linked sheets and of selectors it cannot read", () => {
    expect(codes(draw(`<style>@import url(a.css);</style><path ${PATH}/>`))).toEqual(["style-external"]);
    const linked = `<?xml-stylesheet href="a.css"?>${page(`<path ${PATH}/>`)}`;
    expect(codes(importSvg(linked))).toEqual(["style-external"]);
    expect(codes(draw(`<style>path:frobnicate(2) g{stroke:red}</style><path ${PATH}/>`))).toEqual([
      "style-fault",
    ]);
  });
});

describe("what is not seen is not drawn", () => {
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
  ])("%s", (_name, body) => {
    expect(shapes(body)).toEqual([]);
  });

  it("draws the visible child of a hidden group", () => {
    expect(shapes(`<g visibility="hidden"><path visibility="visible" ${PATH}/></g>`)).toEqual(["M0 0L1 0"]);
  });

  it("keeps filled shapes without a stroke, marked as such", () => {
    const drawing = draw(`<path ${PATH} stroke="none" fill="red"/>`);
    expect([...drawing.paths.stroke]).toEqual([-1]);
    expect(fills(drawing)).toEqual(["#ff0000"]);
  });

  it("warns of lines of width 0", () => {
    expect(codes(draw(`<path ${PATH} stroke-width="0"/>`))).toContain("zero-width-stroke");
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
  ])("says what is lost and where: %s", (_name, body, code, box) => {
    const [warning] = draw(body).warnings;
    expect(warning.code).toBe(code);
    expect(warning.boxes[0].map((mm) => Math.round(mm * 1e6) / 1e6)).toEqual(box);
    expect(warning.message).toMatch(/\.$/);
  });

  it("counts what it warns of and names only the first places", () => {
    const [warning] = draw('<image x="1" width="1" height="1"/>'.repeat(50)).warnings;
    expect(warning.count).toBe(50);
    expect(warning.boxes.length).toBe(20);
    expect(warning.message).toContain("50 pictures");
  });

  it("warns of embedded web pages and animations", () => {
    expect(codes(draw(`<foreignObject><p>hi</p></foreignObject><path ${PATH}/>`))).toEqual([
      "foreign-object",
    ]);
    expect(codes(draw(`<path ${PATH}/><animate/>`))).toEqual(["animation-ignored"]);
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
  ])("switch draws %s", (_name, body, expected) => {
    expect(shapes(body)).toEqual(expected);
  });
});

describe("copies", () => {
  it.each([
    ["href", '<defs><path id="a" d="M0 0h1"/></defs><use href="#a" x="3" y="4"/>', ["M3 4L4 4"]],
    ["xlink:href", '<defs><path id="a" d="M0 0h1"/></defs><use xlink:href="#a"/>', ["M0 0L1 0"]],
    ["to what comes later", '<use href="#a"/><defs><path id="a" d="M0 0h1"/></defs>', ["M0 0L1 0"]],
    [
      "of a group",
      '<defs><g id="a" transform="scale(2)"><path d="M1 0h1"/></g></defs><use href="#a" x="5"/>',
      ["M7 0L9 0"],
    ],
    [
      "transform before x and y",
      '<path id="a" d="M0 0h1" display="none"/><g display="none"/><defs><path id="b" d="M0 0h1"/></defs><use href="#b" transform="scale(2)" x="3"/>',
      ["M6 0L8 0"],
    ],
    [
      "of copies",
      '<defs><path id="a" d="M0 0h1"/><use id="b" href="#a" x="1"/></defs><use href="#b" x="2"/>',
      ["M3 0L4 0"],
    ],
    [
      "of a symbol with a viewBox",
      '<symbol id="a" viewBox="0 0 10 10"><path d="M0 0h10"/></symbol><use href="#a" width="20" height="20"/>',
      ["M0 0L20 0"],
    ],
    ["of a symbol, drawn once", '<symbol id="a"><path d="M0 0h1"/></symbol><use href="#a"/>', ["M0 0L1 0"]],
    [
      "of a nested svg",
      '<defs><svg id="a" viewBox="0 0 10 10" width="5" height="5"><path d="M0 0h10"/></svg></defs><use href="#a" width="20" height="20"/>',
      ["M0 0L20 0"],
    ],
  ])("%s", (_name, body, expected) => {
    expect(shapes(body)).toEqual(expected);
  });

  it("inherits style from the copy, not from where the original stands", () => {
    const drawing = draw(
      `<defs stroke="blue"><path id="a" ${PATH}/></defs><g stroke="red"><use href="#a"/></g>`,
    );
    expect(strokes(drawing)).toEqual(["#ff0000"]);
  });

  it("matches rules on the original's own place", () => {
    const drawing = draw(
      `<style>.d path{stroke:red}</style><defs class="d"><path id="a" ${PATH}/></defs><use href="#a"/>`,
    );
    expect(strokes(drawing)).toEqual(["#ff0000"]);
  });

  it("warns of missing and of outside originals", () => {
    expect(codes(draw('<use href="#no"/>'))).toContain("reference-missing");
    expect(codes(draw('<use href="other.svg#a"/>'))).toContain("reference-external");
  });
});

describe("layers", () => {
  const names = (body: string): string[] => draw(body).groups.map((group) => group.name);
  const g = (attributes: string, content = `<path ${PATH}/>`): string => `<g ${attributes}>${content}</g>`;

  it("names groups by label, data-name, id or number", () => {
    const body =
      g('inkscape:label="Pen one" id="x"') + g('data-name="Ink &lt;2&gt;" id="y"') + g('id="third"') + g("");
    expect(names(body)).toEqual(["Pen one", "Ink <2>", "third", "Layer 4"]);
  });

  it("decodes Illustrator's ids", () => {
    expect(names(g('id="Layer_x5F_1"') + g('id="_x31_0_x20_mm"'))).toEqual(["Layer_1", "10 mm"]);
  });

  it("looks through one outer group, and through several", () => {
    expect(names(g('id="all"', g('id="a"') + g('id="b"')))).toEqual(["a", "b"]);
    expect(names(g('id="o"', g('id="p"', g('id="a"') + g('id="b"'))))).toEqual(["a", "b"]);
  });

  it("looks through a switch as Illustrator writes it", () => {
    const body = `<switch><foreignObject requiredExtensions="x"/><g>${g('id="a"')}${g('id="b"')}</g></switch>`;
    expect(names(body)).toEqual(["a", "b"]);
  });

  it("keeps a single group of plain shapes as the layer", () => {
    expect(names(g('id="only"'))).toEqual(["only"]);
  });

  it("keeps a single Inkscape layer whose groups are no layers", () => {
    const body = g('inkscape:groupmode="layer" inkscape:label="Ink"', g('id="a"') + g('id="b"'));
    expect(names(body)).toEqual(["Ink"]);
  });

  it("takes only Inkscape's layers for layers where there are any", () => {
    const body = g('inkscape:groupmode="layer" inkscape:label="Ink"') + g('id="a"') + g('id="b"');
    const drawing = draw(body);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Ink", "Layer 2"]);
    expect([...drawing.paths.group]).toEqual([0, 1, 1]);
  });

  it("puts loose shapes into one layer and keeps paint order", () => {
    const drawing = draw(`<path ${PATH}/>${g('id="a"')}<path ${PATH}/>`);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Layer 1", "a"]);
    expect([...drawing.paths.group]).toEqual([0, 1, 0]);
  });

  it("keeps ids distinct", () => {
    const ids = draw(g('id="a"') + g('id="a"') + g("")).groups.map((group) => group.id);
    expect(new Set(ids).size).toBe(3);
    expect(ids[0]).toBe("a");
  });

  it("lists a hidden layer, does not draw it and says so", () => {
    const drawing = draw(g('inkscape:label="Off" style="display:none"') + g('inkscape:label="On"'));
    expect(drawing.groups.map(({ name, hidden }) => [name, hidden])).toEqual([
      ["Off", true],
      ["On", false],
    ]);
    expect(drawing.paths.count).toBe(1);
    expect(drawing.warnings[0].message).toContain("Off");
  });

  it("takes hundreds of groups for data, not layers", () => {
    const drawing = draw(g("").repeat(500));
    expect(drawing.groups.length).toBe(1);
    expect(codes(drawing)).toEqual(["too-many-layers"]);
  });
});

describe("clips", () => {
  const clip = (inner: string, attributes = ""): string =>
    `<clipPath id="c" ${attributes}>${inner}</clipPath>`;

  it("cuts to a shape, given once for all that it cuts", () => {
    const drawing = draw(
      `${clip('<circle cx="50" cy="50" r="10"/>')}<g clip-path="url(#c)"><path d="M0 50h100"/><path d="M50 0v100"/></g>`,
    );
    expect([...drawing.paths.clip]).toEqual([0, 0]);
    expect(drawing.clips.length).toBe(1);
    expect(drawing.clips[0].parent).toBe(-1);
  });

  it("leaves out a rectangle that cuts nothing", () => {
    const drawing = draw(
      `${clip('<rect width="100" height="100"/>')}<g clip-path="url(#c)"><path d="M0 50h100"/></g>`,
    );
    expect(drawing.clips).toEqual([]);
  });

  it("maps the region with the element that it clips", () => {
    const drawing = draw(
      `${clip('<rect width="10" height="10"/>')}<g transform="translate(20 0) scale(2)" clip-path="url(#c)"><path d="M0 5h50"/></g>`,
    );
    expect([...drawing.clips[0].coords]).toEqual([20, 0, 40, 0, 40, 20, 20, 20]);
  });

  it("stretches objectBoundingBox regions over the element", () => {
    const drawing = draw(
      `${clip('<circle cx=".5" cy=".5" r=".5"/>', 'clipPathUnits="objectBoundingBox"')}<g clip-path="url(#c)"><rect x="10" y="20" width="40" height="20"/><rect x="50" y="40" width="10" height="10"/></g>`,
    );
    const { coords } = drawing.clips[0];
    expect(coords[0]).toBeCloseTo(60, 6);
    expect(coords[1]).toBeCloseTo(35, 6);
  });

  it("nests, from the outside in", () => {
    const drawing = draw(
      `<clipPath id="a"><circle r="30"/></clipPath><clipPath id="b"><circle r="20"/></clipPath><g clip-path="url(#a)"><path clip-path="url(#b)" d="M0 0h90"/></g>`,
    );
    expect(drawing.clips.map((region) => region.parent)).toEqual([-1, 0]);
    expect([...drawing.paths.clip]).toEqual([1]);
  });

  it("intersects a clipPath that is itself clipped", () => {
    const drawing = draw(
      `<clipPath id="a"><circle r="30"/></clipPath><clipPath id="b" clip-path="url(#a)"><circle r="20"/></clipPath><path clip-path="url(#b)" d="M0 0h90"/>`,
    );
    expect(drawing.clips.length).toBe(2);
  });

  it("keeps rule and shape of each subpath", () => {
    const drawing = draw(
      `${clip('<path clip-rule="evenodd" d="M0 0h9v9zM1 1h3v3z"/><rect width="5" height="5"/>')}<path clip-path="url(#c)" d="M0 0h90"/>`,
    );
    expect([...drawing.clips[0].rule]).toEqual([1, 1, 0]);
    expect([...(drawing.clips[0].shape ?? [])]).toEqual([0, 0, 1]);
  });

  it("follows use inside a clipPath, with transforms", () => {
    const drawing = draw(
      `<defs><rect id="r" width="5" height="5"/></defs>${clip('<use href="#r" x="10" transform="scale(2)"/>')}<path clip-path="url(#c)" d="M0 0h90"/>`,
    );
    expect([...drawing.clips[0].coords]).toEqual([20, 0, 30, 0, 30, 10, 20, 10]);
  });

  it("hides everything under an empty clipPath", () => {
    expect(shapes(`${clip("")}<path clip-path="url(#c)" d="M0 0h90"/>`)).toEqual([]);
  });

  it("draws unclipped where the clip is missing, circular or a CSS shape, and says so", () => {
    for (const value of ["url(#no)", "circle(40%)"]) {
      const drawing = draw(`<path style="clip-path:${value}" d="M0 0h9"/>`);
      expect(shapesOf(drawing)).toEqual(["M0 0L9 0"]);
      expect(codes(drawing)).toEqual(["clip-ignored"]);
    }
    expect(
      codes(draw(`${clip("<circle r='9'/>", 'clip-path="url(#c)"')}<path clip-path="url(#c)" d="M0 0h90"/>`)),
    ).toContain("clip-ignored");
  });
});

describe("dashes and widths", () => {
  it("keeps dashes in mm, an odd list doubled", () => {
    const drawing = draw(
      `<g transform="scale(2)"><path ${PATH} stroke-dasharray="1 2 3" stroke-dashoffset="4" stroke-width=".5"/></g>`,
    );
    expect(drawing.dashes).toEqual([{ lengths: [2, 4, 6, 2, 4, 6], offset: 8 }]);
    expect(drawing.paths.strokeWidth[0]).toBe(1);
  });

  it("keeps one pattern for many shapes, and none for solid lines", () => {
    const drawing = draw(
      `<g stroke-dasharray="1"><path ${PATH}/><path ${PATH}/><path ${PATH} stroke-dasharray="none"/><path ${PATH} stroke-dasharray="0 0"/></g>`,
    );
    expect([...drawing.paths.dash]).toEqual([0, 0, -1, -1]);
    expect(drawing.dashes.length).toBe(1);
  });

  it("measures dashes by pathLength", () => {
    const drawing = draw('<path d="M0 0h50" pathLength="10" stroke-dasharray="1"/>');
    expect(drawing.dashes[0].lengths).toEqual([5, 5]);
  });

  it("keeps a non-scaling stroke's width", () => {
    const drawing = draw(`<path ${PATH} vector-effect="non-scaling-stroke" stroke-width="96"/>`);
    expect(drawing.paths.strokeWidth[0]).toBeCloseTo(25.4, 4);
  });
});

describe("markers", () => {
  const marker = (attributes: string): string =>
    `<marker id="m" markerUnits="userSpaceOnUse" markerWidth="4" markerHeight="4" overflow="visible" ${attributes}><path stroke="red" d="M0 0h2"/></marker>`;
  const marked = (attributes: string, path: string): string[] =>
    shapes(`${marker(attributes)}<path ${path} />`).slice(1);

  it("stands at start, middles and end", () => {
    expect(marked("", 'd="M10 10h10v10" style="marker:url(#m)"')).toEqual([
      "M10 10L12 10",
      "M20 10L22 10",
      "M20 20L22 20",
    ]);
  });

  it("turns with the line", () => {
    expect(marked('orient="auto"', 'd="M10 10v10" marker-end="url(#m)"')).toEqual(["M10 20L10 22"]);
  });

  it("turns round at the start when asked", () => {
    expect(marked('orient="auto-start-reverse"', 'd="M10 10v10" marker-start="url(#m)"')).toEqual([
      "M10 10L10 8",
    ]);
  });

  it("halves the angle in the middle", () => {
    const [shape] = marked('orient="auto"', 'd="M10 10h10v10" marker-mid="url(#m)"');
    expect(shape).toBe("M20 10L21.4142 11.4142");
  });

  it("turns by a fixed angle", () => {
    expect(marked('orient="90"', 'd="M10 10h10" marker-end="url(#m)"')).toEqual(["M20 10L20 12"]);
  });

  it("lays its reference point on the vertex and fits its viewBox", () => {
    expect(marked('viewBox="0 0 2 2" refX="1" refY="1"', 'd="M10 10h10" marker-end="url(#m)"')).toEqual([
      "M18 8L22 8",
    ]);
  });

  it("grows with the line's width by default", () => {
    const body = `<marker id="m" overflow="visible"><path stroke="red" d="M0 0h2"/></marker><path d="M10 10h10" stroke-width="3" marker-end="url(#m)"/>`;
    expect(shapes(body)[1]).toBe("M20 10L26 10");
  });

  it("does not stand inside an arc", () => {
    expect(marked("", 'd="M10 10A10 10 0 0 1 30 10" marker-mid="url(#m)"')).toEqual([]);
  });

  it("takes the line's colour when asked", () => {
    const drawing = draw(
      `<marker id="m"><path fill="none" stroke="context-stroke" d="M0 0h2"/></marker><path d="M10 10h10" stroke="blue" marker-end="url(#m)"/>`,
    );
    expect(strokes(drawing)).toEqual(["#0000ff", "#0000ff"]);
  });

  it("stops at markers on markers", () => {
    const body = `<marker id="m" overflow="visible"><path d="M0 0h2" marker-end="url(#m)"/></marker><path d="M10 10h10" marker-end="url(#m)"/>`;
    expect(shapes(body)).toEqual(["M10 10L20 10", "M20 10L22 10"]);
  });
});
