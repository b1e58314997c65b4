/** What holds for random drawings, on the real ones that come with plotwright: looked at every few milliseconds. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import {
  DEFAULT_FIT,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  MOTION_MODES,
  plan,
  prepare,
  type MotionMode,
  type StrokeSet,
  type Trajectory,
} from "../../../src/index.js";
import { linesOf } from "../../support/reference-planners/compare.js";
import { OQUAM } from "../../support/reference-planners/systems.js";
import { worstOf } from "../../support/trajectory-checks.js";

const FOLDER = path.join(import.meta.dirname, "..", "..", "..", "samples");
const samples = readdirSync(FOLDER).filter((name) => name.endsWith(".svg"));
const draw = { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 };
const travel = { speedMmPerS: 150, accelMmPerS2: 1_000, cornerMm: 0.5, jerkMmPerS3: 20_000 };
const WAYS = MOTION_MODES.flatMap((mode) => [
  { name: mode, mode, fit: null },
  { name: `${mode}, fitted`, mode, fit: DEFAULT_FIT },
]);

describe.each(samples)("the sample %s", (file) => {
  const { strokes } = prepare(importSvg(readFileSync(path.join(FOLDER, file), "utf8")), DEFAULT_PREPARE);

  it.each(WAYS)("is drawn within all limits and without a gap in mode $name", ({ mode, fit }) => {
    const trajectory = plan(strokes, { mode, draw, travel, fit }, DEFAULT_PEN);
    const allowed = (mode === "junction" ? 0 : draw.cornerMm) + (fit ? fit.toleranceMm : 0);
    const worst = worstOf(trajectory, strokes, draw, travel, allowed);
    expect(worst.finite).toBe(true);
    expect(worst.speed).toBeLessThanOrEqual(1.001);
    expect(worst.accel).toBeLessThanOrEqual(1.001);
    expect(worst.restSpeed).toBeLessThan(1e-6);
    expect(worst.gap).toBeLessThanOrEqual(1e-9);
    expect(worst.clock).toBeLessThanOrEqual(1e-9 * trajectory.totalS);
    expect(worst.distance).toBeLessThanOrEqual(allowed + 2e-6);
    if (mode !== "junction") expect(worst.velocityJump).toBeLessThan(1e-6);
    if (mode !== "scurve") return;
    expect(worst.jerk).toBeLessThanOrEqual(1.001);
    expect(worst.accelJump).toBeLessThan(1e-2);
  });
});

describe.each(samples)("the corner curves of %s", (file) => {
  it("take at most 2 % longer than a plan whose velocity jumps", () => {
    const { strokes } = prepare(importSvg(readFileSync(path.join(FOLDER, file), "utf8")), DEFAULT_PREPARE);
    const drawS = (mode: MotionMode) =>
      total(drawnDurations(plan(strokes, { mode, draw, travel, fit: null }, DEFAULT_PEN)));
    expect(drawS("blend") / drawS("junction")).toBeLessThan(1.02);
  });
});

describe.each([
  { file: "harmonograph.svg", fewer: 10, own: 9.5 },
  { file: "three-colour-hills.svg", fewer: 5.9, own: 5 },
  { file: "flower-meadow.svg", fewer: 2.2, own: 2 },
  { file: "moonrise.svg", fewer: 1, own: 1 },
])("fitting $file", ({ file, fewer, own }) => {
  it("leaves fewer pieces than a command a phase and corner, hardly any shorter than the floor, and little more time", () => {
    const { strokes } = prepare(importSvg(readFileSync(path.join(FOLDER, file), "utf8")), DEFAULT_PREPARE);
    const plain = drawnDurations(plan(strokes, { mode: "blend", draw, travel, fit: null }, DEFAULT_PEN));
    const fitted = drawnDurations(
      plan(strokes, { mode: "blend", draw, travel, fit: DEFAULT_FIT }, DEFAULT_PEN),
    );
    expect(plain.length / fitted.length).toBeGreaterThan(own);
    expect(commandPerPhase(strokes) / fitted.length).toBeGreaterThan(fewer);
    const short = fitted.filter((s) => s < DEFAULT_FIT.floorMs / 1000 - 1e-9);
    expect(short.length / fitted.length).toBeLessThan(0.01);
    expect(total(fitted) / total(plain)).toBeLessThan(1.02);
  });
});

/** One for every phase of every segment's trapezoid, and one for every corner's curve: what Oquam's planner sends. */
function commandPerPhase(strokes: StrokeSet): number {
  const limits = { speed: draw.speedMmPerS, accel: draw.accelMmPerS2, deviation: draw.cornerMm };
  return linesOf(strokes).reduce((sum, line) => sum + OQUAM.plan(line, limits).pieces, 0);
}

const total = (durations: readonly number[]): number => durations.reduce((sum, s) => sum + s, 0);

/** Seconds of every block drawn with the pen down. */
function drawnDurations({ runs, durationS }: Trajectory): number[] {
  const durations: number[] = [];
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run]! < 0) continue;
    for (let k = runs.firstBlock[run]!; k < runs.firstBlock[run + 1]!; k++) durations.push(durationS[k]!);
  }
  return durations;
}
