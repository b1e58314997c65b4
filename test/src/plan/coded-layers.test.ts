import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, trajectoryStats, type StrokeSet } from "../../../src/index.js";
import { NO_PENS, codedLayerNames, withLayerCodes } from "../../../src/internal.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";

const SETTINGS = { ...NO_PENS, motion: DEFAULT_MOTION, pen: DEFAULT_PEN };

/** One stroke of 100 mm for each name. */
const strokesNamed = (...names: readonly string[]): StrokeSet => ({
  xy: Float64Array.from(names.flatMap((_, i) => [10, 10 * i, 110, 10 * i])),
  offsets: Uint32Array.from([...names, ""].map((_, i) => 2 * i)),
  layer: Uint16Array.from(names.map((_, i) => i)),
  layers: names.map((name, i) => ({ id: `l${i}`, name, color: null })),
});
const resolved = (settings: typeof SETTINGS, ...names: readonly string[]) =>
  withLayerCodes(settings, strokesNamed(...names).layers);

describe("codes in layer names, as settings", () => {
  it("set the layer's height, its speed on the scale of the original software, and its wait", () => {
    const { motion, pen } = resolved(SETTINGS, "plain", "+h20+s25+d500 gold");
    // 25 of 110 parts of 8.6979 inches a second.
    expect(motion.layers).toEqual({ l1: { speedMmPerS: 50.2 } });
    expect(pen.layers).toEqual({ l1: { downPct: 20, beforeMs: 500 } });
  });

  it("are overridden by the layer's settings, field by field", () => {
    const own = {
      ...SETTINGS,
      motion: { ...DEFAULT_MOTION, layers: { l0: { accelMmPerS2: 100 } } },
      pen: { ...DEFAULT_PEN, layers: { l0: { downPct: 25 } } },
    };
    const { motion, pen } = resolved(own, "+h20+s50+d100");
    expect(motion.layers).toEqual({ l0: { speedMmPerS: 100.4, accelMmPerS2: 100 } });
    expect(pen.layers).toEqual({ l0: { downPct: 25, beforeMs: 100 } });
  });

  it("change nothing if there are none, and nothing more the second time", () => {
    expect(resolved(SETTINGS, "plain", "+x9 other")).toBe(SETTINGS);
    const once = resolved(SETTINGS, "+s30+h10");
    expect(withLayerCodes(once, strokesNamed("+s30+h10").layers)).toEqual(once);
  });

  it("are ignored if the pen would never leave the paper", () => {
    expect(resolved(SETTINGS, "+h80").pen.layers).toBeUndefined();
  });

  it("determine the plan's speed, its pen heights, and a wait with the pen up", () => {
    const strokes = strokesNamed("plain", "+s10+h15+d2000 slow");
    const { motion, pen } = withLayerCodes(SETTINGS, strokes.layers);
    const coded = plan(strokes, motion, { ...pen, overlap: "off" });
    const given = plan(strokes, DEFAULT_MOTION, { ...DEFAULT_PEN, overlap: "off" });
    expect(penMovesOf(coded).map(({ up, heightPct, waitS }) => [up, heightPct, waitS])).toEqual([
      [false, 30, 0.154],
      [true, 60, 0.141],
      [true, 60, 2],
      [false, 15, 0.216],
      [true, 60, 0.191],
    ]);
    // 100 mm at 20.1 mm/s instead of 50: nearly 3 s more, and 2 s of waiting.
    expect(coded.totalS - given.totalS).toBeCloseTo(2 + 100 / 20.1 - 100 / 50, 0);
    expect(trajectoryStats(coded).penLiftCount).toBe(trajectoryStats(given).penLiftCount);
  });

  it("cause only one wait: none if a plot resumes in the middle of the layer", () => {
    const strokes = { ...strokesNamed("a", "a"), layer: Uint16Array.of(0, 0) };
    const pen = { ...DEFAULT_PEN, layers: { l0: { beforeMs: 3_000 } } };
    const waits = (from?: { stroke: number; alongMm: number }) =>
      penMovesOf(plan(strokes, DEFAULT_MOTION, pen, { from })).filter(({ waitS }) => waitS === 3).length;
    expect([waits(), waits({ stroke: 0, alongMm: 5 }), waits({ stroke: 1, alongMm: 0 })]).toEqual([1, 0, 0]);
  });
});

describe("names with codes for other software", () => {
  const strokes = strokesNamed("1 sky", "+s50 sea", "!gold");

  it("encode the settings, and read back as the same settings", () => {
    const settings = {
      ...SETTINGS,
      layerStops: { l1: true },
      motion: { ...DEFAULT_MOTION, layers: { l0: { speedMmPerS: 100.4 } } },
      pen: { ...DEFAULT_PEN, layers: { l2: { downPct: 12.4, beforeMs: 250 } } },
    };
    const names = codedLayerNames(strokes, settings);
    expect(names).toEqual(["1+s50 sky", "!+s50 sea", "!+d250+h12gold"]);
    const again = withLayerCodes(SETTINGS, strokesNamed(...names).layers);
    expect(again.motion.layers).toEqual({ l0: { speedMmPerS: 100.4 }, l1: { speedMmPerS: 100.4 } });
    expect(again.pen.layers).toEqual({ l2: { downPct: 12, beforeMs: 250 } });
  });

  it("are the plain names if every layer uses the common settings", () => {
    expect(codedLayerNames(strokesNamed("a", "2 b"), SETTINGS)).toEqual(["a", "2 b"]);
  });
});
