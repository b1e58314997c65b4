/** Each kind of DXF entity as a CAD program plots it: layers, splines, linetypes, filled shapes, meshes, notes. */
import { describe, expect, it } from "vitest";
import { strokeCount } from "../../../../src/drawing/stroke-set.js";
import { prepare } from "../../../../src/prepare/prepare.js";
import type { Drawing } from "../../../../src/index.js";
import { drawParts as draw, lineOn as line } from "../../../support/import/dxf.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const layer = (name: string, more = ""): string => `|0 LAYER|2 ${name}|70 0|62 7|6 CONTINUOUS${more}`;
const message = ({ warnings }: Drawing, code: string): string | undefined =>
  warnings.find((warning) => warning.code === code)?.message;
const lengthOf = (points: readonly (readonly number[])[]): number =>
  points.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - points[i][0], y - points[i][1]), 0);

describe("a layer", () => {
  it("that is not plotted, and Defpoints in any letters, are listed but not drawn", async () => {
    const tables = layer("INK") + layer("GUIDE", "|290 0") + layer("PLOTTED", "|290 1") + layer("DefPoints");
    const drawing = await draw(
      `${line("INK", 0)}${line("GUIDE", 10)}${line("PLOTTED", 20)}|0 POINT|8 DEFPOINTS|10 25|20 20`,
      { tables },
    );
    expect(drawing.groups.filter(({ hidden }) => hidden).map(({ name }) => name)).toEqual([
      "GUIDE",
      "DefPoints",
    ]);
    expect(shapesOf(drawing)).toEqual(["M0 20L50 20", "M0 0L50 0"]);
  });

  it("named Defpoints is not drawn inside a block, and without an entry in the table", async () => {
    const blocks = `|0 BLOCK|8 0|2 D|10 0|20 0|0 POINT|8 defpoints|10 90|20 90${line("0", 0)}|0 ENDBLK`;
    expect(shapesOf(await draw("|0 DIMENSION|8 0|2 D|10 0|20 0", { blocks }))).toEqual(["M0 0L50 0"]);
  });

  it("has one entry, whatever the letters of its name", async () => {
    const drawing = await draw(line("ink", 0) + line("INK", 9) + line("Off", 20), {
      tables: layer("Ink") + layer("OFF").replace("62 7", "62 -7"),
    });
    expect(drawing.groups.map(({ name, hidden }) => [name, hidden])).toEqual([
      ["Ink", false],
      ["OFF", true],
    ]);
    expect([...drawing.paths.group]).toEqual([0, 0]);
  });

  const blocks = `|0 BLOCK|8 0|2 B|10 0|20 0${line("INK", 0)}${line("0", 5)}|0 ENDBLK`;
  it.each([
    ["off", layer("X").replace("62 7", "62 -7"), ["M0 20L50 20", "M0 0L50 0"]],
    ["not plotted", layer("X", "|290 0"), ["M0 20L50 20", "M0 0L50 0"]],
    ["frozen", layer("X").replace("70 0", "70 1"), ["M0 0L50 0"]],
  ])("that is %s hides of a copied block what AutoCAD hides", async (_what, x, shapes) => {
    const drawing = await draw(`|0 INSERT|8 X|2 B|10 0|20 0${line("INK", 20)}`, {
      tables: layer("INK") + x,
      blocks,
    });
    expect(shapesOf(drawing).sort()).toEqual([...shapes].sort());
  });
});

describe("an odd value", () => {
  it.each(["290 2", "290 x", "291 7", "299 -1", "60 ", "370 thick"])(
    "in a group that does not matter refuses nothing: %s",
    async (group) => {
      expect(shapesOf(await draw(line("A", 0, `|${group}`), { tables: layer("A", `|${group}`) }))).toEqual([
        "M0 0L50 0",
      ]);
    },
  );

  it.each(["11 abc", "11 ", "21 1.#QNAN", "11 1,5", "10 0x10"])(
    "in an entity leaves out that entity, says so, and draws the rest: %s",
    async (group) => {
      const drawing = await draw(`|0 LINE|8 A|${group}|10 0|20 0|11 1|21 1${line("B", 3)}`);
      expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
      const [code, value] = [group.slice(0, 2), group.slice(3)];
      expect(message(drawing, "object-unreadable")).toContain(
        `(LINE on layer A: group ${code} is "${value}", not a number)`,
      );
    },
  );

  it.each(["62 red", "48 fine", "67 no"])("of the look is ignored and said: %s", async (group) => {
    const drawing = await draw(line("A", 0, `|${group}`));
    expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
    expect(codes(drawing)).toEqual(["attribute-fault"]);
  });

  it("in a table leaves out that entry and says so", async () => {
    const drawing = await draw(line("A", 0), { tables: layer("A").replace("62 7", "62 seven") });
    expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
    expect(message(drawing, "attribute-fault")).toContain(`LAYER A: group 62 is "seven"`);
  });

  it("may be a number as Fortran writes it", async () => {
    expect((await draw("|0 LINE|8 0|10 0|20 0|11 1.5D+01|21 -.5d0")).widthMm).toBe(15);
  });
});

describe("coordinates of a map", () => {
  it("keep their size and precision, whatever their distance from the origin", async () => {
    const at = (x: number, y: number): string =>
      `|0 LINE|8 0|10 ${x}|20 ${y}|11 ${x + 200}|21 ${y}|0 LINE|8 0|10 ${x + 200}|20 ${y}|11 ${x + 200}|21 ${y + 100}` +
      `|0 ARC|8 0|10 ${x + 100}|20 ${y}|40 50|50 0|51 90`;
    const near = await draw(at(0, 0));
    const far = await draw(at(652381500.25, 6862047250.5));
    expect([far.widthMm, far.heightMm]).toEqual([200, 100]);
    expect(codes(far)).toEqual([]);
    near.paths.coords.forEach((mm, i) => expect(Math.abs(far.paths.coords[i] - mm)).toBeLessThan(5e-6));
  });

  it("that cannot be on earth are left out and said", async () => {
    const drawing = await draw(`${line("0", 0)}|0 LINE|8 0|10 0|20 0|11 1e20|21 0`);
    expect(drawing.widthMm).toBe(50);
    expect(codes(drawing)).toEqual(["coordinates-out-of-range"]);
  });
});

describe("a SPLINE", () => {
  const CORNERS = [
    [60, 50],
    [60, 60],
    [50, 60],
    [40, 60],
    [40, 50],
    [40, 40],
    [50, 40],
    [60, 40],
    [60, 50],
  ];
  const points = CORNERS.map(([x, y]) => `|10 ${x}|20 ${y}`).join("");
  const knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4].map((knot) => `|40 ${knot}`).join("");
  const circle = (weights: readonly number[]): string =>
    `|0 SPLINE|8 0|70 4|71 2${knots}${weights.map((weight) => `|41 ${weight}`).join("")}${points}`;
  const w = Math.SQRT1_2;

  it.each([1, 3, 0.01])("with weights is exact: a circle, times %f", async (factor) => {
    const drawing = await draw(circle([1, w, 1, w, 1, w, 1, w, 1].map((weight) => weight * factor)));
    const drawn = pointsOf(drawing);
    for (const [x, y] of drawn) expect(Math.abs(Math.hypot(x - 10, y - 10) - 10)).toBeLessThan(5e-5);
    expect(lengthOf(drawn)).toBeCloseTo(20 * Math.PI, 2);
  });

  it.each([-1, 1, 2])("with equal weights, also senseless ones, has none: %f", async (weight) => {
    expect(shapesOf(await draw(circle(CORNERS.map(() => weight))))).toEqual(shapesOf(await draw(circle([]))));
  });

  it("whose weights do not fit is left out and said", async () => {
    const drawing = await draw(line("0", 0) + circle([1, 2]) + circle([1, -1, 1, 1, 1, 1, 1, 1, 1]));
    expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
    expect(codes(drawing)).toEqual(["object-unreadable"]);
  });

  it("of degree 4 follows its curve", async () => {
    const bezier = "|10 0|20 0|10 0|20 40|10 50|20 40|10 100|20 40|10 100|20 0";
    const drawing = await draw(`|0 SPLINE|8 0|70 8|71 4${"|40 0".repeat(5)}${"|40 1".repeat(5)}${bezier}`);
    const far = pointsOf(drawing).map(([x, y]) => {
      const u = (t: number): number =>
        4 * t ** 3 * (1 - t) * 100 + 6 * t * t * (1 - t) ** 2 * 50 + t ** 4 * 100;
      let [low, high] = [0, 1];
      for (let k = 0; k < 60; k++)
        if (u((low + high) / 2) < x) low = (low + high) / 2;
        else high = (low + high) / 2;
      return Math.abs(drawing.heightMm - y - 40 * (1 - low ** 4 - (1 - low) ** 4));
    });
    expect(Math.max(...far)).toBeLessThan(1e-4);
  });

  it("through points starts and ends in the given directions", async () => {
    const fit = "|11 0|21 0|11 5|21 7|11 15|21 -2|11 20|21 5";
    const [shape] = shapesOf(await draw(`|0 SPLINE|8 0|70 8|71 3|74 4|12 0|22 9|13 2|23 0${fit}`));
    const numbers = shape
      .split(/[A-Z ]/)
      .slice(1)
      .map(Number);
    const [x0, y0, x1, y1] = numbers;
    expect(x1).toBeCloseTo(x0, 9);
    expect(y1).toBeLessThan(y0);
    const [x2, y2, x3, y3] = numbers.slice(-4);
    expect(y2).toBeCloseTo(y3, 9);
    expect(x2).toBeLessThan(x3);
  });

  it("through points bends smoothly: on a circle it is one to within 0.1 %", async () => {
    const fit = Array.from({ length: 13 }, (_, i) => [
      50 * Math.cos((i * Math.PI) / 6),
      50 * Math.sin((i * Math.PI) / 6),
    ]);
    const groups = fit.map(([x, y]) => `|11 ${x.toFixed(9)}|21 ${y.toFixed(9)}`).join("");
    const drawing = await draw(`|0 SPLINE|8 0|70 9|71 3|74 13${groups}`);
    const [left, top] = [
      Math.min(...pointsOf(drawing).map(([x]) => x)),
      Math.min(...pointsOf(drawing).map(([, y]) => y)),
    ];
    for (const [x, y] of pointsOf(drawing))
      expect(Math.hypot(x - left - 50, y - top - 50)).toBeCloseTo(50, 1);
    expect(shapesOf(drawing)[0].endsWith("Z")).toBe(true);
  });
});

describe("a linetype", () => {
  const DASH = "|0 LTYPE|2 DASH|70 0|72 65|73 2|40 15|49 10|49 -5";
  const tables = `${DASH}|0 LTYPE|2 Dots|73 2|49 -4|49 0|0 LTYPE|2 GAS|73 2|49 3|49 -1|74 2|0 LTYPE|2 NONE|73 0${layer("HID").replace("CONTINUOUS", "dash")}`;
  const lengthsOf = (drawing: Drawing): readonly (readonly number[] | null)[] =>
    Array.from(drawing.paths.dash, (dash) => (dash < 0 ? null : drawing.dashes[dash].lengths));

  it("of an entity or its layer becomes dashes, scaled by entity and file", async () => {
    const entities =
      line("0", 0, "|6 DASH") + line("HID", 1) + line("HID", 2, "|6 CONTINUOUS") + line("HID", 3, "|48 2");
    expect(lengthsOf(await draw(entities, { tables }))).toEqual([[10, 5], [10, 5], null, [20, 10]]);
    expect(lengthsOf(await draw(entities, { tables, header: "|9 $LTSCALE|40 0.5" }))).toEqual([
      [5, 2.5],
      [5, 2.5],
      null,
      [10, 5],
    ]);
  });

  it("of a copy counts for what is by block, and is scaled with the copy", async () => {
    const blocks = `|0 BLOCK|8 0|2 B|10 0|20 0${line("0", 0, "|6 BYBLOCK")}${line("0", 1)}|0 ENDBLK`;
    const insert = "|0 INSERT|8 0|6 DASH|2 B|10 0|20 0|41 3|42 3";
    expect(lengthsOf(await draw(insert, { tables, blocks }))).toEqual([[30, 15], null]);
    const onLayer = "|0 INSERT|8 HID|2 B|10 0|20 0";
    expect(lengthsOf(await draw(onLayer, { tables, blocks }))).toEqual([
      [10, 5],
      [10, 5],
    ]);
  });

  it("draws 7 dashes of 10 mm on a line of 100 mm", async () => {
    const drawing = await draw("|0 LINE|8 0|6 DASH|10 0|20 0|11 100|21 0", { tables });
    const { drawMm, strokes } = prepare(drawing, { fit: false });
    expect(strokeCount(strokes)).toBe(7);
    expect(drawMm).toBeCloseTo(70, 6);
  });

  it("of dots that begins with a gap begins with a gap", async () => {
    const drawing = await draw(line("0", 0, "|6 DOTS"), { tables });
    expect(drawing.dashes).toEqual([{ lengths: [0, 4], offset: 0 }]);
  });

  it("leaves dots, filled shapes and text solid", async () => {
    const entities =
      "|0 POINT|8 HID|10 9|20 9|0 SOLID|8 HID|10 0|20 0|11 9|21 0|12 0|22 9|0 TEXT|8 HID|10 0|20 0|40 5|1 I";
    expect(new Set(lengthsOf(await draw(entities, { tables })))).toEqual(new Set([null]));
  });

  it("with letters, or that the file lacks, is said", async () => {
    expect(codes(await draw(line("0", 0, "|6 GAS"), { tables }))).toEqual(["effect-ignored"]);
    const drawing = await draw(line("0", 0, "|6 HIDDEN"), { tables });
    expect(message(drawing, "reference-missing")).toContain("linetype hidden");
    expect(codes(await draw(line("0", 0, "|6 NONE"), { tables }))).toEqual([]);
  });
});

describe("an entity", () => {
  it("TRACE is filled as a SOLID", async () => {
    const corners = "|8 0|10 0|20 0|11 10|21 0|12 0|22 10|13 10|23 10";
    const drawing = await draw(`|0 TRACE${corners}|0 SOLID${corners}`);
    expect(shapesOf(drawing)).toEqual(["M0 10L10 10L10 0L0 0Z", "M0 10L10 10L10 0L0 0Z"]);
    expect([...drawing.paths.fill]).toEqual([0, 0]);
  });

  it("LEADER is a line with an arrow of the dimension style's size", async () => {
    const points = "|76 2|10 0|20 0|10 30|20 0|10 30|20 10";
    const header = "|9 $DIMASZ|40 3|9 $DIMSCALE|40 2";
    expect(shapesOf(await draw(`|0 LEADER|8 0|71 1${points}`, { header }))).toEqual([
      "M0 10L30 10L30 0",
      "M0 10L6 9L6 11Z",
    ]);
    expect(shapesOf(await draw(`|0 LEADER|8 0|71 0${points}`, { header }))).toEqual(["M0 10L30 10L30 0"]);
    const tables = "|0 DIMSTYLE|2 Big|40 1|41 12";
    expect(shapesOf(await draw(`|0 LEADER|8 0|71 1|3 BIG${points}`, { header, tables }))[1]).toContain(
      "L12 ",
    );
  });

  it("MLINE is its parallel lines", async () => {
    const vertex = (x: number): string => `|11 ${x}|21 0|12 1|22 0|13 0|23 1|74 1|41 2|75 0|74 1|41 -1|75 0`;
    expect(shapesOf(await draw(`|0 MLINE|8 0|72 2|73 2|10 0|20 0${vertex(0)}${vertex(40)}`))).toEqual([
      "M0 0L40 0M0 3L40 3",
    ]);
  });

  it("XLINE and RAY reach as far as the rest of the drawing, in their directions", async () => {
    const entities = `|0 XLINE|8 0|10 10|20 5|11 1|21 0|0 RAY|8 0|10 10|20 5|11 0|21 -1|0 LINE|8 0|10 0|20 0|11 50|21 20`;
    expect(shapesOf(await draw(entities))).toEqual(["M0 20L50 0", "M0 15L50 15", "M10 15L10 20"]);
    expect(codes(await draw("|0 XLINE|8 0|10 10|20 5|11 1|21 0"))).toEqual([
      "not-supported",
      "empty-drawing",
    ]);
  });

  it.each([
    ["a grid", "|70 16|71 2|72 2", "|70 64", "", "M0 10L10 10M0 0L10 0M0 10L0 0M10 10L10 0"],
    [
      "faces",
      "|70 64|71 4|72 1",
      "|70 192",
      "|0 VERTEX|8 0|10 0|20 0|70 128|71 1|72 2|73 4|74 -3",
      "M0 10L10 10L10 0L0 0",
    ],
  ])("POLYLINE of %s is drawn with its edges", async (_what, flags, flag, face, shape) => {
    const corners = [
      [0, 0],
      [10, 0],
      [0, 10],
      [10, 10],
    ]
      .map(([x, y]) => `|0 VERTEX|8 0|10 ${x}|20 ${y}${flag}`)
      .join("");
    expect(shapesOf(await draw(`|0 POLYLINE|8 0|66 1${flags}${corners}${face}|0 SEQEND|8 0`))).toEqual([
      shape,
    ]);
  });

  it("MESH is drawn with its edges, each once", async () => {
    const corners = "|92 4|10 0|20 0|10 10|20 0|10 10|20 10|10 0|20 10";
    const mesh = `|0 MESH|8 0|71 2|91 0${corners}|93 8|90 3|90 0|90 1|90 2|90 3|90 0|90 2|90 3|94 0|95 0`;
    expect(shapesOf(await draw(mesh))).toEqual(["M0 10L10 10L10 0L0 10M10 0L0 0L0 10"]);
  });

  it("3DFACE leaves out the edges that are not seen", async () => {
    const corners = "|8 0|10 0|20 0|11 10|21 0|12 10|22 10|13 0|23 10";
    expect(shapesOf(await draw(`|0 3DFACE${corners}|70 5`))).toEqual(["M10 10L10 0M0 0L0 10"]);
  });

  it("DIMENSION without a block is drawn from its points, with what it measures", async () => {
    const header = "|9 $DIMASZ|40 2|9 $DIMTXT|40 4";
    const groups = "|10 40|20 20|11 20|21 23|70 32|13 0|23 0|14 40|24 5";
    const drawing = await draw(`|0 DIMENSION|8 0|2 *D1${groups}`, { header });
    const ways = [0, 1, 2].map((shape) => {
      const [[x0, y0], [x1, y1]] = pointsOf(drawing, shape);
      return [Math.round(x1 - x0), Math.round(y0 - y1)];
    });
    // Two extension lines and the dimension line; then two arrowheads and "40".
    expect(ways).toEqual([
      [0, 20],
      [0, 15],
      [40, 0],
    ]);
    expect(drawing.paths.count).toBe(6);
    expect(drawing.widthMm).toBeCloseTo(40, 6);
    expect(codes(drawing)).toEqual(["text-substituted"]);
    expect(codes(await draw(`|0 DIMENSION|8 0|2 *D1${groups.replace("70 32", "70 34")}`))).toContain(
      "reference-missing",
    );
  });

  it("ATTDEF shows its tag outside blocks, and in copies only a text that never changes", async () => {
    const definition = (flags: number): string => `|0 ATTDEF|8 0|10 0|20 0|40 5|1 value|2 TAG|70 ${flags}`;
    expect(codes(await draw(definition(0)))).toEqual(["text-substituted"]);
    expect(codes(await draw(definition(1)))).toEqual(["empty-drawing"]);
    const block = (flags: number): string => `|0 BLOCK|8 0|2 B|10 0|20 0${definition(flags)}|0 ENDBLK`;
    expect(codes(await draw("|0 INSERT|8 0|2 B|10 0|20 0", { blocks: block(0) }))).toEqual(["empty-drawing"]);
    expect(codes(await draw("|0 INSERT|8 0|2 B|10 0|20 0", { blocks: block(2) }))).toEqual([
      "text-substituted",
    ]);
  });

  it("MULTILEADER is its lines, with arrows, and its text", async () => {
    const context = "|300 CONTEXT_DATA{|10 40|20 10|41 4|140 3|290 1|304 Oak|12 42|22 12|13 1|23 0|171 1";
    const leader = "|302 LEADER{|10 40|20 10|11 1|21 0|40 2|304 LEADER_LINE{|10 0|20 0|305 }|303 }";
    const drawing = await draw(`|0 MULTILEADER|8 0${context}${leader}|301 }|172 2`);
    expect(drawing.paths.count).toBe(4);
    expect(codes(drawing)).toEqual(["text-substituted"]);
  });
});
