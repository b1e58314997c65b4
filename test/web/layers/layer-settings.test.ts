import { describe, expect, it } from "vitest";
import { prepare, importSvg } from "../../../src/index.js";
import { penStopsOf, prepareSettingsOf } from "../../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  fromPreset,
  newJobSchema,
  withPreset,
  type PlotSettings,
} from "../../../src/schema/index.js";
import { alignmentJob, CORNERS, markPlace } from "../../../web/pens/alignment-mark.js";
import {
  addPen,
  changePen,
  hatchLayer,
  isLayerShown,
  moveLayer,
  pensFromColors,
  removePen,
  repeatLayer,
  setLayerMotion,
  setLayerPen,
  setLayerPenMotion,
  showAll,
  showLayer,
  showOnly,
  stopBefore,
  type LayerRow,
} from "../../../web/layers/layer-settings.js";
import { forOtherDrawing } from "../../../web/state/document-actions.js";

const DEFAULTS: PlotSettings = DEFAULT_PLOT_SETTINGS;
const rows: readonly LayerRow[] = [
  { id: "sky", name: "sky", color: "#0000ff" },
  { id: "guides", name: "%guides", color: null },
  { id: "sun", name: "sun", color: "#ffaa00" },
];
const [sky, guides] = rows as [LayerRow, LayerRow, LayerRow];
const shownIn = (settings: PlotSettings): string[] =>
  rows.filter((row) => isLayerShown(settings, row)).map(({ id }) => id);

describe("switching layers", () => {
  it("switching layers by hand overrides the codes in their names", () => {
    expect(shownIn(DEFAULTS)).toEqual(["sky", "sun"]);
    const all = showAll(showLayer(DEFAULTS, sky, false), rows);
    expect(shownIn(all)).toEqual(["sky", "guides", "sun"]);
    expect(shownIn(showLayer(all, guides, false))).toEqual(["sky", "sun"]);
    expect(shownIn(showOnly(all, rows, "guides"))).toEqual(["guides"]);
  });

  it("leaves no trace after it is switched back", () => {
    const there = showLayer(showLayer(DEFAULTS, sky, false), guides, true);
    expect(showLayer(showLayer(there, sky, true), guides, false)).toEqual(DEFAULTS);
  });
});

describe("the order of layers", () => {
  it("puts one at its place among the others", () => {
    const order = (place: number): readonly string[] =>
      moveLayer(DEFAULTS, rows, "sun", place).prepare.layerOrder;
    expect(order(0)).toEqual(["sun", "sky", "guides"]);
    expect(order(1)).toEqual(["sky", "sun", "guides"]);
    expect(order(99)).toEqual(["sky", "guides", "sun"]);
  });
});

describe("a layer's own settings", () => {
  it("are stored field by field, and removed with the last field", () => {
    const fast = setLayerMotion(DEFAULTS, "sky", { speedMmPerS: 80 });
    const both = setLayerMotion(fast, "sky", { accelMmPerS2: 900 });
    expect(both.motion.layers).toEqual({ sky: { speedMmPerS: 80, accelMmPerS2: 900 } });
    const none = setLayerMotion(both, "sky", { speedMmPerS: null, accelMmPerS2: null });
    expect(none.motion.layers).toEqual({});
    const low = setLayerPenMotion(DEFAULTS, "sun", { downPct: 10, beforeMs: 2_000 });
    expect(low.pen.layers).toEqual({ sun: { downPct: 10, beforeMs: 2_000 } });
  });

  it("follow the common settings again with null", () => {
    const own = hatchLayer(stopBefore(repeatLayer(DEFAULTS, "sky", 3), "sky", true), "sky", {
      spacingMm: 1,
      angleDeg: 30,
      cross: false,
    });
    expect(own.prepare.layerRepeats).toEqual({ sky: 3 });
    expect(own.layerStops).toEqual({ sky: true });
    expect(own.prepare.layerHatches).toEqual([{ layer: "sky", spacingMm: 1, angleDeg: 30, cross: false }]);
    expect(hatchLayer(stopBefore(repeatLayer(own, "sky", null), "sky", null), "sky", null)).toEqual(DEFAULTS);
  });
});

describe("pens", () => {
  it("are made of the layers' colours, each once, and assigned to the layers", () => {
    const red: LayerRow = { id: "roof", name: "roof", color: "#ffaa00" };
    const made = pensFromColors(DEFAULTS, [...rows, red], (color) => color?.toUpperCase() ?? "Any");
    expect(made.pens.map(({ name, color }) => [name, color])).toEqual([
      ["#0000FF", "#0000ff"],
      ["Any", null],
      ["#FFAA00", "#ffaa00"],
    ]);
    // A layer without a colour too: without a pen it would be drawn with the previous one, without a stop.
    const [blue, any, orange] = made.pens.map(({ id }) => id);
    expect(made.layerPens).toEqual({ sky: blue, guides: any, sun: orange, roof: orange });
    expect(pensFromColors(made, rows, String).pens).toEqual(made.pens);
  });

  it("have unique ids, also after one was removed", () => {
    const two = addPen(addPen(DEFAULTS, { name: "a" }), { name: "b" });
    const again = addPen(removePen(two, two.pens[0].id), { name: "c" });
    expect(new Set(again.pens.map(({ id }) => id)).size).toBe(2);
  });

  it("are changed by id, and leave their layers without a pen when they are removed", () => {
    const one = setLayerPen(addPen(DEFAULTS, { name: "a" }), "sky", "pen-1");
    expect(changePen(one, "pen-1", { offsetXMm: 2 }).pens[0]).toMatchObject({ name: "a", offsetXMm: 2 });
    expect(removePen(one, "pen-1")).toEqual(DEFAULTS);
    expect(setLayerPen(one, "sky", null).layerPens).toEqual({});
  });
});

describe("another drawing on the paper", () => {
  it("does not reuse the last one's layers, but its colours and pens", () => {
    let settings = addPen(DEFAULTS, { name: "a" });
    for (const id of ["sky", "#ff0000"]) {
      settings = setLayerPen(setLayerMotion(settings, id, { speedMmPerS: 9 }), id, "pen-1");
      settings = repeatLayer(stopBefore(settings, id, true), id, 2);
    }
    const next = forOtherDrawing(showLayer(moveLayer(settings, rows, "sun", 0), sky, false));
    expect(next.pens).toEqual(settings.pens);
    expect(next.layerPens).toEqual({ "#ff0000": "pen-1" });
    expect(next.motion.layers).toEqual({ "#ff0000": { speedMmPerS: 9 } });
    expect(next.prepare).toMatchObject({
      hiddenLayers: [],
      layerOrder: [],
      layerRepeats: { "#ff0000": 2 },
    });
    expect(next.layerStops).toEqual({ "#ff0000": true });
  });
});

describe("another file on the paper", () => {
  it("has neither the place by hand nor the filling of the one before", () => {
    const prepare: PlotSettings["prepare"] = {
      ...DEFAULTS.prepare,
      marginMm: 22,
      layout: { xMm: 1, yMm: 2, widthMm: 30, heightMm: null },
      hatch: { spacingMm: 0.4, angleDeg: 30, cross: true },
      hatchOutlines: true,
      outlineFills: false,
      hideCovered: true,
      outside: "allow",
    };
    expect(forOtherDrawing({ ...DEFAULTS, prepare }).prepare).toEqual({ ...DEFAULTS.prepare, marginMm: 22 });
  });

  it("is not read with the last one's px per inch", () => {
    const read = { ...DEFAULTS, prepare: { ...DEFAULTS.prepare, pxPerInch: 300 } };
    expect(forOtherDrawing(read).prepare.pxPerInch).toBe("auto");
  });
});

describe("a preset", () => {
  it("restores pens, layers and their order, and does not change the paper", () => {
    const kept = moveLayer(setLayerPen(addPen(DEFAULTS, { name: "Brush" }), "sky", "pen-1"), rows, "sun", 0);
    const [preset] = withPreset([], "Dawn", kept);
    const now = { ...DEFAULTS, prepare: { ...DEFAULTS.prepare, marginMm: 3 } };
    const taken = fromPreset(now, preset);
    expect(taken).toEqual({ ...kept, prepare: { ...kept.prepare, marginMm: 3 } });
  });
});

describe("the alignment mark", () => {
  const pen = { ...addPen(DEFAULTS, { name: "Brush" }).pens[0], offsetXMm: 1.5, offsetYMm: -0.5 };

  it.each(CORNERS)(
    "is a cross at the %s, drawn with the pen's own correction and no stop",
    async (corner) => {
      const placed = { ...DEFAULTS, prepare: { ...DEFAULTS.prepare, rotateDeg: 33, marginMm: 40 } };
      const job = alignmentJob(placed, pen, corner, "Mark");
      expect(newJobSchema.safeParse(job).success).toBe(true);
      const { strokes } = prepare(await importSvg(job.drawing), prepareSettingsOf(job.settings));
      const { xMm, yMm } = markPlace(placed, corner);
      const [x, y] = [xMm - 1.5, yMm + 0.5];
      const expected = [x - 5, y, x + 5, y, x, y - 5, x, y + 5];
      expect(strokes.xy.length).toBe(expected.length);
      expected.forEach((value, k) => expect(strokes.xy[k]).toBeCloseTo(value, 6));
      expect(penStopsOf(strokes, job.settings)).toEqual([]);
    },
  );
});
