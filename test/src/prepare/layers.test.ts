import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, prepare, type PrepareSettings } from "../../../src/index.js";
import { strokeCount } from "../../../src/internal.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const TRUE_SIZE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  landscape: false,
  marginMm: 0,
  fit: false,
  order: "none",
};
const GROUPS = ["a", "b", "c"];
const drawing = drawingOf(
  GROUPS.map((_, group) => ({ d: `M0 ${10 * group}L20 ${10 * group}`, group })),
  { groups: GROUPS },
);
const preparedWith = (settings: Partial<PrepareSettings>, of = drawing) =>
  prepare(of, { ...TRUE_SIZE, ...settings });
/** The y of each stroke's beginning and whether it goes left: the layers are 10 mm apart. */
const strokesOf = (settings: Partial<PrepareSettings>, of = drawing): string[] => {
  const { strokes } = preparedWith(settings, of);
  return Array.from({ length: strokeCount(strokes) }, (_, i) => {
    const p = 2 * strokes.offsets[i];
    return `${strokes.xy[p + 1] / 10}${strokes.xy[p] > strokes.xy[p + 2] ? "<" : ">"}`;
  });
};

describe("the order of layers", () => {
  it("is the given one, followed by the rest as in the file", () => {
    expect(strokesOf({ layerOrder: ["g2", "g0"] })).toEqual(["2>", "0>", "1>"]);
    expect(strokesOf({ layerOrder: ["g1"] })).toEqual(["1>", "0>", "2>"]);
  });

  it("is that of the layers in the result, without unknown and repeated ones", () => {
    const prepared = preparedWith({ layerOrder: ["g9", "g2", "g0", "g2"] });
    expect(prepared.layers.map(({ id }) => id)).toEqual(["g2", "g0", "g1"]);
    expect(prepared.strokes.layers.map(({ id }) => id)).toEqual(["g2", "g0", "g1"]);
  });

  it("keeps each layer's own travel short", () => {
    expect(strokesOf({ layerOrder: ["g2", "g1", "g0"], order: "fast" })).toEqual(["2>", "1<", "0>"]);
  });

  it("applies to hatches of single layers too", () => {
    const squares = drawingOf(
      GROUPS.map((_, group) => {
        const [top, bottom] = [10 * group, 10 * group + 5];
        return { d: `M0 ${top}L5 ${top}L5 ${bottom}L0 ${bottom}Z`, group, fill: "#000000" };
      }),
      { groups: GROUPS },
    );
    const layerHatches = [{ layer: "g1", spacingMm: 1, angleDeg: 0, cross: false }];
    const { layers } = preparedWith({ layerHatches, layerOrder: ["g1", "g0"] }, squares);
    expect(layers.map(({ id, strokeCount: count }) => [id, count > 1])).toEqual([
      ["g1", true],
      ["g0", false],
      ["g2", false],
    ]);
  });
});

describe("a layer drawn more than once", () => {
  it("goes back and forth if that saves travel, and reports the total length", () => {
    expect(strokesOf({ layerRepeats: { g0: 3 } })).toEqual(["0>", "0<", "0>", "1>", "2>"]);
    expect(preparedWith({ layerRepeats: { g0: 3, g2: 2 } }).drawMm).toBe(120);
  });

  it("begins each pass at the same point if the layer ends where it begins and that takes no more travel", () => {
    const ring = drawingOf(["M0 0L10 0L10 10L0 10Z"]);
    const { strokes, travelMm } = preparedWith({ layerRepeats: { g0: 2 } }, ring);
    expect([strokeCount(strokes), travelMm]).toEqual([2, 0]);
  });

  it("travels no further than by drawing every pass in the same direction", () => {
    const once = preparedWith({ hiddenLayers: ["g1", "g2"] }).travelMm;
    const twice = preparedWith({ hiddenLayers: ["g1", "g2"], layerRepeats: { g0: 2 } });
    // There and back: it ends where it began, at home.
    expect([once, twice.travelMm, twice.travelMmUnordered]).toEqual([20, 0, 0]);
  });
});

describe("codes in layer names", () => {
  const GIVEN = ["%off", "on"];
  const coded = drawingOf(
    GIVEN.map((_, group) => ({ d: `M0 ${10 * group}L20 ${10 * group}`, group })),
    { groups: GIVEN },
  );

  it("leave out a layer with %, listed as such, until it is switched on", () => {
    expect(strokesOf({}, coded)).toEqual(["1>"]);
    expect(preparedWith({}, coded).layers.map(({ visible }) => visible)).toEqual([false, true]);
    expect(strokesOf({ shownLayers: ["g0"] }, coded)).toEqual(["0>", "1>"]);
  });

  it("do not switch on a layer that was switched off by hand", () => {
    expect(strokesOf({ shownLayers: ["g0"], hiddenLayers: ["g0"] }, coded)).toEqual(["1>"]);
  });
});

describe("the colour of a layer", () => {
  const BLUE = "#0000ff";
  const PURPLE = "#800080";
  const line = (stroke: string, y: number, lengthMm = 10) => ({ d: `M0 ${y}L${lengthMm} ${y}`, stroke });
  const colorsOf = (shapes: Parameters<typeof drawingOf>[0], settings: Partial<PrepareSettings> = {}) =>
    preparedWith(settings, drawingOf(shapes)).layers.map(({ color, colorCount }) => [color, colorCount]);

  it("is that of most of its lines, and other colours are reported", () => {
    const blue = Array.from({ length: 44 }, (_, k) => line(BLUE, k));
    expect(colorsOf([line(PURPLE, 50), ...blue])).toEqual([[BLUE, 2]]);
    expect(colorsOf([line(PURPLE, 50), ...blue], { layers: "all" })).toEqual([[BLUE, 2]]);
    expect(colorsOf(blue)).toEqual([[BLUE, 1]]);
    expect(preparedWith({}, drawingOf([line(PURPLE, 50), ...blue])).strokes.layers[0].color).toBe(BLUE);
  });

  it("goes by length, not by the number of shapes, and excludes pen-up travel", () => {
    const purples = [0, 1, 2].map((y) => line(PURPLE, y, 5));
    expect(colorsOf([...purples, line(BLUE, 9, 20)])).toEqual([[BLUE, 2]]);
    // The closing side counts; the moves between subpaths do not.
    const box = { d: "M0 0L8 0L8 8L0 8Z", stroke: BLUE };
    expect(colorsOf([box, line(PURPLE, 20, 30)])).toEqual([[BLUE, 2]]);
    expect(colorsOf([{ d: "M0 0L1 0M90 90L91 90", stroke: PURPLE }, line(BLUE, 9, 5)])).toEqual([[BLUE, 2]]);
  });

  it("is the most frequent one among dots", () => {
    const dot = (stroke: string, x: number) => ({ d: `M${x} 5L${x} 5`, stroke });
    expect(colorsOf([dot(PURPLE, 1), dot(BLUE, 2), dot(BLUE, 3)])).toEqual([[BLUE, 2]]);
  });

  it("is the fill's if a shape has no stroke", () => {
    const filled = { d: "M0 0L8 0L8 8Z", stroke: null, fill: PURPLE };
    expect(colorsOf([filled])).toEqual([[PURPLE, 1]]);
  });
});

describe("the line width of a layer", () => {
  it("is the mean of the file's lines, weighted by length; 0 if there is none", () => {
    const layers = preparedWith(
      {},
      drawingOf(
        [
          { d: "M0 0L30 0", stroke: "#000000", strokeWidth: 0.4 },
          { d: "M0 5L10 5", stroke: "#000000", strokeWidth: 0.8 },
          { d: "M0 9L10 9", stroke: "#000000", strokeWidth: 0, group: 1 },
        ],
        { groups: ["lines", "hairs"] },
      ),
    ).layers;
    expect(layers[0].strokeWidthMm).toBeCloseTo(0.5);
    expect(layers[1].strokeWidthMm).toBe(0);
  });
});
