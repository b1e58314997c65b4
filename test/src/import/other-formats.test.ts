import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { DRAWING_EXTENSIONS, formatOf, importDrawing, isDrawingName } from "../../../src/import/registry.js";
import { codes, pointsOf, shapesOf } from "../../support/import/shapes.js";

/** Group codes and values, as lines of a DXF. */
const dxf = (entities: string, more: { header?: string; tables?: string; blocks?: string } = {}): string =>
  [
    `0 SECTION 2 HEADER ${more.header ?? "9 $INSUNITS 70 4"} 0 ENDSEC`,
    more.tables === undefined ? "" : `0 SECTION 2 TABLES 0 TABLE 2 LAYER ${more.tables} 0 ENDTAB 0 ENDSEC`,
    more.blocks === undefined ? "" : `0 SECTION 2 BLOCKS ${more.blocks} 0 ENDSEC`,
    `0 SECTION 2 ENTITIES ${entities} 0 ENDSEC 0 EOF`,
  ]
    .join(" ")
    .trim()
    .split(/\s+/)
    .join("\n");

const draw = (entities: string, more?: Parameters<typeof dxf>[1]) =>
  importDrawing("a.dxf", dxf(entities, more));
const FRAME = "0 LINE 8 0 10 0 20 0 11 100 21 100";
const DOWN = "210 0 220 0 230 -1";
/** A POLYLINE whose extrusion points down. */
const polyline = (flags: number): string =>
  `0 POLYLINE 8 0 66 1 70 ${flags} ${DOWN} 0 VERTEX 8 0 10 50 20 0 0 VERTEX 8 0 10 55 20 5 0 SEQEND`;

describe("the registry of formats", () => {
  it("knows a file by each of its endings, in any case", () => {
    expect(DRAWING_EXTENSIONS).toEqual(["svg", "dxf", "hpgl", "hpg", "hgl", "plt", "json"]);
    for (const extension of DRAWING_EXTENSIONS)
      expect(isDrawingName(`a.b.${extension.toUpperCase()}`)).toBe(true);
    expect(["svg", "a.svg.txt", "a"].filter(isDrawingName)).toEqual([]);
  });
});

describe("DXF", () => {
  it("flips y and takes the page from the drawing", async () => {
    const drawing = await draw("0 LINE 8 0 10 10 20 20 11 30 21 60");
    expect([drawing.widthMm, drawing.heightMm]).toEqual([20, 40]);
    expect(shapesOf(drawing)).toEqual(["M0 40L20 0"]);
  });

  it.each([
    ["inches", "1", 25.4],
    ["feet", "2", 304.8],
    ["cm", "5", 10],
    ["m", "6", 1000],
  ])("reads units: %s", async (_name, unit, mm) => {
    const drawing = await draw("0 LINE 8 0 10 0 20 0 11 1 21 1", { header: `9 $INSUNITS 70 ${unit}` });
    expect(drawing.widthMm).toBeCloseTo(mm, 9);
  });

  it("reports missing units", async () => {
    expect(codes(await draw(FRAME, { header: "9 $ACADVER 1 AC1009" }))).toEqual(["page-size"]);
  });

  it("draws a circle and an arc on their circle", async () => {
    const drawing = await draw(
      `${FRAME} 0 CIRCLE 8 0 10 50 20 50 40 30 0 ARC 8 0 10 50 20 50 40 20 50 350 51 80`,
    );
    for (const [x, y] of pointsOf(drawing, 1)) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(30, 4);
    const arc = pointsOf(drawing, 2);
    for (const [x, y] of arc) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(20, 4);
    expect(arc[0][0]).toBeCloseTo(50 + 20 * Math.cos((350 * Math.PI) / 180), 6);
    expect(Math.max(...arc.map(([x]) => x))).toBeCloseTo(70, 4);
  });

  it("draws an ellipse by its axes", async () => {
    const drawing = await draw(
      `${FRAME} 0 ELLIPSE 8 0 10 50 20 50 11 0 21 40 40 0.5 41 0 42 6.283185307179586`,
    );
    for (const [x, y] of pointsOf(drawing, 1))
      expect(Math.hypot((x - 50) / 20, (y - 50) / 40)).toBeCloseTo(1, 5);
  });

  it.each([
    ["mirrors a circle", `0 CIRCLE 8 0 10 50 20 0 40 5 ${DOWN}`, -55, -45],
    ["mirrors an arc", `0 ARC 8 0 10 50 20 0 40 5 50 0 51 90 ${DOWN}`, -55, -50],
    ["mirrors a solid", `0 SOLID 8 0 10 50 20 0 11 55 21 0 12 50 22 5 13 55 23 5 ${DOWN}`, -55, -50],
    ["mirrors a new polyline", `0 LWPOLYLINE 8 0 90 2 70 0 10 50 20 0 10 55 20 5 ${DOWN}`, -55, -50],
    ["mirrors a 2D polyline", polyline(0), -55, -50],
    ["keeps a 3D polyline", polyline(8), 50, 55],
    ["keeps a line", `0 LINE 8 0 10 10 20 0 11 20 21 0 ${DOWN}`, 10, 20],
    ["keeps a point", `0 POINT 8 0 10 10 20 0 ${DOWN}`, 10, 10],
    ["keeps a face", `0 3DFACE 8 0 10 10 20 0 11 20 21 0 12 20 22 5 13 10 23 5 ${DOWN}`, 10, 20],
    ["keeps a spline", `0 SPLINE 8 0 71 1 40 0 40 0 40 1 40 1 10 10 20 0 10 20 20 5 ${DOWN}`, 10, 20],
  ])("%s whose extrusion points down", async (_name, entity, from, to) => {
    const drawing = await draw(`${FRAME} ${entity}`);
    const [[zero]] = pointsOf(drawing, 0);
    const xs = pointsOf(drawing, 1).map(([x]) => x - zero);
    expect(Math.min(...xs)).toBeCloseTo(from, 4);
    expect(Math.max(...xs)).toBeCloseTo(to, 4);
  });

  it.each([
    ["11 40 21 0", [90, 50], [50, 70]],
    ["11 0 21 40", [50, 10], [70, 50]],
  ])("draws an ellipse clockwise if its extrusion points down: %s", async (axis, start, end) => {
    const quarter = `41 0 42 ${Math.PI / 2}`;
    const drawing = await draw(`${FRAME} 0 ELLIPSE 8 0 10 50 20 50 ${axis} 40 0.5 ${quarter} ${DOWN}`);
    const points = pointsOf(drawing, 1).map((point) => point.map((mm) => Math.round(mm * 100) / 100));
    expect([points[0], points.at(-1)]).toEqual([start, end]);
    for (const at of [0, 1]) {
      const values = points.map((point) => point[at]);
      const ends = [start[at], end[at]];
      expect([Math.min(...values), Math.max(...values)]).toEqual([Math.min(...ends), Math.max(...ends)]);
    }
  });

  it("draws bulges as arcs on the right side", async () => {
    // From (0, 0) to (10, 0) with bulge 1: a half circle below, since it runs anticlockwise.
    const drawing = await draw("0 LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 1 10 10 20 0");
    expect(drawing.heightMm).toBeCloseTo(5, 4);
    for (const [x, y] of pointsOf(drawing)) expect(Math.hypot(x - 5, y - 0)).toBeCloseTo(5, 4);
  });

  it("closes polylines, old and new", async () => {
    const body =
      "0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 10 10 20 0 10 10 20 10 0 POLYLINE 8 0 66 1 70 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 10 20 0 0 VERTEX 8 0 10 10 20 10 0 SEQEND";
    expect(shapesOf(await draw(body))).toEqual(["M0 10L10 10L10 0Z", "M0 10L10 10L10 0Z"]);
  });

  it("keeps the vertices of a polyline with other groups between them", async () => {
    // 91 is a vertex's number, 40 and 41 its widths.
    const body =
      "0 LWPOLYLINE 8 0 90 3 70 0 43 0 10 0 20 0 91 1 10 10 20 0 40 1 41 1 42 0 91 2 10 10 91 3 20 10";
    expect(shapesOf(await draw(body))).toEqual(["M0 10L10 10L10 0"]);
    const apart = "0 LWPOLYLINE 8 0 90 2 10 0 91 1 20 0 10 10 91 2 20 10";
    expect(shapesOf(await draw(apart))).toEqual(["M0 10L10 0"]);
  });

  it("draws a cubic B-spline according to its knots", async () => {
    // Clamped, one span: a Bézier curve.
    const knots = "40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1";
    const points = "10 0 20 0 10 0 20 100 10 100 20 100 10 100 20 0";
    const drawing = await draw(`${FRAME} 0 SPLINE 8 0 70 8 71 3 72 8 73 4 ${knots} ${points}`);
    expect(shapesOf(drawing)[1]).toBe("M0 100C0 0 100 0 100 100");
  });

  it("joins the spans of a spline without a gap", async () => {
    const knots = "40 0 40 0 40 0 40 0 40 1 40 2 40 2 40 2 40 2";
    const points = "10 0 20 0 10 0 20 60 10 50 20 100 10 100 20 60 10 100 20 0";
    const [, spline] = shapesOf(await draw(`${FRAME} 0 SPLINE 8 0 70 8 71 3 72 9 73 5 ${knots} ${points}`));
    // At the middle knot: (1/4, 1/2, 1/4) of the inner control points.
    expect(spline).toBe("M0 100C0 40 25 20 50 20C75 20 100 40 100 100");
  });

  it("makes a layer of each layer of the file, with its colour, and omits hidden ones", async () => {
    const tables =
      "0 LAYER 2 cut 70 0 62 1 6 CONTINUOUS 0 LAYER 2 fold 70 0 62 5 6 CONTINUOUS 0 LAYER 2 off 70 0 62 -3 6 CONTINUOUS 0 LAYER 2 ice 70 1 62 3 6 CONTINUOUS";
    const line = (layer: string): string => `0 LINE 8 ${layer} 10 0 20 0 11 9 21 9`;
    const drawing = await draw(`${line("cut")} ${line("fold")} ${line("off")} ${line("ice")}`, { tables });
    expect(drawing.groups.map(({ name, hidden }) => [name, hidden])).toEqual([
      ["cut", false],
      ["fold", false],
      ["off", true],
      ["ice", true],
    ]);
    expect(drawing.colors).toEqual(["#ff0000", "#0000ff"]);
    expect(codes(drawing)).toContain("hidden-layer");
  });

  it("places blocks, scaled, turned and in rows", async () => {
    const blocks = "0 BLOCK 8 0 2 B 70 0 10 0 20 0 3 B 0 LINE 8 0 10 0 20 0 11 1 21 0 0 ENDBLK";
    const insert = "0 INSERT 8 0 2 B 10 10 20 0 41 2 42 2 50 90";
    expect(shapesOf(await draw(`${FRAME} ${insert}`, { blocks }))[1]).toBe("M10 100L10 98");
    const row = "0 INSERT 8 0 2 B 10 0 20 0 70 3 44 10";
    expect(shapesOf(await draw(`${FRAME} ${row}`, { blocks })).length).toBe(4);
  });

  it("stops at blocks that contain themselves", async () => {
    const blocks = "0 BLOCK 8 0 2 B 70 0 10 0 20 0 3 B 0 INSERT 8 0 2 B 10 0 20 0 0 ENDBLK";
    expect(codes(await draw(`${FRAME} 0 INSERT 8 0 2 B 10 0 20 0`, { blocks }))).toContain("circular-use");
  });

  it("reports what it does not draw", async () => {
    expect(codes(await draw(`${FRAME} 0 TOLERANCE 8 0`))).toContain("not-supported");
  });

  it.each(["0\nSECTION\n2\nENTITIES\n0\nLINE\n8", "AutoCAD Binary DXF\r\n\u001a", "0\nSECTION\n"])(
    "refuses the damaged file %j",
    async (text) => {
      await expect(importDrawing("a.dxf", text)).rejects.toThrow(PlotwrightError);
    },
  );
});

describe("a damaged DXF", () => {
  it("is refused with the first line that is not what it should be", async () => {
    const text = dxf("0 LINE 8 0 10 0 20 0 11 9 21 9").split("\n");
    const lost = [...text.slice(0, 17), ...text.slice(18)].join("\n");
    await expect(importDrawing("a.dxf", lost)).rejects.toThrow(/line 27: "ENDSEC" is not a group code/);
    await expect(importDrawing("a.dxf", text.join("\r"))).resolves.not.toThrow();
    await expect(importDrawing("a.dxf", `${text.join("\r\n")}\r\n\r\n`)).resolves.not.toThrow();
  });
});

describe("HPGL", () => {
  const hpgl = (text: string) => importDrawing("a.plt", text);

  it("draws by pen, in plotter units of 0.025 mm, with y flipped", async () => {
    const drawing = await hpgl("IN;SP1;PU0,0;PD400,0,400,800;PU;SP2;PA0,0;PD;PA400,800;PU;SP0;");
    expect([drawing.widthMm, drawing.heightMm]).toEqual([10, 20]);
    expect(drawing.groups.map((group) => group.name)).toEqual(["Pen 1", "Pen 2"]);
    expect(shapesOf(drawing)[0]).toBe("M0 20L10 20L10 0");
    expect([...drawing.paths.group]).toEqual([0, 1]);
  });

  it("switches between relative and absolute", async () => {
    expect(shapesOf(await hpgl("IN;SP1;PU400,400;PR;PD400,0,0,400;PA;PD0,0;"))).toEqual([
      "M10 10L20 10L20 0L0 20",
    ]);
  });

  it("draws circles and arcs", async () => {
    const drawing = await hpgl("IN;SP1;PU4000,4000;CI2000;PU6000,4000;PD;AA4000,4000,90;");
    for (const [x, y] of pointsOf(drawing, 0)) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(50, 4);
    const arc = pointsOf(drawing, drawing.paths.count - 1);
    expect(arc[arc.length - 1][0]).toBeCloseTo(50, 6);
    expect(arc[arc.length - 1][1]).toBeCloseTo(0, 6);
  });

  it("draws edge rectangles", async () => {
    expect(shapesOf(await hpgl("IN;SP1;PU0,0;EA400,800;"))).toEqual(["M0 20L10 20L10 0L0 0Z"]);
  });

  it("scales by IP and SC", async () => {
    expect(shapesOf(await hpgl("IN;IP0,0,4000,4000;SC0,10,0,10;SP1;PU0,0;PD10,10;"))).toEqual([
      "M0 100L100 0",
    ]);
  });

  it("reads encoded polylines", async () => {
    // Base 64: 0 is "¿" (191), 20 is (63 + 40 as last digit: 191 + 40).
    const twenty = String.fromCharCode(191 + 40);
    const zero = String.fromCharCode(191);
    const drawing = await hpgl(`IN;SP1;PE<=${zero}${zero}${twenty}${zero}${zero}${twenty};`);
    expect(shapesOf(drawing)).toEqual(["M0 0.5L0.5 0.5L0.5 0"]);
  });

  it("draws absolutely and in plotter units again after IN and DF", async () => {
    const afterReset = async (reset: string): Promise<string> =>
      shapesOf(await hpgl(`IN;SP1;PU0,0;PR;PD1000,0;PU;${reset};SP1;PU2000,2000;PD3000,2000;PU;`))[1];
    expect(await afterReset("IN")).toBe("M50 0L75 0");
    expect(await afterReset("DF")).toBe("M50 0L75 0");
    const scaled = async (reset: string): Promise<string[]> =>
      shapesOf(await hpgl(`IN;IP0,0,4000,4000;SC0,10,0,10;SP1;PU0,0;PD10,0;${reset};SP2;PU0,0;PD4000,0;`));
    expect(await scaled("IN")).toEqual(["M0 0L100 0", "M0 0L100 0"]);
    expect(await scaled("DF")).toEqual(["M0 0L100 0", "M0 0L100 0"]);
  });

  it("resets P1 and P2 by IN, and keeps them by DF", async () => {
    const scaledAfter = async (reset: string): Promise<string[]> =>
      shapesOf(await hpgl(`IN;IP0,0,4000,4000;${reset};SC0,10,0,10;SP1;PU0,0;PD10,10;`));
    expect(await scaledAfter("IN")).toEqual(["M0 250L250 0"]);
    expect(await scaledAfter("DF")).toEqual(["M0 100L100 0"]);
  });

  it("lifts the pen by IN, and not by DF", async () => {
    const movedAfter = async (reset: string): Promise<string[]> =>
      shapesOf(await hpgl(`IN;SP1;PU0,0;PD400,0;${reset};PA800,0;PD1200,0;`));
    expect(await movedAfter("IN")).toEqual(["M0 0L10 0", "M20 0L30 0"]);
    expect(await movedAfter("DF")).toEqual(["M0 0L10 0L20 0L30 0"]);
  });

  it.each([
    [
      "dashes that are fitted to each line",
      "LT-2,4;PD400,0;",
      "effect-ignored",
      "(LT-2: dashes not fitted to each line)",
    ],
    ["shadings", "PD400,0;FT10,50;WG800,0,90;", "effect-ignored", "(FT10: filled as a solid area)"],
    ["unknown commands", "PD400,0;QQ1,2;", "not-supported", "(QQ)"],
    [
      "pages on top of each other",
      "PD400,0;PG;PU0,0;PD400,400;PU;PD0,0;",
      "effect-ignored",
      "(PG: drawn on top of the page before)",
    ],
  ])("reports %s", async (_name, commands, code, detail) => {
    const { warnings } = await hpgl(`IN;SP1;PU0,0;${commands}`);
    expect(warnings.map((warning) => [warning.code, warning.count])).toEqual([[code, 1]]);
    expect(warnings[0].message).toContain(detail);
  });

  it.each([
    ["solid lines", "LT;PD400,0;"],
    ["a window that is the whole page", "IW;PD400,0;"],
    ["a page that ends the file", "PD400,0;PU;PG;IN;SP0;"],
    ["a page with nothing on it", "PG;PD400,0;"],
  ])("does not report %s", async (_name, commands) => {
    expect(codes(await hpgl(`IN;SP1;PU0,0;${commands}`))).toEqual([]);
  });

  it("needs no separators", async () => {
    expect(shapesOf(await hpgl("INSP1PU0,0PD400,0PU"))).toEqual(["M0 0L10 0"]);
  });
});

describe("JSON polylines", () => {
  const json = (value: unknown) => importDrawing("a.json", JSON.stringify(value));

  it("reads flat and paired points, and dots", async () => {
    const drawing = await json({
      widthMm: 50,
      heightMm: 40,
      layers: [
        {
          name: "A",
          color: "red",
          strokes: [
            [0, 0, 10, 5],
            [
              [1, 2],
              [3, 4],
            ],
            [7, 8],
          ],
        },
        { strokes: [[0, 0, 1, 1]] },
      ],
    });
    expect(shapesOf(drawing)).toEqual(["M0 0L10 5", "M1 2L3 4", "M7 8L7 8", "M0 0L1 1"]);
    expect(drawing.groups.map((group) => group.name)).toEqual(["A", "Layer 2"]);
    expect(drawing.colors).toEqual(["#ff0000", "#000000"]);
    expect([drawing.widthMm, drawing.heightMm]).toEqual([50, 40]);
  });

  it.each([
    [[]],
    [{}],
    [{ layers: [{}] }],
    [{ layers: [{ strokes: [[1]] }] }],
    [{ layers: [{ strokes: [["a", 1]] }] }],
    [{ layers: [{ strokes: [[1, null]] }] }],
    [{ widthMm: -1, heightMm: 5, layers: [] }],
    [{ layers: [{ color: "nope", strokes: [] }] }],
  ])("refuses %j and shows the expected form", async (value) => {
    await expect(json(value)).rejects.toThrow(/widthMm/);
  });
});

describe("importDrawing", () => {
  it.each([
    ["a.txt", "<svg/>", "svg"],
    ["a.svg", "\ufeff  <?xml version='1.0'?><svg/>", "svg"],
    ["a.svg", "0\nSECTION\n2\nHEADER\n", "dxf"],
    ["a.dxf", "999\r\ncomment\r\n0\r\nSECTION", "dxf"],
    ["a", "\u001b.@;\u001b.(IN;SP1;", "hpgl"],
    ["a", "IN;PU0,0;", "hpgl"],
    ["a", ' { "layers": [] }', "json"],
    ["a.plt", "XX1;", "hpgl"],
    ["a.txt", "just words", null],
    ["a.constructor", "just words", null],
  ])("reads %s with %j as %s", (name, text, format) => {
    expect(formatOf(name, text)).toBe(format);
  });

  it("lists the readable formats if it can read nothing", async () => {
    await expect(importDrawing("notes.txt", "just words")).rejects.toThrow(/notes\.txt.*SVG, DXF, HPGL/);
    await expect(importDrawing("a.pdf", "%PDF-1.4")).rejects.toThrow(/PDF/);
  });
});
