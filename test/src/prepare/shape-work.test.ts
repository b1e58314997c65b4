import { describe, expect, it } from "vitest";
import { strokeCount, type StrokeSet } from "../../../src/drawing/stroke-set.js";
import { layOutDrawing } from "../../../src/prepare/layout.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { prepareSettingsSchema } from "../../../src/schema/index.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const TRUE_SIZE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  landscape: false,
  marginMm: 0,
  fit: false,
  clipToMargins: true,
  joinMm: 0,
  order: "none",
};

const strokesOf = (set: StrokeSet): number[][] =>
  Array.from({ length: strokeCount(set) }, (_, i) =>
    Array.from(
      set.xy.subarray(2 * set.offsets[i], 2 * set.offsets[i + 1]),
      (v) => Math.round(v * 1000) / 1000 + 0,
    ),
  );

const draw = (drawing: Parameters<typeof prepare>[0], settings: Partial<PrepareSettings> = {}): number[][] =>
  strokesOf(prepare(drawing, { ...TRUE_SIZE, ...settings }).strokes);

describe("place by numbers", () => {
  const drawing = drawingOf(["M40 40L60 50"]);

  it("puts the drawing's box at the given place, in the given size", () => {
    const at = { xMm: 5, yMm: 6 };
    expect(draw(drawing, { layout: { ...at, widthMm: null, heightMm: null } })).toEqual([[5, 6, 25, 16]]);
    expect(draw(drawing, { layout: { ...at, widthMm: 40, heightMm: null } })).toEqual([[5, 6, 45, 26]]);
    expect(draw(drawing, { layout: { ...at, widthMm: null, heightMm: 20 } })).toEqual([[5, 6, 45, 26]]);
    expect(draw(drawing, { layout: { ...at, widthMm: 30, heightMm: 30 } })).toEqual([[5, 6, 35, 36]]);
  });

  it("overrides the fit, and is applied after turning", () => {
    const layout = { xMm: 0, yMm: 0, widthMm: null, heightMm: null };
    expect(draw(drawing, { layout, fit: true, rotateDeg: 90 })).toEqual([[10, 0, 0, 20]]);
  });

  it("turns a placed box about its centre, and keeps its size", () => {
    const layout = { xMm: 5, yMm: 16, widthMm: 40, heightMm: null };
    expect(draw(drawing, { layout: { ...layout, turnDeg: 90 } })).toEqual([[35, 6, 15, 46]]);
    expect(draw(drawing, { layout: { ...layout, turnDeg: 0 } })).toEqual(draw(drawing, { layout }));
    const { frame, shapeBoxes } = layOutDrawing(drawing, {
      ...TRUE_SIZE,
      layout: { ...layout, turnDeg: 90 },
    });
    expect(frame).toEqual({ x0: 5, y0: 16, x1: 45, y1: 36 });
    const [{ x0, y0, x1, y1 }] = shapeBoxes();
    expect([x0, y0, x1, y1].map((v) => Math.round(v * 1e6) / 1e6)).toEqual([15, 6, 35, 46]);
  });

  it("mirrors left to right and upside down about the page", () => {
    const corner = drawingOf(["M0 0L10 20"]);
    expect(draw(corner, { mirror: "leftRight" })).toEqual([[100, 0, 90, 20]]);
    expect(draw(corner, { mirror: "upDown" })).toEqual([[0, 100, 10, 80]]);
  });

  it("applies four different margins", () => {
    const margins = { topMm: 10, rightMm: 20, bottomMm: 30, leftMm: 40 };
    const cross = drawingOf(["M0 50L300 50", "M50 0L50 300"]);
    expect(draw(cross, { margins })).toEqual([
      [40, 50, 190, 50],
      [50, 10, 50, 267],
    ]);
  });
});

describe("cropping", () => {
  it("cuts off what lies outside the file's page on request, also when it is turned", () => {
    const drawing = drawingOf(["M-50 50L150 50"]);
    const layout = { xMm: 10, yMm: 10, widthMm: null, heightMm: null };
    expect(draw(drawing, { layout })).toEqual([[10, 10, 210, 10]]);
    expect(draw(drawing, { layout, cropToPage: true })).toEqual([[10, 10, 110, 10]]);
    expect(
      prepare(drawing, { ...TRUE_SIZE, layout, cropToPage: true, clipToMargins: false }).warnings,
    ).toEqual(["100 mm of line lie outside the file's page and are cut off."]);
    const turned = prepare(drawing, { ...TRUE_SIZE, rotateDeg: 30, cropToPage: true });
    expect(turned.drawMm).toBeCloseTo(100 / Math.cos(Math.PI / 6) - 100 / Math.cos(Math.PI / 6) + 100, 2);
  });

  it("cuts off what the machine cannot reach", () => {
    expect(draw(drawingOf(["M0 10L200 10"]), { reach: { widthMm: 150, heightMm: 100 } })).toEqual([
      [0, 10, 150, 10],
    ]);
  });
});

describe("hatch", () => {
  const square = "M10 10L20 10L20 20L10 20Z";
  const drawing = drawingOf(
    [
      { d: square, stroke: null, fill: "#ff0000", group: 0 },
      { d: square, stroke: "#000000", fill: "#00ff00", group: 1 },
    ],
    { groups: ["a", "b"] },
  );
  const lengths = (settings: Partial<PrepareSettings>): number[] =>
    prepare(drawing, { ...TRUE_SIZE, ...settings }).layers.map((layer) => Math.round(layer.drawMm));

  it("is off unless a spacing is given", () => {
    expect(lengths({})).toEqual([40, 40]);
  });

  it("draws level lines half a pen inside, linked into one stroke, before the outline", () => {
    const strokes = draw(drawing, {
      hatch: { spacingMm: 4, angleDeg: 0, cross: false },
      hiddenLayers: ["g1"],
    });
    expect(strokes).toEqual([
      [12, 12, 18, 12, 18, 16, 12, 16],
      [10, 10, 20, 10, 20, 20, 10, 20, 10, 10],
    ]);
  });

  it("can be different, or off, for a layer", () => {
    const hatch = { spacingMm: 1, angleDeg: 0, cross: false };
    const off = { ...hatch, spacingMm: 0, layer: "g1" };
    const [both, second] = lengths({ hatch });
    expect(both).toBe(second);
    expect(both).toBeGreaterThan(40 + 81);
    expect(lengths({ hatch, layerHatches: [off] })).toEqual([both, 40]);
    expect(lengths({ layerHatches: [{ ...hatch, layer: "g1" }] })).toEqual([40, both]);
  });

  it("is drawn alone if outlines of filled shapes are not wanted", () => {
    expect(lengths({ outlineFills: false })).toEqual([0, 40]);
  });

  it("leaves a shape thinner than the pen empty, and does not hang with a tiny spacing", () => {
    const sliver = drawingOf([{ d: "M0 0L50 0L50 0.2L0 0.2Z", stroke: null, fill: "#000000" }]);
    expect(draw(sliver, { hatch: { spacingMm: 1, angleDeg: 0, cross: false }, outlineFills: false })).toEqual(
      [],
    );
    const fine = prepare(drawing, { ...TRUE_SIZE, hatch: { spacingMm: 1e-9, angleDeg: 0, cross: false } });
    expect(fine.layers[0].drawMm).toBeLessThan(2_100);
  });
});

describe("repeated lines", () => {
  it("are drawn once, completely or in part, in either direction, within a layer", () => {
    const twice = drawingOf(["M0 0L10 0", "M10 0.01L0 0.01", "M5 0L15 0", "M0 5L10 5"]);
    expect(draw(twice, { dropRepeatsMm: 0.05 })).toEqual([
      [0, 0, 10, 0],
      [10, 0, 15, 0],
      [0, 5, 10, 5],
    ]);
    expect(draw(twice)).toHaveLength(4);
    const layers = drawingOf(
      [
        { d: "M0 0L10 0", group: 0 },
        { d: "M0 0L10 0", group: 1 },
      ],
      { groups: ["a", "b"] },
    );
    expect(draw(layers, { dropRepeatsMm: 0.05 })).toHaveLength(2);
  });

  it("leave lines that only cross, touch or run close unchanged", () => {
    const lines = drawingOf(["M0 0L10 10L20 0", "M0 10L10 0", "M0 0.2L10 10.2", "M5 5L5 5"]);
    expect(draw(lines, { dropRepeatsMm: 0.05 })).toEqual(draw(lines));
  });

  it("split a line whose middle is already drawn", () => {
    expect(draw(drawingOf(["M40 0L60 0", "M0 0L100 0"]), { dropRepeatsMm: 0.1 })).toEqual([
      [40, 0, 60, 0],
      [0, 0, 40, 0],
      [60, 0, 100, 0],
    ]);
  });

  it("do not include lines close to a line that is itself left out", () => {
    // Every second line stays, also if each is longer than the one before.
    const rows = (grow: number): string[] =>
      Array.from({ length: 20 }, (_, k) => `M${50 - k * grow} ${k / 4}L${90 + k * grow} ${k / 4}`);
    const whole = (lines: string[]): number =>
      draw(drawingOf(lines), { dropRepeatsMm: 0.3 }).filter(([x0, , x1]) => Math.abs(x1 - x0) >= 40).length;
    expect(whole(rows(0))).toBe(10);
    expect(whole(rows(1))).toBe(10);
    const dots = Array.from({ length: 20 }, (_, k) => `M${k / 4} 5Z`);
    expect(draw(drawingOf(dots), { dropRepeatsMm: 0.3 })).toHaveLength(10);
  });

  it("include dots", () => {
    const dots = drawingOf(["M5 5Z", "M5.01 5Z", "M6 5Z"]);
    expect(draw(dots, { dropRepeatsMm: 0.05 })).toEqual([
      [5, 5],
      [6, 5],
    ]);
  });
});

describe("smoothing and starting points", () => {
  it("cuts corners, keeps open ends and closes closed lines", () => {
    expect(draw(drawingOf(["M0 0L8 0L8 8"]), { smoothRounds: 1 })).toEqual([[0, 0, 6, 0, 8, 2, 8, 8]]);
    expect(draw(drawingOf(["M0 0L8 0L8 8L0 8Z"]), { smoothRounds: 1 })).toEqual([
      [2, 0, 6, 0, 8, 2, 8, 6, 6, 8, 2, 8, 0, 6, 0, 2, 2, 0],
    ]);
  });

  it("begins closed lines at random points, the same in every run, and the order keeps them", () => {
    const rings = Array.from(
      { length: 12 },
      (_, k) => `M${10 * k} 0L${10 * k + 5} 0L${10 * k + 5} 5L${10 * k} 5Z`,
    );
    const drawing = drawingOf(rings);
    const corner = (stroke: number[]): string => `${stroke[0] % 10},${stroke[1]}`;
    const starts = draw(drawing, { reloop: true, order: "fast" }).map(corner);
    expect(new Set(starts).size).toBeGreaterThan(2);
    expect(draw(drawing, { reloop: true, order: "fast" }).map(corner)).toEqual(starts);
    expect(new Set(draw(drawing, { order: "none" }).map(corner)).size).toBe(1);
  });
});

describe("wet ink", () => {
  const row = drawingOf(Array.from({ length: 9 }, (_, k) => `M${10 * k} 0L${10 * k} 10`));
  const columns = (settings: Partial<PrepareSettings>): number[] =>
    draw(row, settings).map((stroke) => stroke[0] / 10);

  it("interleaves neighbours, and shuffles the same way every time", () => {
    expect(columns({ spread: "interleave" })).toEqual([0, 4, 8, 1, 5, 2, 6, 3, 7]);
    const shuffled = columns({ spread: "shuffle" });
    expect(shuffled).not.toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect([...shuffled].sort()).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect(columns({ spread: "shuffle" })).toEqual(shuffled);
  });

  it("splits layers where the ink runs out, cutting only strokes longer than a filling", () => {
    const { strokes, drawMm } = prepare(row, { ...TRUE_SIZE, reinkMm: 25 });
    expect(drawMm).toBe(90);
    expect([...strokes.layer]).toEqual([0, 0, 1, 1, 2, 2, 3, 3, 4]);
    expect(strokes.layers.map((layer) => layer.name)).toEqual([
      "Layer 1",
      "Layer 1 (2)",
      "Layer 1 (3)",
      "Layer 1 (4)",
      "Layer 1 (5)",
    ]);
    const long = prepare(drawingOf(["M0 0L10 0L10 60"]), { ...TRUE_SIZE, reinkMm: 25 }).strokes;
    expect(strokesOf(long)).toEqual([
      [0, 0, 10, 0, 10, 15],
      [10, 15, 10, 40],
      [10, 40, 10, 60],
    ]);
    expect([...long.layer]).toEqual([0, 1, 2]);
  });
});

describe("settings from before these steps", () => {
  it("still parse, with the same meaning", () => {
    const { paper, landscape, marginMm, fit, rotateDeg, clipToMargins, flattenMm } = DEFAULT_PREPARE;
    const { joinMm, dropShorterMm, simplifyMm, layers, hiddenLayers, order } = DEFAULT_PREPARE;
    const old = {
      paper,
      landscape,
      marginMm,
      fit,
      rotateDeg,
      clipToMargins,
      flattenMm,
      joinMm,
      dropShorterMm,
      simplifyMm,
      layers,
      hiddenLayers,
      order,
    };
    expect(prepareSettingsSchema.parse(old)).toEqual(DEFAULT_PREPARE);
  });
});
