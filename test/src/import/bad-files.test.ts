import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE } from "../../../src/settings/prepare.js";

/** The error that importing `text` throws. */
async function failure(text: string): Promise<PlotwrightError> {
  try {
    await importSvg(text);
  } catch (error) {
    expect(error).toBeInstanceOf(PlotwrightError);
    const known = error as PlotwrightError;
    expect(known.code).toBe("bad-file");
    return known;
  }
  throw new Error("expected the import to fail");
}

const codes = async (text: string): Promise<string[]> =>
  (await importSvg(text)).warnings.map((warning) => warning.code);
const isFinite = async (text: string): Promise<boolean> =>
  (await importSvg(text)).paths.coords.every(Number.isFinite);

describe("importSvg on bad files", () => {
  it.each([
    ["", "empty"],
    ["   \n", "empty"],
    ["hello", "does not begin with <"],
    ["%PDF-1.7", "PDF"],
    ["\u0089PNG\r\n", "PNG"],
    ["\u001f\u008b\u0008", "compressed"],
    ["<html><body/></html>", "outermost element is <html>"],
    ['<?xml version="1.0"?><gpx/>', "outermost element is <gpx>"],
    ["<!DOCTYPE html><html></html>", "<html>"],
  ])("reports that %j is not an SVG, and what it is", async (text, words) => {
    const { message } = await failure(text);
    expect(message).toContain("not an SVG");
    expect(message).toContain(words);
  });

  it.each([
    ["<svg>\n<g>\n<path d='M0 0", 3],
    ["<svg>\n<g>\n<path d='M0 0'/>", 3],
    ["\n\n<svg>\n<g></svg>", 4],
    ["<svg>\n<path d='M0 0' <g/></svg>", 2],
  ])("names the line where %j is damaged", async (text, line) => {
    expect((await failure(text)).message).toMatch(new RegExp(`line ${line}, column \\d+`));
  });

  it("reports that a truncated file is incomplete", async () => {
    expect((await failure("<svg><g><path d='M0 0h1'/>")).message).toContain("incomplete");
  });

  it("warns that an empty drawing is empty", async () => {
    const drawing = await importSvg('<svg width="10mm" height="10mm"/>');
    expect(drawing.paths.count).toBe(0);
    expect(drawing.warnings.map((warning) => warning.code)).toEqual(["empty-drawing"]);
  });

  it("ends a path at an invalid coordinate, keeps what came before and reports where", async () => {
    const drawing = await importSvg(
      '<svg width="96" height="96">\n<path id="p" stroke="red" d="M0 0L9 9L NaN 4"/></svg>',
    );
    expect(drawing.paths.coords.length).toBe(4);
    const [warning] = drawing.warnings;
    expect(warning.code).toBe("path-data");
    expect(warning.message).toContain("line 2, id p");
    expect(warning.message).toContain("NaN");
  });

  it.each(["1e300", "-1e300", "1e999", "1e8"])("leaves out a shape that reaches to %s", async (far) => {
    const text = `<svg width="96" height="96"><path stroke="red" d="M0 0L${far} 9"/><path stroke="red" d="M0 0L1 1"/></svg>`;
    const drawing = await importSvg(text);
    expect(drawing.paths.count).toBe(1);
    expect(await codes(text)).toEqual(["coordinates-out-of-range"]);
    expect(await isFinite(text)).toBe(true);
  });

  it.each(["1e7", "1e12", "1e300"])(
    "cuts nothing off by a clip of radius %s, and does not hang",
    async (radius) => {
      const text = `<svg width="96" height="96"><clipPath id="c"><circle r="${radius}"/></clipPath><path stroke="red" d="M10 10H80V80" clip-path="url(#c)"/></svg>`;
      const { strokes } = prepare(await importSvg(text), { ...DEFAULT_PREPARE, marginMm: 0 });
      expect([strokes.offsets.length - 1, strokes.xy.length / 2]).toEqual([1, 3]);
    },
  );

  it("stays finite however large nested transforms become", async () => {
    const text = `<svg width="96" height="96">${'<g transform="scale(1e9)">'.repeat(60)}<path stroke="red" d="M0 0L1 1"/>${"</g>".repeat(60)}</svg>`;
    expect(await isFinite(text)).toBe(true);
    expect(await codes(text)).toContain("coordinates-out-of-range");
  });

  it("refuses a page of an impossible size", async () => {
    expect((await failure('<svg width="1e300" height="5"/>')).message).toContain("page");
    expect((await failure('<svg viewBox="0 0 1e20 5"/>')).message).toContain("page");
  });

  it("reads 100 000 nested groups", async () => {
    const depth = 100_000;
    const drawing = await importSvg(
      `<svg width="96" height="96">${"<g>".repeat(depth)}<path stroke="red" d="M0 0L96 96"/>${"</g>".repeat(depth)}</svg>`,
    );
    expect(drawing.paths.count).toBe(1);
    expect(drawing.paths.coords[2]).toBeCloseTo(25.4, 9);
  });

  it("does not expand entities that multiply, so an entity bomb stays small", async () => {
    const lines = Array.from({ length: 30 }, (_, i) => `<!ENTITY e${i + 1} "${`&e${i};`.repeat(10)}">`).join(
      "\n",
    );
    const text = `<!DOCTYPE svg [<!ENTITY e0 "boom">${lines}]><svg width="9" height="9"><path stroke="red" d="M0 0h5"/><text>&e30;</text></svg>`;
    const drawing = await importSvg(text);
    // The reference stays as written: a few letters.
    expect(drawing.paths.count).toBeLessThan(10);
    expect(drawing.warnings.find((warning) => warning.code === "xml-repaired")?.message).toContain("entity");
  });

  it("expands the five entities of XML and numeric ones", async () => {
    const drawing = await importSvg(
      '<svg width="9" height="9"><g id="a &amp; b &#x263A;&lt;"><path stroke="red" d="M0&#32;0h5"/></g></svg>',
    );
    expect(drawing.groups[0].name).toBe("a & b ☺<");
    expect(drawing.paths.count).toBe(1);
  });

  it("stops at copies that contain themselves, near and far", async () => {
    const text = `<svg width="9" height="9"><g id="a"><path stroke="red" d="M0 0h5"/><use href="#b"/></g><g id="b"><use href="#a"/></g><use id="c" href="#c"/></svg>`;
    expect(await codes(text)).toContain("circular-use");
    expect((await importSvg(text)).paths.count).toBeLessThan(10);
  });

  it("refuses nested copies that grow without end", async () => {
    const levels = Array.from(
      { length: 40 },
      (_, i) => `<g id="l${i + 1}">${`<use href="#l${i}"/>`.repeat(10)}</g>`,
    ).join("");
    const text = `<svg width="9" height="9"><defs><path id="l0" stroke="red" d="M0 0h5"/>${levels}</defs><use href="#l40"/></svg>`;
    expect((await failure(text)).message).toContain("copies");
  });

  it("survives a chain of 100 000 copies of one another", async () => {
    const chain = Array.from({ length: 100_000 }, (_, i) => `<use id="u${i + 1}" href="#u${i}"/>`).join("");
    const text = `<svg width="9" height="9"><defs><path id="u0" stroke="red" d="M0 0h5"/>${chain}</defs><use href="#u100000"/></svg>`;
    expect(await codes(text)).toContain("circular-use");
  });

  it("warns that a path of one point draws nothing, and keeps a dot", async () => {
    expect(await codes('<svg width="9" height="9"><path stroke="red" d="M5 5"/></svg>')).toContain(
      "single-point",
    );
    const dot = await importSvg('<svg width="96" height="96"><path stroke="red" d="M48 48z"/></svg>');
    expect(dot.paths.count).toBe(1);
    expect([...dot.paths.coords].map((v) => Math.round(v * 1e6) / 1e6)).toEqual([12.7, 12.7, 12.7, 12.7]);
  });

  it("accepts errors that browsers accept, and reports them", async () => {
    const drawing = await importSvg('<svg width=96 height="96"><path stroke="red" d="M0 0h5"/></svg>');
    expect(drawing.paths.count).toBe(1);
    expect(drawing.warnings.map((warning) => warning.code)).toEqual(["xml-repaired"]);
  });

  it.each(["color(", "url( 5s1 2 3 4z"])("draws the other shapes if a colour is %s", async (color) => {
    const shapes = `<path d="M0 0H5" stroke="${color}"/><path d="M0 3H5" stroke="red"/>`;
    const text = `<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm">${shapes}</svg>`;
    expect((await importSvg(text)).paths.count).toBeGreaterThan(0);
  });

  it.each([
    "x ~ path ~ path ~ path",
    ":has(:has(:has(path))) path ~ path ~ path ~ path",
    "path:not(:is(x, y ~ path, z ~ path ~ path))",
    "path:not(g:has(~ path:has(~ path:has(x))))",
    "x ~ path:nth-child(n of path ~ path)",
  ])("reports the selector %s if matching it takes too long, and draws everything", async (selector) => {
    const paths = '<path stroke="black" d="M0 0L9 9"/>'.repeat(4_000);
    const style = `<style>${selector}{stroke:red} path{fill:none}</style>`;
    const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm">${style}<g>${paths}</g></svg>`;
    const drawing = await importSvg(svg);
    expect(drawing.paths.count).toBe(4_000);
    expect(drawing.paths.fill.every((color) => color < 0)).toBe(true);
    const left = drawing.warnings.filter(({ code }) => code !== "style-fault");
    expect(left.map(({ code }) => code)).toEqual(left.length === 0 ? [] : ["style-slow"]);
    if (selector.startsWith("x ~ path ~")) expect(left[0].message).toContain(selector);
  });

  it("matches a usual selector on any number of elements", async () => {
    const groups = `<g class="a">${'<path class="b" d="M0 0L9 9"/>'.repeat(100)}</g>`.repeat(300);
    const style = "<style>svg > .a .b:not(:first-child), .b ~ .c, g:has(> .b) ~ g .b{stroke:red}</style>";
    const { paths, warnings } = await importSvg(
      `<svg width="9mm" height="9mm">${style}<g>${groups}</g></svg>`,
    );
    expect(paths.stroke.filter((color) => color >= 0).length).toBe(29_900);
    expect(warnings.map(({ code }) => code)).not.toContain("style-slow");
  });

  it("reads a file of 50 MB", async () => {
    const line = `<path fill="none" stroke="#000" d="M12.5 20.25${"L30.125 44.5 61 7.75".repeat(100)}"/>\n`;
    const count = Math.ceil(50_000_000 / line.length);
    const drawing = await importSvg(`<svg width="100mm" height="100mm">${line.repeat(count)}</svg>`);
    expect(drawing.paths.count).toBe(count);
    expect(drawing.warnings).toEqual([]);
  });
});
