/** Small SVGs, one per feature of clips, dashes, widths and markers. */
import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { codes, draw, shapes, shapesOf } from "../../../support/import/shapes.js";

const PATH = 'd="M0 0h1"';

/** The stroke colour of each shape; "-" for none. */
const strokes = ({ paths, colors }: Drawing): string[] =>
  Array.from(paths.stroke, (color) => (color < 0 ? "-" : colors[color]));

describe("clips", () => {
  const clip = (inner: string, attributes = ""): string =>
    `<clipPath id="c" ${attributes}>${inner}</clipPath>`;

  it("cuts to a shape, stored once for everything that it cuts", async () => {
    const drawing = await draw(
      `${clip('<circle cx="50" cy="50" r="10"/>')}<g clip-path="url(#c)"><path d="M0 50h100"/><path d="M50 0v100"/></g>`,
    );
    expect([...drawing.paths.clip]).toEqual([0, 0]);
    expect(drawing.clips.length).toBe(1);
    expect(drawing.clips[0].parent).toBe(-1);
  });

  it("omits a rectangle that cuts nothing", async () => {
    const drawing = await draw(
      `${clip('<rect width="100" height="100"/>')}<g clip-path="url(#c)"><path d="M0 50h100"/></g>`,
    );
    expect(drawing.clips).toEqual([]);
  });

  it("maps the region with the clipped element", async () => {
    const drawing = await draw(
      `${clip('<rect width="10" height="10"/>')}<g transform="translate(20 0) scale(2)" clip-path="url(#c)"><path d="M0 5h50"/></g>`,
    );
    expect([...drawing.clips[0].coords]).toEqual([20, 0, 40, 0, 40, 20, 20, 20]);
  });

  it("stretches objectBoundingBox regions over the element", async () => {
    const drawing = await draw(
      `${clip('<circle cx=".5" cy=".5" r=".5"/>', 'clipPathUnits="objectBoundingBox"')}<g clip-path="url(#c)"><rect x="10" y="20" width="40" height="20"/><rect x="50" y="40" width="10" height="10"/></g>`,
    );
    const { coords } = drawing.clips[0];
    expect(coords[0]).toBeCloseTo(60, 6);
    expect(coords[1]).toBeCloseTo(35, 6);
  });

  it("nests, from the outside in", async () => {
    const drawing = await draw(
      `<clipPath id="a"><circle r="30"/></clipPath><clipPath id="b"><circle r="20"/></clipPath><g clip-path="url(#a)"><path clip-path="url(#b)" d="M0 0h90"/></g>`,
    );
    expect(drawing.clips.map((region) => region.parent)).toEqual([-1, 0]);
    expect([...drawing.paths.clip]).toEqual([1]);
  });

  it("intersects a clipPath that is itself clipped", async () => {
    const drawing = await draw(
      `<clipPath id="a"><circle r="30"/></clipPath><clipPath id="b" clip-path="url(#a)"><circle r="20"/></clipPath><path clip-path="url(#b)" d="M0 0h90"/>`,
    );
    expect(drawing.clips.length).toBe(2);
  });

  it("keeps rule and shape of each subpath", async () => {
    const drawing = await draw(
      `${clip('<path clip-rule="evenodd" d="M0 0h9v9zM1 1h3v3z"/><rect width="5" height="5"/>')}<path clip-path="url(#c)" d="M0 0h90"/>`,
    );
    expect([...drawing.clips[0].rule]).toEqual([1, 1, 0]);
    expect([...(drawing.clips[0].shape ?? [])]).toEqual([0, 0, 1]);
  });

  it("follows use inside a clipPath, with transforms", async () => {
    const drawing = await draw(
      `<defs><rect id="r" width="5" height="5"/></defs>${clip('<use href="#r" x="10" transform="scale(2)"/>')}<path clip-path="url(#c)" d="M0 0h90"/>`,
    );
    expect([...drawing.clips[0].coords]).toEqual([20, 0, 30, 0, 30, 10, 20, 10]);
  });

  it("hides everything under an empty clipPath", async () => {
    expect(await shapes(`${clip("")}<path clip-path="url(#c)" d="M0 0h90"/>`)).toEqual([]);
  });

  it("draws unclipped if the clip is missing, circular or of an unknown kind, and reports it", async () => {
    for (const value of ["url(#no)", "shape(from 0 0)"]) {
      const drawing = await draw(`<path style="clip-path:${value}" d="M0 0h9"/>`);
      expect(shapesOf(drawing)).toEqual(["M0 0L9 0"]);
      expect(codes(drawing)).toEqual(["clip-ignored"]);
    }
    expect(
      codes(
        await draw(
          `${clip("<circle r='9'/>", 'clip-path="url(#c)"')}<path clip-path="url(#c)" d="M0 0h90"/>`,
        ),
      ),
    ).toContain("clip-ignored");
  });
});

describe("dashes and widths", () => {
  it("keeps dashes in mm, and doubles an odd list", async () => {
    const drawing = await draw(
      `<g transform="scale(2)"><path ${PATH} stroke-dasharray="1 2 3" stroke-dashoffset="4" stroke-width=".5"/></g>`,
    );
    expect(drawing.dashes).toEqual([{ lengths: [2, 4, 6, 2, 4, 6], offset: 8 }]);
    expect(drawing.paths.strokeWidth[0]).toBe(1);
  });

  it("keeps one pattern for many shapes, and none for solid lines", async () => {
    const drawing = await draw(
      `<g stroke-dasharray="1"><path ${PATH}/><path ${PATH}/><path ${PATH} stroke-dasharray="none"/><path ${PATH} stroke-dasharray="0 0"/></g>`,
    );
    expect([...drawing.paths.dash]).toEqual([0, 0, -1, -1]);
    expect(drawing.dashes.length).toBe(1);
  });

  it("measures dashes by pathLength", async () => {
    const drawing = await draw('<path d="M0 0h50" pathLength="10" stroke-dasharray="1"/>');
    expect(drawing.dashes[0].lengths).toEqual([5, 5]);
  });

  it("keeps a non-scaling stroke's width", async () => {
    const drawing = await draw(`<path ${PATH} vector-effect="non-scaling-stroke" stroke-width="96"/>`);
    expect(drawing.paths.strokeWidth[0]).toBeCloseTo(25.4, 4);
  });
});

describe("markers", () => {
  const marker = (attributes: string): string =>
    `<marker id="m" markerUnits="userSpaceOnUse" markerWidth="4" markerHeight="4" overflow="visible" ${attributes}><path stroke="red" d="M0 0h2"/></marker>`;
  const marked = async (attributes: string, path: string): Promise<string[]> =>
    (await shapes(`${marker(attributes)}<path ${path} />`)).slice(1);

  // The ends of the markers' lines are those of Chromium's picture; resvg differs.
  const all = async (d: string): Promise<string[]> =>
    (await marked('orient="auto"', `d="${d}" fill="none" style="marker:url(#m)"`)).map(
      (line) => line.split("L")[1],
    );

  it.each([
    ["a reversal, left of the path", "M10 20H30H10", ["12 20", "30 18", "8 20"]],
    ["a vertical reversal", "M20 10V30V10", ["20 12", "22 30", "20 8"]],
    ["a line that is closed", "M10 20H30Z", ["10 22", "30 18", "10 22"]],
    [
      "a close at the start",
      "M20 20V10H10V20H20Z",
      ["20 18", "18.5858 8.5858", "8.5858 11.4142", "11.4142 21.4142", "21.4142 18.5858", "20 18"],
    ],
    [
      "a repeated close",
      "M20 20V10H10V20ZZ",
      ["20 18", "18.5858 8.5858", "8.5858 11.4142", "11.4142 21.4142", "21.4142 18.5858", "20 18"],
    ],
  ])("are turned as in a browser at %s", async (_where, d, ends) => {
    expect(await all(d)).toEqual(ends);
  });

  it("are placed at start, middles and end", async () => {
    expect(await marked("", 'd="M10 10h10v10" style="marker:url(#m)"')).toEqual([
      "M10 10L12 10",
      "M20 10L22 10",
      "M20 20L22 20",
    ]);
  });

  it("turn with the line", async () => {
    expect(await marked('orient="auto"', 'd="M10 10v10" marker-end="url(#m)"')).toEqual(["M10 20L10 22"]);
  });

  it("are reversed at the start on request", async () => {
    expect(await marked('orient="auto-start-reverse"', 'd="M10 10v10" marker-start="url(#m)"')).toEqual([
      "M10 10L10 8",
    ]);
  });

  it("bisect the angle in the middle", async () => {
    const [shape] = await marked('orient="auto"', 'd="M10 10h10v10" marker-mid="url(#m)"');
    expect(shape).toBe("M20 10L21.4142 11.4142");
  });

  it("turn by a fixed angle", async () => {
    expect(await marked('orient="90"', 'd="M10 10h10" marker-end="url(#m)"')).toEqual(["M20 10L20 12"]);
  });

  it("put their reference point on the vertex and fit their viewBox", async () => {
    expect(await marked('viewBox="0 0 2 2" refX="1" refY="1"', 'd="M10 10h10" marker-end="url(#m)"')).toEqual(
      ["M18 8L22 8"],
    );
  });

  it("scale with the line's width by default", async () => {
    const body = `<marker id="m" overflow="visible"><path stroke="red" d="M0 0h2"/></marker><path d="M10 10h10" stroke-width="3" marker-end="url(#m)"/>`;
    expect((await shapes(body))[1]).toBe("M20 10L26 10");
  });

  it("are not placed inside an arc", async () => {
    expect(await marked("", 'd="M10 10A10 10 0 0 1 30 10" marker-mid="url(#m)"')).toEqual([]);
  });

  it("take the line's colour on request", async () => {
    const drawing = await draw(
      `<marker id="m"><path fill="none" stroke="context-stroke" d="M0 0h2"/></marker><path d="M10 10h10" stroke="blue" marker-end="url(#m)"/>`,
    );
    expect(strokes(drawing)).toEqual(["#0000ff", "#0000ff"]);
  });

  it("do not nest", async () => {
    const body = `<marker id="m" overflow="visible"><path d="M0 0h2" marker-end="url(#m)"/></marker><path d="M10 10h10" marker-end="url(#m)"/>`;
    expect(await shapes(body)).toEqual(["M10 10L20 10", "M20 10L22 10"]);
  });
});
