/**
 * Features of SVG that browsers support but resvg does not, or not in its printed tree: each draws like a
 * simpler file.
 */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/import/svg/import-svg.js";
import { clipsOf, draw, page, shapes, shapesOf } from "../../../support/import/shapes.js";

const BOX = '<rect x="20" y="20" width="40" height="20"/>';

describe("style", () => {
  it.each([
    [
      "comments in a style attribute",
      "<path style=\"/* a */stroke:/* b */red;d:path('M1 1h2')\"/>",
      "M1 1h2",
    ],
    [
      "a style sheet of another kind",
      '<style type="text/less">path{display:none}</style><path d="M1 1h2"/>',
      "M1 1h2",
    ],
    [
      "a supported @supports",
      "<style>@supports (display: none){.a{display:none}}</style><path class='a' d='M9 9h9'/><path d='M1 1h2'/>",
      "M1 1h2",
    ],
    [
      "an unsupported @supports",
      "<style>@supports not (display: none){path{display:none}}@supports (foo: bar){path{display:none}}</style><path d='M1 1h2'/>",
      "M1 1h2",
    ],
  ])("%s", async (_name, body, d) => {
    expect(await shapes(body)).toEqual(await shapes(`<path d="${d}"/>`));
  });

  it.each([
    ["screen and (min-width: 1px)", 0],
    ["(prefers-color-scheme: light)", 0],
    ["(prefers-color-scheme: dark)", 1],
    ["screen and (max-width: 10px)", 1],
    ["print", 1],
    ["print, screen", 0],
  ])("with @media %s leaves %d shapes", async (query, expected) => {
    expect(await shapes(`<style>@media ${query}{path{display:none}}</style><path d="M1 1h2"/>`)).toHaveLength(
      expected,
    );
  });

  it.each([
    ["calc(10px + 5%)", 15],
    ["calc((4px - 1px) * 2 / 3)", 2],
    ["calc(2 * calc(1px + 2px))", 6],
    ["calc(1px +)", 0],
  ])("width: %s is %d", async (width, expected) => {
    const body = `<rect height="9" width="${width}"/>`;
    expect(await shapes(body)).toEqual(
      expected === 0 ? [] : await shapes(`<rect height="9" width="${expected}"/>`),
    );
  });
});

describe("transforms", () => {
  it.each([
    ["bottom left", "0 100"],
    ["left bottom", "0 100"],
    ["top", "50 0"],
    ["right", "100 50"],
    ["center", "50 50"],
    ["25% 5mm", `25 ${(5 * 96) / 25.4}`],
  ])("turn about %s", async (origin, at) => {
    const turned = BOX.replace("/>", ` transform="rotate(30)" transform-origin="${origin}"/>`);
    expect(await shapes(turned)).toEqual(await shapes(BOX.replace("/>", ` transform="rotate(30 ${at})"/>`)));
  });

  it("turn about the shape's own box on request", async () => {
    const style = "transform:rotate(30deg);transform-box:fill-box;transform-origin:center";
    expect(await shapes(BOX.replace("/>", ` style="${style}"/>`))).toEqual(
      await shapes(BOX.replace("/>", ' transform="rotate(30 40 30)"/>')),
    );
  });

  it("with two commas in a row are ignored", async () => {
    expect(await shapes(`<g transform="translate(1,,2)">${BOX}</g>`)).toEqual(await shapes(BOX));
  });

  it("of the outermost element turn about the middle of the page", async () => {
    const root = shapesOf(await importSvg(page(BOX, 'transform="rotate(30)"')));
    expect(root).toEqual(await shapes(`<g transform="rotate(30 50 50)">${BOX}</g>`));
  });
});

describe("what is not drawn", () => {
  const two = '<rect width="9" height="9" fill="red"';
  it.each([
    ["a blend mode", `${two} style="mix-blend-mode:multiply"/>`, "blend-ignored", "multiply"],
    ["the order of painting", `${two} paint-order="stroke"/>`, "paint-order-ignored", "stroke"],
    [
      "a pattern, by its name",
      `<pattern id="dots" width="2" height="2"><path d="M0 0h1"/></pattern><rect width="9" height="9" fill="url(#dots)"/>`,
      "pattern-fill",
      "dots",
    ],
    ["a layer that is transparent", `<g id="ghost" opacity="0">${BOX}</g>${BOX}`, "hidden-layer", "ghost"],
    [
      "a layer that is invisible",
      `<g id="ghost" visibility="hidden">${BOX}</g>${BOX}`,
      "hidden-layer",
      "ghost",
    ],
    [
      "a textPath in a textPath",
      '<path id="p" d="M0 0h99"/><text><textPath href="#p">a<textPath href="#p">b</textPath></textPath></text>',
      "text-not-drawn",
      "",
    ],
  ])("is in the report: %s", async (_name, body, code, detail) => {
    const warning = (await draw(body)).warnings.find((one) => one.code === code);
    expect(warning?.message).toContain(detail);
  });

  it("keeps dashes that are stretched with their shape", async () => {
    const [dash] = (await draw('<path transform="scale(4 1)" stroke-dasharray="1" d="M0 0h9"/>')).dashes;
    expect(dash).toEqual({ lengths: [2, 2], offset: 0, measure: { a: 0.5, b: -0, c: -0, d: 2 } });
    expect(
      (await draw('<path transform="rotate(30)" stroke-dasharray="1" d="M0 0h9"/>')).dashes[0].measure,
    ).toBeUndefined();
  });
});

describe("values", () => {
  it.each([
    [
      "keywords in capitals",
      '<g DISPLAY="x"><path style="DISPLAY:NONE" d="M0 0h9"/><path visibility="HIDDEN" d="M0 0h9"/><path d="M1 1h2"/></g>',
    ],
    ["a path that CSS takes away", '<path style="d:none" d="M0 0h9"/><path d="M1 1h2"/>'],
    [
      "selectors with a namespace",
      '<style>@namespace s url(http://www.w3.org/2000/svg);s|rect{display:none}*|circle{display:none}</style><rect width="9" height="9"/><circle r="9"/><path d="M1 1h2"/>',
    ],
    ["CSS\'s own translate", '<path style="translate:1px 1px" d="M0 0h2"/>'],
    ["CSS\'s translation in percent", '<path style="transform:translate(1%,1%)" d="M0 0h2"/>'],
    [
      "CSS\'s own scale, and a transform",
      '<path style="scale:2;transform:translate(0.5px,0.5px)" d="M0 0h1"/>',
    ],
    ["a number that ends in a point", '<path d="M1 1h2L9. 9"/>'],
    ["two commas between dashes", '<path stroke-dasharray="1,,2" d="M1 1h2"/>'],
  ])("%s", async (_name, body) => {
    expect(await shapes(body)).toEqual(await shapes('<path d="M1 1h2"/>'));
    expect((await draw(body)).dashes).toEqual([]);
  });

  it("cut a marker at its viewport, not at its viewBox", async () => {
    const marker =
      '<marker id="m" viewBox="5 5 10 20" refX="10" refY="10" markerWidth="10" markerHeight="10" markerUnits="userSpaceOnUse"><rect width="30" height="30"/></marker>';
    const { clips } = await draw(`${marker}<path stroke="none" d="M30 30h9" marker-start="url(#m)"/>`);
    expect([...clips[0].coords]).toEqual([25, 27.5, 35, 27.5, 35, 37.5, 25, 37.5]);
  });
});

describe("the file", () => {
  it("may define entities, for values and for elements", async () => {
    const text = `<!DOCTYPE svg [<!ENTITY w "40"><!ENTITY box '<rect x="20" y="20" width="&w;" height="20"/>'>]>${page("&box;")}`;
    expect(shapesOf(await importSvg(text))).toEqual(await shapes(BOX));
  });

  it("may have elements of other vocabularies, which are not drawn", async () => {
    expect(
      await shapes(`<g xmlns="http://example.org/other"><rect width="9" height="9"/></g>${BOX}`),
    ).toEqual(await shapes(BOX));
  });

  it("may write href both ways: the plain one has priority", async () => {
    const defs = '<defs><path id="a" d="M0 0h1"/><path id="b" d="M0 0h2"/></defs>';
    for (const both of ['xlink:href="#a" href="#b"', 'href="#b" xlink:href="#a"']) {
      expect(await shapes(`${defs}<use ${both}/>`)).toEqual(await shapes('<path d="M0 0h2"/>'));
    }
  });

  it.each([
    [
      "a copy of negative size",
      '<symbol id="s" viewBox="0 0 10 10"><path d="M0 0h9"/></symbol><use href="#s" width="-5"/>',
    ],
    ["a viewBox of no width", '<svg viewBox="0 0 0 10"><path d="M0 0h9"/></svg>'],
    [
      "a marker of no height",
      '<marker id="m" viewBox="0 0 9 0"><path d="M0 0h9"/></marker><path stroke="none" d="M0 0h9" marker-start="url(#m)"/>',
    ],
    ["a mask without content", '<mask id="m"/><path mask="url(#m)" d="M0 0h9"/>'],
    ["a filter without content", '<filter id="f"/><path filter="url(#f)" d="M0 0h9"/>'],
    ["a required extension", '<path requiredExtensions="" d="M0 0h9"/>'],
  ])("draws nothing for %s", async (_name, body) => {
    expect(await shapes(body)).toEqual([]);
  });

  it("ignores display none on the outermost element, a clip path or a marker", async () => {
    expect(shapesOf(await importSvg(page(BOX, 'display="none"')))).toEqual(await shapes(BOX));
    expect(
      (
        await draw(
          `<clipPath id="c" display="none"><path d="M0 0h9v9z"/></clipPath><g clip-path="url(#c)">${BOX}</g>`,
        )
      ).clips,
    ).toEqual([]);
    const marker =
      '<marker id="m" display="none"><path d="M0 0h1"/></marker><path d="M5 5h9" marker-start="url(#m)"/>';
    expect(await shapes(marker)).toHaveLength(2);
  });

  it("paints no line of height 0 with a gradient relative to its box, but in the fallback colour", async () => {
    const gradient = '<linearGradient id="g"><stop stop-color="red"/></linearGradient>';
    expect(await shapes(`${gradient}<path d="M0 0h9" stroke="url(#g)"/>`)).toEqual([]);
    expect((await draw(`${gradient}<path d="M0 0h9" stroke="url(#g) blue"/>`)).colors).toEqual(["#0000ff"]);
  });
});

describe("paint", () => {
  const filled = (defs: string): Promise<string[]> =>
    shapes(`<g stroke="none">${defs}<rect width="9" height="9" fill="url(#p)"/></g>`);

  it.each([
    ["a gradient without stops", '<linearGradient id="p"/>'],
    ["a pattern without content", '<pattern id="p" width="5" height="5"/>'],
    ["a pattern without a size", '<pattern id="p"><path d="M0 0h9"/></pattern>'],
  ])("of %s is none", async (_name, defs) => {
    expect(await filled(defs)).toEqual([]);
  });
});

describe("clips", () => {
  const clip = (attributes: string, more = ""): string =>
    `<clipPath id="c" ${attributes}><rect width="0.5" height="0.5" ${more}/></clipPath>`;

  it("in parts of the shape's box are transformed outside of that", async () => {
    const body = `${clip('clipPathUnits="objectBoundingBox" transform="translate(3 4)"')}<g clip-path="url(#c)">${BOX}</g>`;
    expect(await clipsOf(body)).toEqual([[23, 24, 43, 24, 43, 34, 23, 34]]);
  });

  it.each([
    ["clipPath", 'transform="rotate(90)" transform-origin="center"', ""],
    ["shape in it", "", 'transform="rotate(90)" transform-origin="center"'],
  ])("turn about the origin of a %s", async (_what, attributes, more) => {
    const body = `${clip(attributes, more)}<g clip-path="url(#c)">${BOX}</g>`;
    expect(await clipsOf(body)).toEqual([[100, 0, 100, 0.5, 99.5, 0.5, 99.5, 0]]);
  });

  it("of a clipPath are relative to the box of the shape", async () => {
    const body = `<clipPath id="d" clip-path="url(#c)"><rect width="90" height="90"/></clipPath>${clip('clipPathUnits="objectBoundingBox"')}<g clip-path="url(#d)">${BOX}</g>`;
    expect(await clipsOf(body)).toEqual([[20, 20, 40, 20, 40, 30, 20, 30]]);
  });

  it("have shapes that are clipped themselves", async () => {
    const body = `<clipPath id="b"><rect width="50" height="50"/></clipPath><clipPath id="c"><rect clip-path="url(#b)" x="30" y="30" width="50" height="60"/></clipPath><g clip-path="url(#c)">${BOX}</g>`;
    const [corners] = await clipsOf(body);
    const xs = corners.filter((_, i) => i % 2 === 0);
    const ys = corners.filter((_, i) => i % 2 === 1);
    expect([Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)]).toEqual([30, 50, 30, 50]);
  });

  it("that refer to themselves come to an end", { timeout: 20_000 }, async () => {
    const children = '<rect clip-path="url(#c)" transform="scale(.9)" width="50" height="50"/>'.repeat(10);
    const drawing = await draw(`<clipPath id="c">${children}</clipPath><g clip-path="url(#c)">${BOX}</g>`);
    expect(drawing.warnings.map(({ code }) => code)).toContain("clip-ignored");
  });

  it("inherit their rule from their parent", async () => {
    const body = `<g clip-rule="evenodd"><clipPath id="c"><path d="M0 0h50v50z"/></clipPath></g><g clip-path="url(#c)">${BOX}</g>`;
    expect([...(await draw(body)).clips[0].rule]).toEqual([1]);
  });

  it("apply to texts in parts of their box", async () => {
    const body = `${clip('clipPathUnits="objectBoundingBox"')}<text clip-path="url(#c)" x="10" y="50" font-size="20">HHHH</text>`;
    const [[x0, y0, x1, , , y2]] = await clipsOf(body);
    expect(x0).toBeCloseTo(10);
    expect(x1 - x0).toBeGreaterThan(20);
    expect([y0, y2].map(Math.round)).toEqual([32, 43]);
  });

  it("apply to the outermost element", async () => {
    const text = page(
      `<clipPath id="c"><rect width="30" height="30"/></clipPath>${BOX}`,
      'clip-path="url(#c)"',
    );
    expect((await importSvg(text)).clips.map(({ coords }) => [...coords])).toEqual([
      [0, 0, 30, 0, 30, 30, 0, 30],
    ]);
  });
});
