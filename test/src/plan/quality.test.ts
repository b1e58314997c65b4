/**
 * The benefit of each quality: time without pen waits, and the simulated pen's distance from the drawing, compared with
 * the default (A = 500, V = 50, δ = 0.025, not shaped) on the same springs. Medians over drawings of polygons, curves
 * and text; docs/motion.md has all samples.
 */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, type StrokeSet, type Trajectory } from "../../../src/index.js";
import { motionOfQuality, penError, qualityOf, type Quality, type Springs } from "../../../src/internal.js";
import { cases } from "../../support/runs/full-run.js";
import { FIGURES, inQuality, median, SPRINGS, swinging } from "../../support/machines/swinging.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";

const DRAWINGS: readonly StrokeSet[] = [
  ...Object.values(FIGURES),
  ...(await Promise.all(["hello-paper", "three-colour-hills", "whirling-triangles"].map(sampleStrokes))),
];

const motionS = ({ durationS, blockCount }: Trajectory): number =>
  durationS.subarray(0, blockCount).reduce((sum, s) => sum + s, 0);

/** The medians, as shares of the default's. `errors`: with the frequency right, and wrong by −10 % and +10 %. */
function worth(quality: Quality, springs: Springs) {
  const machine = swinging(springs);
  const rows = DRAWINGS.map((strokes) => {
    const before = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN, { machine });
    const after = plan(strokes, inQuality(quality, springs), DEFAULT_PEN, { machine });
    const errorOf = (t: Trajectory, factor: number) =>
      penError(strokes, t, { ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz });
    const was = errorOf(before, 1);
    const errors = [1, 0.9, 1.1].map((factor) => errorOf(after, factor));
    return {
      time: motionS(after) / motionS(before),
      max: errors.map(({ maxMm }) => maxMm / was.maxMm),
      rms: errors.map(({ rmsMm }) => rmsMm / was.rmsMm),
    };
  });
  const over = (of: "max" | "rms"): number[] => [0, 1, 2].map((i) => median(rows.map((row) => row[of][i])));
  return { time: median(rows.map(({ time }) => time)), max: over("max"), rms: over("rms") };
}

// `npm test` has one machine: each plans and simulates all drawings.
describe.each(SPRINGS.slice(0, cases(SPRINGS.length, 1)))("on springs of $xHz and $yHz Hz", (springs) => {
  it("fast takes 35 % less time with no larger error, and at most 1.3 times the error if a frequency is wrong by 10 %", () => {
    const { time, max, rms } = worth("fast", springs);
    expect(time).toBeLessThanOrEqual(0.65);
    for (const [right, low, high] of [max, rms]) {
      expect(right).toBeLessThanOrEqual(1);
      expect(Math.max(low, high)).toBeLessThanOrEqual(1.3);
    }
  }, 120_000);

  it("fine takes 15 % less time with at most 0.6 of the largest error, also if a frequency is wrong by 10 %", () => {
    const { time, max } = worth("fine", springs);
    expect(time).toBeLessThanOrEqual(0.85);
    expect(Math.max(...max)).toBeLessThanOrEqual(0.6);
  }, 120_000);
});

describe("a quality", () => {
  it("is recognised by its numbers", () => {
    const [springs] = SPRINGS;
    expect(qualityOf(inQuality("fast", springs), springs)).toBe("fast");
    expect(qualityOf(DEFAULT_MOTION, springs)).toBeNull();
    const own = { ...inQuality("fine", springs), shaper: "none" as const };
    expect(qualityOf(own, springs)).toBeNull();
  });

  it("of a machine that was not measured can only be normal, with the default limits", () => {
    expect({ ...DEFAULT_MOTION, ...motionOfQuality("normal", null) }).toEqual(DEFAULT_MOTION);
    expect(qualityOf(DEFAULT_MOTION, null)).toBe("normal");
    expect(() => motionOfQuality("fast", null)).toThrow(/ringing sheet/);
  });

  it("accelerates less on a weak machine", () => {
    const weak = motionOfQuality("fast", { xHz: 5, yHz: 30, damping: 0.05 });
    expect(weak.draw.accelMmPerS2).toBe(438);
  });
});
