/** One drawing, planned under every system's rules and ours, with the same A, V and δ. */
import { DEFAULT_PEN, plan, type MotionSettings, type StrokeSet } from "../../../src/index.js";
import { DEFAULT_FIT, MOTION_MODES } from "../../../src/internal.js";
import { distinct, worstCurveAccel, type Limits, type Point } from "./polyline.js";
import { NEXTDRAW } from "./nextdraw.js";
import { REFERENCE_PLANNERS } from "./systems.js";

export interface ComparisonRow {
  readonly planner: string;
  /** Pen down only, s. */
  readonly drawS: number;
  /** Max acceleration on curves as a share of A; for plans with continuous direction: anywhere. */
  readonly worstAccel: number;
  readonly pieces: number;
  /** Max jump of velocity, mm/s. */
  readonly worstJump: number;
}

export function comparePlanners(strokes: StrokeSet, limits: Limits): ComparisonRow[] {
  const lines = linesOf(strokes).filter((line) => line.length > 1);
  const others = [...REFERENCE_PLANNERS, NEXTDRAW].map((reference) => {
    let [drawS, worstAccel, pieces, worstJump] = [0, 0, 0, 0];
    for (const line of lines) {
      const result = reference.plan(line, limits);
      drawS += result.timeS;
      pieces += result.pieces;
      worstAccel = Math.max(worstAccel, worstCurveAccel(line, result, limits.accel));
      if (reference.name !== "Oquam") worstJump = Math.max(worstJump, jumpOf(line, result.speeds));
    }
    return { planner: reference.name, drawS, worstAccel, pieces, worstJump };
  });
  const ours = MOTION_MODES.flatMap((mode) => [
    ourRow(`plotwright ${mode}`, strokes, limits, { mode, fit: null }),
    ourRow(`plotwright ${mode}, merged`, strokes, limits, { mode, fit: DEFAULT_FIT }),
  ]);
  return [...others, ...ours];
}

/** The strokes as lists of points, without repeated points; a dot has one point. */
export function linesOf(strokes: StrokeSet): Point[][] {
  const lines: Point[][] = [];
  for (let s = 0; s + 1 < strokes.offsets.length; s++) {
    const line: Point[] = [];
    for (let i = strokes.offsets[s]; i < strokes.offsets[s + 1]; i++) {
      line.push([strokes.xy[2 * i], strokes.xy[2 * i + 1]]);
    }
    lines.push(distinct(line));
  }
  return lines;
}

function jumpOf(line: readonly Point[], speeds: readonly number[]): number {
  let worst = 0;
  for (let i = 1; i + 1 < line.length; i++) {
    const into = Math.atan2(line[i][1] - line[i - 1][1], line[i][0] - line[i - 1][0]);
    const out = Math.atan2(line[i + 1][1] - line[i][1], line[i + 1][0] - line[i][0]);
    worst = Math.max(worst, 2 * speeds[i] * Math.abs(Math.sin((out - into) / 2)));
  }
  return worst;
}

function ourRow(
  planner: string,
  strokes: StrokeSet,
  limits: Limits,
  how: Pick<MotionSettings, "mode" | "fit">,
): ComparisonRow {
  const draw = {
    speedMmPerS: limits.speed,
    accelMmPerS2: limits.accel,
    cornerMm: limits.deviation,
    jerkMmPerS3: 20 * limits.accel,
  };
  const t = plan(strokes, { ...how, draw, travel: draw }, DEFAULT_PEN);
  let [drawS, worst2, pieces, worstJump] = [0, 0, 0, 0];
  for (let run = 0; run < t.runs.count; run++) {
    if (t.runs.stroke[run] < 0) continue;
    for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) {
      const d = t.durationS[k];
      drawS += d;
      pieces++;
      const jx = t.jx ? t.jx[k] : 0;
      const jy = t.jy ? t.jy[k] : 0;
      worst2 = Math.max(
        worst2,
        t.ax[k] ** 2 + t.ay[k] ** 2,
        (t.ax[k] + d * jx) ** 2 + (t.ay[k] + d * jy) ** 2,
      );
      if (k + 1 === t.runs.firstBlock[run + 1]) continue;
      const vx = t.vx[k] + d * (t.ax[k] + (d * jx) / 2);
      const vy = t.vy[k] + d * (t.ay[k] + (d * jy) / 2);
      worstJump = Math.max(worstJump, Math.hypot(t.vx[k + 1] - vx, t.vy[k + 1] - vy));
    }
  }
  return { planner, drawS, worstAccel: Math.sqrt(worst2) / limits.accel, pieces, worstJump };
}
