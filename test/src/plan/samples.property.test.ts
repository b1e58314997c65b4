/** The properties of random drawings, checked on the samples of plotwright: sampled every few milliseconds. */
import { readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, type Trajectory } from "../../../src/index.js";
import { DEFAULT_FIT, MOTION_MODES, type MotionMode } from "../../../src/internal.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";
import { MAX_MOVED_MM } from "../../../src/plan/resample.js";

const FOLDER = path.join(import.meta.dirname, "..", "..", "..", "samples");
const samples = readdirSync(FOLDER).flatMap((name) => (name.endsWith(".svg") ? name.slice(0, -4) : []));
const draw = { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 };
const travel = { speedMmPerS: 150, accelMmPerS2: 1_000, cornerMm: 0.5, jerkMmPerS3: 20_000 };
const CASES = MOTION_MODES.flatMap((mode) => [
  { name: mode, mode, fit: null },
  { name: `${mode}, fitted`, mode, fit: DEFAULT_FIT },
]);

describe.each(samples)("the sample %s", async (name) => {
  const strokes = await sampleStrokes(name);

  it.each(CASES)("is drawn within all limits and without a gap in mode $name", ({ mode, fit }) => {
    const trajectory = plan(strokes, { mode, draw, travel, fit }, DEFAULT_PEN);
    const allowed = (mode === "junction" ? 0 : draw.cornerMm) + (fit ? fit.toleranceMm : 0);
    const worst = worstOf(trajectory, strokes, draw, travel, allowed + MAX_MOVED_MM);
    expect(worst.finite).toBe(true);
    expect(worst.speed).toBeLessThanOrEqual(1.001);
    expect(worst.accel).toBeLessThanOrEqual(1.001);
    expect(worst.restSpeed).toBeLessThan(1e-6);
    expect(worst.gap).toBeLessThanOrEqual(1e-9);
    expect(worst.clock).toBeLessThanOrEqual(1e-9 * trajectory.totalS);
    expect(worst.distance).toBeLessThanOrEqual(allowed + MAX_MOVED_MM);
    if (mode !== "junction") expect(worst.velocityJump).toBeLessThan(1e-6);
    if (mode !== "scurve") return;
    expect(worst.jerk).toBeLessThanOrEqual(1.001);
    expect(worst.accelJump).toBeLessThan(1e-2);
  });
});

/** Short wavy lines have the most corners for their length. */
const LONGER: Readonly<Record<string, number>> = { "three-colour-hills": 1.056, "flower-meadow": 1.021 };

describe.each(samples)("the corner curves of %s", (name) => {
  it("take at most 2 % longer than a plan whose velocity jumps, on the hills 5.6 %, on the meadow 2.1 %", async () => {
    const strokes = await sampleStrokes(name);
    const drawS = (mode: MotionMode) =>
      total(drawnDurations(plan(strokes, { mode, draw, travel, fit: null }, DEFAULT_PEN)));
    expect(drawS("blend") / drawS("junction")).toBeLessThan(LONGER[name] ?? 1.02);
  });
});

describe.each([
  { name: "harmonograph", fewer: 5 },
  { name: "three-colour-hills", fewer: 2.65 },
  { name: "flower-meadow", fewer: 1.29 },
  { name: "moonrise", fewer: 1 },
])("merging $name", ({ name, fewer }) => {
  it("leaves fewer blocks (of single short lines, as many) and takes at most 1 % more time", async () => {
    const strokes = await sampleStrokes(name);
    const drawn = (fit: typeof DEFAULT_FIT | null) =>
      drawnDurations(plan(strokes, { mode: "blend", draw, travel, fit }, DEFAULT_PEN));
    const [plain, merged] = [drawn(null), drawn(DEFAULT_FIT)];
    expect(plain.length / merged.length).toBeGreaterThanOrEqual(fewer);
    expect(total(merged) / total(plain)).toBeLessThan(1.01);
  });
});

const total = (durations: readonly number[]): number => durations.reduce((sum, s) => sum + s, 0);

/** Seconds of every block drawn with the pen down. */
function drawnDurations({ runs, durationS }: Trajectory): number[] {
  const durations: number[] = [];
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) continue;
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) durations.push(durationS[k]);
  }
  return durations;
}
