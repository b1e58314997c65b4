import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../src/drawing/drawing.js";
import { pointCount, strokeCount, type StrokeSet } from "../../../src/drawing/stroke-set.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { clipOf, drawingOf } from "../../support/drawings/drawings.js";

const TRUE_SIZE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  landscape: false,
  marginMm: 0,
  fit: false,
  clipToMargins: true,
  order: "none",
};

const strokesOf = (set: StrokeSet): number[][] =>
  Array.from({ length: strokeCount(set) }, (_, i) =>
    Array.from(set.xy.subarray(2 * set.offsets[i], 2 * set.offsets[i + 1])),
  );

/** Strokes as text: "0 0 10 0 | 5 5". */
const rows = (text: string): number[][] => text.split("|").map((row) => row.trim().split(/\s+/).map(Number));

/** Rounded to 0.01 mm, for reading. */
const rounded = (strokes: number[][]): number[][] =>
  strokes.map((stroke) => stroke.map((v) => Math.round(v * 100) / 100 + 0));

const draw = (drawing: Drawing, settings: Partial<PrepareSettings> = {}): number[][] =>
  rounded(strokesOf(prepare(drawing, { ...TRUE_SIZE, ...settings }).strokes));

const grouped = (...shapes: [group: number, d: string][]): Drawing =>
  drawingOf(
    shapes.map(([group, d]) => ({ d, group })),
    { groups: ["a", "b"] },
  );

describe("placing", () => {
  it("puts page corner on paper corner at true size", () => {
    expect(draw(drawingOf(["M10 20L30 40"]))).toEqual([[10, 20, 30, 40]]);
  });

  it("fits what is drawn into the space inside the margins, centred", () => {
    const drawing = drawingOf(["M40 40L60 40L60 50L40 50Z"]);
    const settings = { fit: true, marginMm: 10, paper: { widthMm: 100, heightMm: 200 } };
    expect(draw(drawing, settings)).toEqual([[10, 80, 90, 80, 90, 120, 10, 120, 10, 80]]);
  });

  it("fits by the curve, not by its control points", () => {
    // This arch is 100 wide and 3/4 of 80 = 60 high.
    const drawing = drawingOf(["M0 0C0 80 100 80 100 0"]);
    const settings = { fit: true, paper: { widthMm: 100, heightMm: 200 }, flattenMm: 0.001 };
    const ys = draw(drawing, settings)[0].filter((_, k) => k % 2 === 1);
    expect(Math.max(...ys) - Math.min(...ys)).toBeCloseTo(60, 1);
  });

  it("lays the long side along x in landscape, however the size was given", () => {
    for (const [widthMm, heightMm] of rows("210 297 | 297 210")) {
      const paper = { widthMm, heightMm };
      const wide = prepare(drawingOf(["M0 0L1 1"]), { ...TRUE_SIZE, paper, landscape: true });
      const tall = prepare(drawingOf(["M0 0L1 1"]), { ...TRUE_SIZE, paper, landscape: false });
      expect([wide.paperWidthMm, wide.paperHeightMm]).toEqual([297, 210]);
      expect([tall.paperWidthMm, tall.paperHeightMm]).toEqual([210, 297]);
    }
  });

  it("turns clockwise on screen, and keeps the turned page at the paper's corner", () => {
    // The top edge of a 100 × 50 page becomes the right edge of a 50 × 100 one.
    const drawing = drawingOf(["M0 0L100 0"], { widthMm: 100, heightMm: 50 });
    expect(draw(drawing, { rotateDeg: 90 })).toEqual([[50, 0, 50, 100]]);
  });

  it("keeps the scale of the whole drawing when a layer is hidden, so that layers meet", () => {
    const drawing = grouped([0, "M0 0L10 10"], [1, "M0 0L100 100"]);
    const settings = { fit: true, paper: { widthMm: 200, heightMm: 200 } };
    expect(draw(drawing, { ...settings, hiddenLayers: ["g1"] })).toEqual([[0, 0, 20, 20]]);
  });

  it("refuses margins that leave no room, with the figures", () => {
    expect(() => prepare(drawingOf(["M0 0L1 1"]), { ...TRUE_SIZE, marginMm: 105 })).toThrow(
      expect.objectContaining({ code: "bad-setting", message: expect.stringContaining("105 mm") }),
    );
  });

  it("ignores a shape a million kilometres away when fitting, and reports it", () => {
    const drawing = drawingOf(["M0 0L1e300 1e300", "M10 10L20 20"]);
    const prepared = prepare(drawing, { ...TRUE_SIZE, fit: true, paper: { widthMm: 100, heightMm: 100 } });
    expect(rounded(strokesOf(prepared.strokes))).toEqual([[0, 0, 100, 100]]);
    expect(prepared.warnings.join()).toContain("1 shape is much too far");
  });
});

describe("shaping", () => {
  const dashed = (d: string, lengths: number[], offset = 0): Drawing =>
    drawingOf([{ d, dash: 0 }], { dashes: [{ lengths, offset }] });

  it("closes a closed subpath exactly and continues from its start", () => {
    expect(draw(drawingOf(["M10 10L20 10L20 20ZL0 0"]), { joinMm: 0 })).toEqual(
      rows("10 10 20 10 20 20 10 10 | 10 10 0 0"),
    );
  });

  it("draws a subpath of length 0 as a dot, and a lone move not at all", () => {
    expect(draw(drawingOf(["M10 10L10 10", "M20 20Z", "M30 30"]))).toEqual(rows("10 10 | 20 20"));
  });

  it("draws a filled shape without stroke as its closed outline in the colour of its fill", () => {
    const drawing = drawingOf([{ d: "M0 0L10 0L10 10", stroke: null, fill: "#ff0000" }]);
    expect(draw(drawing)).toEqual([[0, 0, 10, 0, 10, 10, 0, 0]]);
    expect(prepare(drawing, { ...TRUE_SIZE, layers: "stroke" }).layers[0].id).toBe("#ff0000");
  });

  it("cuts dashes at the pattern's lengths after scaling, across corners, from its offset", () => {
    expect(draw(dashed("M0 0L10 0L10 10", [4, 4], 2), { joinMm: 0 })).toEqual(
      rows("0 0 2 0 | 6 0 10 0 | 10 4 10 8"),
    );
  });

  it("draws dashes of no length as dots", () => {
    expect(draw(dashed("M0 0L10 0", [0, 4]))).toEqual(rows("0 0 | 4 0 | 8 0"));
  });

  it("ends a dashed line without a dot, whatever the rounding", () => {
    const scaled = (d: string, lengths: number[], offset: number, scale: number): number[][] => {
      const path = d.replace(/\d+/g, (number) => String(Number(number) * scale));
      const scaledLengths = lengths.map((length) => length * scale);
      return draw(dashed(path, scaledLengths, offset * scale), { joinMm: 0 });
    };
    const counts = (d: string, lengths: number[], offset = 0): Set<number> =>
      new Set(Array.from({ length: 40 }, (_, k) => scaled(d, lengths, offset, 0.3 + k / 70).length));
    expect(counts("M30 50L90 50", [5, 5])).toEqual(new Set([6]));
    expect(counts("M30 20L90 20L90 80L30 80Z", [3, 2])).toEqual(new Set([48]));
    // A dash that ends exactly at the beginning of the line.
    expect(counts("M30 50L90 50", [5, 5], 25)).toEqual(new Set([6]));
    // A dot at the very end would be drawn twice on a closed line.
    expect(counts("M30 50L90 50", [0, 5])).toEqual(new Set([12]));
  });

  it("draws a pattern too fine for any pen as a solid line", () => {
    expect(draw(dashed("M0 0L100 0", [1e-9, 1e-9]))).toEqual([[0, 0, 100, 0]]);
  });
});

describe("cutting", () => {
  it("cuts a line at the margins and says how much is lost", () => {
    const prepared = prepare(drawingOf(["M0 50L500 50"]), { ...TRUE_SIZE, marginMm: 10 });
    expect(rounded(strokesOf(prepared.strokes))).toEqual([[10, 50, 200, 50]]);
    expect(prepared.warnings.join()).toContain("310 mm of line lie outside the margins");
  });

  it("says how much of a dashed line is lost, gaps included", () => {
    const dashes = [{ lengths: [10, 5], offset: 0 }];
    const warningsOf = (drawing: Drawing): readonly string[] =>
      prepare(drawing, { ...TRUE_SIZE, marginMm: 10 }).warnings;
    const [warning, ...others] = warningsOf(
      drawingOf([{ d: "M0 50L500 50", dash: 0 }, "M0 60L500 60"], { dashes }),
    );
    expect(warning).toContain("620 mm of line lie outside the margins");
    expect(others).toEqual([]);
    expect(warningsOf(drawingOf([{ d: "M10 50L200 50", dash: 0 }], { dashes }))).toEqual([]);
    // The clip, and not the margins, cuts off this one.
    const clips = [clipOf("M20 0L80 0L80 100L20 100Z")];
    expect(warningsOf(drawingOf([{ d: "M0 50L500 50", dash: 0, clip: 0 }], { dashes, clips }))).toEqual([]);
    // Too fine for dashes, so it is a solid line.
    const fine = [{ lengths: [0.01, 0.01], offset: 0 }];
    expect(warningsOf(drawingOf([{ d: "M0 50L500 50", dash: 0 }], { dashes: fine })).join()).toContain(
      "310 mm of line",
    );
  });

  it("says that the margins cut a hatch, unless its outline says so", () => {
    const wide = { d: "M-20 50L280 50L280 70L-20 70Z", stroke: null, fill: "#000000" };
    const warningsOf = (shape: typeof wide, outlineFills: boolean): string =>
      prepare(drawingOf([shape]), {
        ...TRUE_SIZE,
        marginMm: 10,
        outlineFills,
        hatch: { spacingMm: 1, angleDeg: 0, cross: false },
      }).warnings.join();
    expect(warningsOf(wide, false)).toMatch(/^Areas filled with lines lie partly outside the margins/);
    expect(warningsOf(wide, true)).toMatch(/^\d+ mm of line [^,]*$/);
    expect(warningsOf({ ...wide, d: "M20 50L80 50L80 70Z" }, false)).toBe("");
  });

  it("leaves the line whole if clipping is off", () => {
    expect(draw(drawingOf(["M-5 50L500 50"]), { marginMm: 10, clipToMargins: false })).toEqual([
      [-5, 50, 500, 50],
    ]);
  });

  it("makes one stroke of the inner part of a closed line that begins inside", () => {
    const drawing = drawingOf(["M50 50L250 50L250 60L50 60Z"]);
    expect(draw(drawing, { joinMm: 0 })).toEqual([[210, 60, 50, 60, 50, 50, 210, 50]]);
  });

  it("cuts a horizontal line that goes back over itself", () => {
    const clips = [clipOf("M60 60L140 60L130 140L60 140Z")];
    const [line, ...others] = draw(drawingOf([{ d: "M100 60.5L180 60.5L20 60.5", clip: 0 }], { clips }));
    expect(others).toEqual([]);
    expect(line).toEqual([100, 60.5, 139.94, 60.5, 60, 60.5]);
  });

  it("hides the covered part of branches that go out and back", () => {
    const tree = "M100 190L100 150L60 150L140 150L100 150L100 110L70 110L130 110L100 110L100 70";
    const cover = { d: "M80 100L120 100L120 160L80 160Z", stroke: null, fill: "#ffffff" };
    const { drawMm } = prepare(drawingOf([tree, cover]), {
      ...TRUE_SIZE,
      hideCovered: true,
      outlineFills: false,
    });
    expect(drawMm).toBeCloseTo(180, 6);
  });

  it("cuts lines to a clip region and to its parent", () => {
    const drawing = drawingOf([{ d: "M0 50L100 50", clip: 1 }], {
      clips: [clipOf("M20 0L80 0L80 100L20 100Z"), clipOf("M0 0L60 0L60 100L0 100Z", 0, 0)],
    });
    expect(draw(drawing)).toEqual([[20, 50, 60, 50]]);
  });

  it("gives a fill without a line the edge of its clip as outline", () => {
    const square = "M0 0L100 0L100 100L0 100Z";
    const clips = [clipOf("M20 20L80 20L50 80Z")];
    const fill = { d: square, clip: 0, stroke: null, fill: "#ff0000" };
    const [edge, ...others] = draw(drawingOf([fill], { clips }));
    expect(others).toEqual([]);
    const corners = new Set(Array.from({ length: 4 }, (_, i) => `${edge[2 * i]} ${edge[2 * i + 1]}`));
    expect(corners).toEqual(new Set(["20 20", "80 20", "50 80"]));
    // A shape with its own line ends at the edge without one.
    expect(draw(drawingOf([{ ...fill, stroke: "#000000" }], { clips }))).toEqual([]);
    // A clip that cuts nothing off changes nothing.
    const inside = { ...fill, d: "M45 30L55 30L50 40Z" };
    expect(draw(drawingOf([inside], { clips }))).toEqual(draw(drawingOf([{ ...inside, clip: -1 }])));
  });

  it("stretches dashes with the shape that they belong to", () => {
    // Twice as wide as it was drawn: dashes along x are twice as long as those along y.
    const dashes = [
      {
        lengths: [Math.SQRT2, Math.SQRT2],
        offset: 0,
        measure: { a: Math.SQRT1_2, b: 0, c: 0, d: Math.SQRT2 },
      },
    ];
    const [across, down] = ["M10 10L12.5 10", "M10 10L10 11.5"].map(
      (d) => draw(drawingOf([{ d, dash: 0 }], { dashes }))[0],
    );
    expect(across[2] - across[0]).toBeCloseTo(2);
    expect(down[3] - down[1]).toBeCloseTo(1);
  });

  it("follows the rule of a clip region with a hole", () => {
    const ring = "M0 0L90 0L90 90L0 90ZM30 30L60 30L60 60L30 60Z";
    const through = (rule: number): number[][] =>
      draw(drawingOf([{ d: "M10 45L80 46", clip: 0 }], { clips: [clipOf(ring, rule)] })).sort(
        (a, b) => a[0] - b[0],
      );
    expect(through(0)).toEqual([[10, 45, 80, 46]]);
    expect(through(1)).toEqual(rows("10 45 30 45.29 | 60 45.71 80 46"));
  });

  it("unites the shapes of a clip region, in either direction", () => {
    const clip = clipOf("M0 0L50 0L50 90L0 90ZM40 0L40 90L80 90L80 0Z");
    const two = { ...clip, shape: Uint32Array.from([0, 1]) };
    expect(draw(drawingOf([{ d: "M0 50L100 50", clip: 0 }], { clips: [two] }))).toEqual([[0, 50, 80, 50]]);
  });

  it("keeps a closed line in one piece when the clip cuts it elsewhere", () => {
    const drawing = drawingOf([{ d: "M50 50L95 50L95 60L50 60Z", clip: 0 }], {
      clips: [clipOf("M0 0L80 0L80.5 100L0 100Z")],
    });
    expect(draw(drawing, { joinMm: 0 })).toHaveLength(1);
  });
});

describe("joining and dropping", () => {
  const drawJoined = (drawing: Drawing, settings: Partial<PrepareSettings> = {}): number[][] =>
    draw(drawing, { order: "fast", ...settings });

  it("joins near ends in either direction, only within a layer", () => {
    const lines = ["M0 0L10 0", "M20 0L10.05 0"];
    expect(drawJoined(drawingOf(lines))).toEqual([[0, 0, 10, 0, 10.05, 0, 20, 0]]);
    expect(drawJoined(grouped([0, lines[0]], [1, lines[1]]))).toHaveLength(2);
    expect(drawJoined(drawingOf(lines), { joinMm: 0.04 })).toHaveLength(2);
    expect(drawJoined(drawingOf(lines), { joinMm: 0 })).toHaveLength(2);
  });

  it("closes a loop of four lines", () => {
    const square = drawingOf(["M0 0L10 0", "M10 0L10 10", "M0 10L10 10", "M0 10L0 0"]);
    expect(drawJoined(square)).toEqual([[0, 0, 10, 0, 10, 10, 0, 10, 0, 0]]);
  });

  it("continues straight where lines cross", () => {
    const cross = drawingOf(["M0 5L5 5", "M5 0L5 5", "M5 5L10 5", "M5 5L5 10"]);
    expect(drawJoined(cross)).toEqual(rows("0 5 5 5 10 5 | 5 0 5 5 5 10"));
  });

  it("takes the end where the pen turns least, also across a gap", () => {
    const fork = drawingOf(["M0 0L10 0", "M10.02 0L10.02 9", "M10.03 0L20 0"]);
    expect(drawJoined(fork)).toContainEqual([0, 0, 10, 0, 10.03, 0, 20, 0]);
    const far = drawingOf(["M0 0L10 0", "M10.02 0L10.02 9", "M10.09 0L20 0"]);
    expect(drawJoined(far)).toContainEqual([0, 0, 10, 0, 10.02, 0, 10.02, 9]);
  });

  it("never makes one stroke of two colours", () => {
    const shapes = [
      { d: "M0 0L10 0", stroke: "#ff0000" },
      { d: "M10 0L20 0", stroke: "#0000ff" },
      { d: "M20 0L30 0", stroke: "#0000ff" },
    ];
    for (const order of ["none", "fast", "best"] as const)
      expect(draw(drawingOf(shapes), { order })).toEqual(rows("0 0 10 0 | 10 0 20 0 30 0"));
  });

  it("keeps the file's order and directions if lines are not ordered", () => {
    const lines = ["M10 10L50 10", "M10 30L50 30", "M90 10L50 10"];
    expect(draw(drawingOf(lines))).toEqual(rows("10 10 50 10 | 10 30 50 30 | 90 10 50 10"));
    const sorted = ["M0 0L10 0", "M10.05 0L20 0", "M20 0L20 5", "M5 5L20 5", "M30 0L40 0", "M0 20L40 0"];
    expect(draw(drawingOf(sorted))).toEqual(
      rows("0 0 10 0 10.05 0 20 0 20 5 | 5 5 20 5 | 30 0 40 0 | 0 20 40 0"),
    );
    const closed = ["M0 0L5 0L5 5L0 0", "M0 0L9 9", "M9 9L9 9", "M9 9L3 3"];
    expect(draw(drawingOf(closed))).toHaveLength(4);
  });

  it("does not bend a short line onto itself", () => {
    expect(draw(drawingOf(["M0 0L0.05 0"]))).toEqual([[0, 0, 0.05, 0]]);
  });

  it("keeps dots apart, and drops them only if short strokes are dropped", () => {
    const drawing = drawingOf(["M5 5L5 5", "M5 5L5 5", "M5 5L6 5"]);
    expect(draw(drawing)).toHaveLength(3);
    expect(draw(drawing, { dropShorterMm: 0.5 })).toEqual([[5, 5, 6, 5]]);
  });

  it("simplifies within its tolerance", () => {
    expect(draw(drawingOf(["M0 0L5 0.01L10 0L15 1L20 0"]), { simplifyMm: 0.05 })).toEqual([
      [0, 0, 10, 0, 15, 1, 20, 0],
    ]);
  });
});

describe("layers", () => {
  const drawing = drawingOf(
    [
      { d: "M0 0L10 0", stroke: "#ff0000", group: 0 },
      { d: "M0 5L20 5", stroke: "#0000ff", group: 1 },
      { d: "M0 9L30 9", stroke: "#ff0000", group: 1 },
    ],
    { groups: ["first", "second", "empty"] },
  );

  it("are the groups with content, with their counts and their most frequent colour", () => {
    const { layers } = prepare(drawing, TRUE_SIZE);
    expect(layers.map(({ id, name, color, strokeCount: n, drawMm }) => [id, name, color, n, drawMm])).toEqual(
      [
        ["g0", "first", "#ff0000", 1, 10],
        ["g1", "second", "#ff0000", 2, 50],
      ],
    );
  });

  it("are the stroke colours, or all in one, on request", () => {
    const byColor = prepare(drawing, { ...TRUE_SIZE, layers: "stroke" });
    expect(byColor.layers.map((layer) => [layer.id, layer.drawMm])).toEqual([
      ["#ff0000", 40],
      ["#0000ff", 20],
    ]);
    expect(prepare(drawing, { ...TRUE_SIZE, layers: "all" }).layers.map((layer) => layer.drawMm)).toEqual([
      60,
    ]);
  });

  it("are listed with their counts when hidden, and not drawn", () => {
    const prepared = prepare(drawing, { ...TRUE_SIZE, hiddenLayers: ["g0"] });
    expect(prepared.layers.map((layer) => [layer.visible, layer.strokeCount])).toEqual([
      [false, 1],
      [true, 2],
    ]);
    expect(prepared.strokes.layers.map((layer) => layer.id)).toEqual(["g1"]);
    expect([...prepared.strokes.layer]).toEqual([0, 0]);
    expect(prepared.drawMm).toBe(50);
  });

  it("are contiguous in the strokes, in the file's order", () => {
    const mixed = grouped([1, "M0 0L1 0"], [0, "M0 3L1 3"], [1, "M0 6L1 6"]);
    expect([...prepare(mixed, { ...TRUE_SIZE, order: "fast" }).strokes.layer]).toEqual([0, 1, 1]);
  });
});

describe("ordering", () => {
  it("goes to the nearest end, reversing strokes", () => {
    expect(draw(drawingOf(["M90 0L50 0", "M40 0L10 0"]), { order: "fast" })).toEqual(
      rows("10 0 40 0 | 50 0 90 0"),
    );
  });

  it("begins a closed stroke at its nearest corner", () => {
    expect(draw(drawingOf(["M20 20L20 10L10 10L10 20Z"]), { order: "fast" })).toEqual([
      [10, 10, 10, 20, 20, 20, 20, 10, 10, 10],
    ]);
  });

  it("measures travel from home through the strokes and home again", () => {
    const prepared = prepare(drawingOf(["M3 4L3 10", "M3 20L3 4.5"]), TRUE_SIZE);
    expect(prepared.travelMmUnordered).toBeCloseTo(5 + 10 + Math.hypot(3, 4.5), 9);
    expect(prepared.travelMm).toBe(prepared.travelMmUnordered);
  });
});

describe("degenerate input", () => {
  it("prepares an empty drawing to no strokes and a warning", () => {
    const prepared = prepare(drawingOf([]), DEFAULT_PREPARE);
    expect(strokeCount(prepared.strokes)).toBe(0);
    expect(pointCount(prepared.strokes)).toBe(0);
    expect(prepared.travelMm).toBe(0);
    expect(prepared.warnings).toEqual(["The file has no lines to draw."]);
  });

  it("fits a lone dot and a straight line", () => {
    const settings = { fit: true, paper: { widthMm: 100, heightMm: 100 } };
    expect(draw(drawingOf(["M7 7L7 7"]), settings)).toEqual([[50, 50]]);
    expect(draw(drawingOf(["M7 7L9 7"]), settings)).toEqual([[0, 50, 100, 50]]);
  });
});

describe("a call of prepare", () => {
  it("stops on request", () => {
    expect(() => prepare(drawingOf(["M0 0L1 1"]), TRUE_SIZE, { cancel: { aborted: true } })).toThrow(
      expect.objectContaining({ code: "cancelled" }),
    );
  });

  it("reports progress that never decreases and ends at 1", () => {
    const seen: number[] = [];
    prepare(drawingOf(["M0 0L1 1"]), DEFAULT_PREPARE, { onProgress: (done) => seen.push(done) });
    expect(seen).toEqual([...seen].sort((a, b) => a - b));
    expect(seen.at(-1)).toBe(1);
  });
});
