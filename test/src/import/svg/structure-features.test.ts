/** Small SVGs, one per feature of copies and layers. */
import { describe, expect, it } from "vitest";
import { prepare } from "../../../../src/index.js";
import { strokeCount } from "../../../../src/internal.js";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { codes, draw, shapes, shapesOf } from "../../../support/import/shapes.js";

const PATH = 'd="M0 0h1"';

/** The stroke colour of each shape; "-" for none. */
const strokes = ({ paths, colors }: Drawing): string[] =>
  Array.from(paths.stroke, (color) => (color < 0 ? "-" : colors[color]));

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
    [
      "of a symbol with its own position",
      '<symbol id="a" x="5" y="6" viewBox="0 0 10 10"><path d="M0 0h10"/></symbol><use href="#a" x="1" width="20" height="20"/>',
      ["M6 6L26 6"],
    ],
    ["of a symbol, drawn once", '<symbol id="a"><path d="M0 0h1"/></symbol><use href="#a"/>', ["M0 0L1 0"]],
    [
      "of a nested svg",
      '<defs><svg id="a" viewBox="0 0 10 10" width="5" height="5"><path d="M0 0h10"/></svg></defs><use href="#a" width="20" height="20"/>',
      ["M0 0L20 0"],
    ],
  ])("%s", async (_name, body, expected) => {
    expect(await shapes(body)).toEqual(expected);
  });

  it("inherits style from the copy, not from the parent of the original", async () => {
    const drawing = await draw(
      `<defs stroke="blue"><path id="a" ${PATH}/></defs><g stroke="red"><use href="#a"/></g>`,
    );
    expect(strokes(drawing)).toEqual(["#ff0000"]);
  });

  it("matches rules on the original's own place", async () => {
    const drawing = await draw(
      `<style>.d path{stroke:red}</style><defs class="d"><path id="a" ${PATH}/></defs><use href="#a"/>`,
    );
    expect(strokes(drawing)).toEqual(["#ff0000"]);
  });

  it("warns of missing and external originals", async () => {
    expect(codes(await draw('<use href="#no"/>'))).toContain("reference-missing");
    expect(codes(await draw('<use href="other.svg#a"/>'))).toContain("reference-external");
  });
});

describe("layers", () => {
  const names = async (body: string): Promise<string[]> =>
    (await draw(body)).groups.map((group) => group.name);
  const g = (attributes: string, content = `<path ${PATH}/>`): string => `<g ${attributes}>${content}</g>`;

  it("names groups by label, data-name, id or number", async () => {
    const body =
      g('inkscape:label="Pen one" id="x"') + g('data-name="Ink &lt;2&gt;" id="y"') + g('id="third"') + g("");
    expect(await names(body)).toEqual(["Pen one", "Ink <2>", "third", "Layer 4"]);
  });

  it("decodes Illustrator's ids", async () => {
    expect(await names(g('id="Layer_x5F_1"') + g('id="_x31_0_x20_mm"'))).toEqual(["Layer_1", "10 mm"]);
  });

  it("skips one outer group, and several", async () => {
    expect(await names(g('id="all"', g('id="a"') + g('id="b"')))).toEqual(["a", "b"]);
    expect(await names(g('id="o"', g('id="p"', g('id="a"') + g('id="b"'))))).toEqual(["a", "b"]);
  });

  it("skips a switch as Illustrator writes it", async () => {
    const body = `<switch><foreignObject requiredExtensions="x"/><g>${g('id="a"')}${g('id="b"')}</g></switch>`;
    expect(await names(body)).toEqual(["a", "b"]);
  });

  it("keeps a single group of plain shapes as the layer", async () => {
    expect(await names(g('id="only"'))).toEqual(["only"]);
  });

  it("keeps a single Inkscape layer whose groups are not layers", async () => {
    const body = g('inkscape:groupmode="layer" inkscape:label="Ink"', g('id="a"') + g('id="b"'));
    expect(await names(body)).toEqual(["Ink"]);
  });

  it("treats only Inkscape's layers as layers if there are any", async () => {
    const body = g('inkscape:groupmode="layer" inkscape:label="Ink"') + g('id="a"') + g('id="b"');
    const drawing = await draw(body);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Ink", "Layer 2"]);
    expect([...drawing.paths.group]).toEqual([0, 1, 1]);
  });

  it("puts loose shapes into one layer and keeps paint order", async () => {
    const drawing = await draw(`<path ${PATH}/>${g('id="a"')}<path ${PATH}/>`);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Layer 1", "a"]);
    expect([...drawing.paths.group]).toEqual([0, 1, 0]);
  });

  it("keeps ids distinct", async () => {
    const ids = (await draw(g('id="a"') + g('id="a"') + g(""))).groups.map((group) => group.id);
    expect(new Set(ids).size).toBe(3);
    expect(ids[0]).toBe("a");
  });

  it("lists a hidden layer, does not draw it and reports it", async () => {
    const drawing = await draw(g('inkscape:label="Off" style="display:none"') + g('inkscape:label="On"'));
    expect(drawing.groups.map(({ name, hidden }) => [name, hidden])).toEqual([
      ["Off", true],
      ["On", false],
    ]);
    expect(drawing.paths.count).toBe(1);
    expect(drawing.warnings[0].message).toContain("Off");
  });

  it("does not say that a hidden layer is not drawn if something in it is drawn", async () => {
    const visible = '<path d="M10 20H60" visibility="visible"/>';
    const drawing = await draw(g('id="A" visibility="hidden"', `<path ${PATH}/>${visible}`) + g('id="B"'));
    expect(shapesOf(drawing)).toHaveLength(2);
    expect(codes(drawing)).toEqual([]);
    const inside = g('inkscape:groupmode="layer" id="C"', visible);
    const nested = g('inkscape:groupmode="layer" id="A" visibility="hidden"', `<path ${PATH}/>${inside}`);
    expect(codes(await draw(nested + g('inkscape:groupmode="layer" id="B"')))).toEqual([]);
    const { warnings } = await draw(g('id="A" visibility="hidden"') + g('id="B"'));
    expect(warnings.map(({ message }) => message).join()).toMatch(/^1 layer is hidden .*\(A\)/);
  });

  it("takes the names that were typed in Affinity and Illustrator", async () => {
    const serif = `xmlns:serif="http://www.serif.com/"`;
    const body =
      g(`${serif} id="-guides" serif:id="% guides"`) +
      g('id="b" data-name="1 red"') +
      g(`${serif} id="c" serif:id="2 & blue" data-name="c2"`.replace("&", "&amp;"));
    expect(await names(body)).toEqual(["% guides", "1 red", "2 & blue"]);
    expect(prepare(await draw(body)).strokes.layers.map(({ name }) => name)).toEqual(["1 red", "2 & blue"]);
  });

  it("lists Inkscape's sublayers with their layer, and leaves out those whose name begins with %", async () => {
    const layer = (name: string, content: string): string =>
      g(`inkscape:groupmode="layer" inkscape:label="${name}"`, content);
    const drawing = await draw(
      layer(
        "Ink",
        `<path ${PATH}/>${layer("1 red", `<path ${PATH}/>${layer("%help", `<path ${PATH}/>`)}`)}`,
      ) + layer("Rest", `<path ${PATH}/>`),
    );
    expect(drawing.groups.map(({ name, parent }) => [name, parent])).toEqual([
      ["Ink", undefined],
      ["1 red", 0],
      ["%help", 1],
      ["Rest", undefined],
    ]);
    const shown = (layers: "group" | "sublayer"): string[] =>
      prepare(drawing, { layers, joinMm: 0 }).strokes.layers.map(({ name }) => name);
    expect(shown("group")).toEqual(["Ink", "Rest"]);
    expect(shown("sublayer")).toEqual(["Ink", "1 red", "Rest"]);
    expect(strokeCount(prepare(drawing, { joinMm: 0 }).strokes)).toBe(3);
  });

  it("are layers if the file says so, however many", async () => {
    const names = Array.from({ length: 300 }, (_, i) => `ink ${i}`);
    const layers = names.map(
      (name) =>
        `<g inkscape:groupmode="layer" inkscape:label="${name}" xmlns:inkscape="x"><path ${PATH}/></g>`,
    );
    const drawing = await draw(layers.join(""));
    expect(drawing.groups.map(({ name }) => name)).toEqual(names);
    expect(codes(drawing)).toEqual([]);
  });

  it("treats hundreds of groups as data, not layers", async () => {
    const drawing = await draw(g("").repeat(500));
    expect(drawing.groups.length).toBe(1);
    expect(codes(drawing)).toEqual(["too-many-layers"]);
  });
});
