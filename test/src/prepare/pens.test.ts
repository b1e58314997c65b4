import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, prepare, type PrepareSettings } from "../../../src/index.js";
import {
  NO_PENS,
  penStopsOf,
  prepareSettingsOf,
  type PenSetup,
  type PlotPen,
} from "../../../src/internal.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const TRUE_SIZE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  landscape: false,
  marginMm: 0,
  fit: false,
  order: "none",
};
const penNamed = (id: string, more: Partial<PlotPen> = {}): PlotPen => ({
  id,
  name: `Pen ${id}`,
  color: null,
  widthMm: 0.5,
  offsetXMm: 0,
  offsetYMm: 0,
  ...more,
});
const RED = penNamed("red", { color: "#ff0000" });
const BLACK = penNamed("black");

/** Two strokes in each group, 10 mm apart. */
const drawingWith = (groups: readonly string[]) =>
  drawingOf(
    groups.flatMap((_, group) => [
      { d: `M0 ${20 * group}L5 ${20 * group}`, group, stroke: "#00aa00" },
      { d: `M0 ${20 * group + 10}L5 ${20 * group + 10}`, group, stroke: "#00aa00" },
    ]),
    { groups },
  );

const stopsOf = (
  groups: readonly string[],
  setup: Partial<PenSetup>,
  settings: Partial<PrepareSettings> = {},
) =>
  penStopsOf(prepare(drawingWith(groups), { ...TRUE_SIZE, ...settings }).strokes, { ...NO_PENS, ...setup });
const placesOf = (...args: Parameters<typeof stopsOf>): number[] =>
  stopsOf(...args).map(({ strokeIndex }) => strokeIndex);

describe("stops for pens", () => {
  const pens = [RED, BLACK];

  it("are placed where the next layer needs another pen", () => {
    const layerPens = { g0: "red", g1: "red", g2: "black", g3: "red" };
    expect(stopsOf(["a", "b", "c", "d"], { pens, layerPens }).slice(1)).toEqual([
      { strokeIndex: 4, layerId: "g2", layerName: "c", penName: "Pen black", color: "#00aa00" },
      { strokeIndex: 6, layerId: "g3", layerName: "d", penName: "Pen red", color: "#ff0000" },
    ]);
  });

  it("include the first pen if several are needed, because any of them may be in the holder", () => {
    expect(stopsOf(["a", "b"], { pens, layerPens: { g0: "red", g1: "black" } })[0]).toMatchObject({
      strokeIndex: 0,
      penName: "Pen red",
    });
    expect(placesOf(["a", "b"], { pens, layerPens: { g0: "red", g1: "red" } })).toEqual([]);
    // A pen that only a hidden layer uses is not needed.
    const hidden = { hiddenLayers: ["g1"] };
    expect(placesOf(["a", "b"], { pens, layerPens: { g0: "red", g1: "black" } }, hidden)).toEqual([]);
  });

  it("skip layers without an assigned pen, and remember which pen is in the holder", () => {
    expect(placesOf(["a", "b", "c"], { pens, layerPens: { g0: "red", g2: "red" } })).toEqual([]);
    expect(placesOf(["a", "b", "c"], { pens, layerPens: { g0: "red", g2: "black" } })).toEqual([0, 4]);
    expect(placesOf(["a", "b"], { pens, layerPens: { g1: "red" } })).toEqual([2]);
  });

  it("ignore a pen that was removed", () => {
    expect(placesOf(["a", "b"], { pens: [RED], layerPens: { g0: "red", g1: "gone" } })).toEqual([]);
  });

  it("come before layers whose name begins with !, including the first one, and have the name without codes", () => {
    const stops = stopsOf(["!1 sky", "2 sea", "!+h20 gold"], {});
    expect(stops.map(({ strokeIndex, layerName }) => [strokeIndex, layerName])).toEqual([
      [0, "1 sky"],
      [4, "gold"],
    ]);
  });

  it("come before every layer but the first on request, or never on request", () => {
    const layerPens = { g0: "red", g1: "black" };
    expect(placesOf(["a", "b", "!c"], { penStops: "layers" })).toEqual([2, 4]);
    expect(placesOf(["a", "b", "!c"], { pens, layerPens, penStops: "never" })).toEqual([]);
  });

  it("are set or removed for a single layer by hand", () => {
    const layerPens = { g0: "red", g1: "black" };
    const layerStops = { g1: false, g2: true };
    expect(placesOf(["a", "b", "c", "!d"], { pens, layerPens, layerStops })).toEqual([0, 4, 6]);
  });

  it("follow the order in which layers are drawn, hidden ones left out", () => {
    const layerPens = { g0: "red", g1: "black", g2: "red" };
    const layerOrder = ["g2", "g0", "g1"];
    expect(placesOf(["a", "b", "c"], { pens, layerPens }, { layerOrder })).toEqual([0, 4]);
    expect(placesOf(["a", "b", "c"], { pens, layerPens }, { hiddenLayers: ["g1"] })).toEqual([]);
  });

  it("are placed between the parts of a layer that is drawn with an ink that runs out", () => {
    const stops = stopsOf(["a", "b"], { pens, layerPens: { g0: "red", g1: "red" } }, { reinkMm: 5 });
    expect(stops.map(({ strokeIndex, layerId, penName }) => [strokeIndex, layerId, penName])).toEqual([
      [1, "g0", "Pen red"],
      [3, "g1", "Pen red"],
    ]);
  });
});

describe("a pen with an offset", () => {
  const askew = penNamed("askew", { offsetXMm: 1.5, offsetYMm: -0.25 });

  it("is moved by the opposite offset, so that its line is where the drawing has it", () => {
    const settings = prepareSettingsOf({ prepare: TRUE_SIZE, pens: [askew], layerPens: { g1: "askew" } });
    const { strokes } = prepare(drawingWith(["a", "b"]), settings);
    expect([...strokes.xy]).toEqual([
      0, 0, 5, 0, 0, 10, 5, 10, -1.5, 20.25, 3.5, 20.25, -1.5, 30.25, 3.5, 30.25,
    ]);
    expect(strokes.layers.map(({ shiftMm }) => shiftMm)).toEqual([undefined, { x: -1.5, y: 0.25 }]);
  });

  it("moves all parts of its layer", () => {
    const settings = prepareSettingsOf({ prepare: TRUE_SIZE, pens: [askew], layerPens: { g0: "askew" } });
    const { strokes } = prepare(drawingWith(["a"]), { ...settings, reinkMm: 5 });
    expect([...strokes.xy]).toEqual([-1.5, 0.25, 3.5, 0.25, -1.5, 10.25, 3.5, 10.25]);
  });

  it("changes nothing if pens have no offset", () => {
    const { prepare: same } = { prepare: TRUE_SIZE };
    expect(prepareSettingsOf({ prepare: TRUE_SIZE, pens: [RED], layerPens: { g0: "red" } })).toBe(same);
  });
});
