/**
 * Samples a trajectory at many times inside every block, and reports the worst values. It depends
 * only on the columns, the formula of a block, and the drawing, not on how the planner works.
 */
import type { StrokeSet, Trajectory } from "../../../src/index.js";
import type { MotionLimits } from "../../../src/internal.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";

interface Worst {
  /** Max |v| / V and |a| / A (0 if there is no motion). */
  speed: number;
  accel: number;
  /** Max |j| / J. */
  jerk: number;
  /** Max jump of position, mm, and of velocity, mm/s, from one block to the next in a run. */
  gap: number;
  velocityJump: number;
  accelJump: number;
  /** Max speed at the beginning or end of a run. */
  restSpeed: number;
  /** Max distance of the drawn line from its source stroke, mm. */
  distance: number;
  /** Max difference between the sum of durations and the clock, s. */
  clock: number;
  finite: boolean;
}

/** Min number of samples per block, and max seconds between samples. */
const SAMPLES = 8;
const EVERY_S = 0.004;
/** Max number of samples: a random block may last for hours. */
const MOST_SAMPLES = 250;
/** A distance explained by rounding alone, mm. */
const NOTHING = 1e-7;

/** @param allowed distance from the drawing that needs no closer check, mm */
export function worstOf(
  trajectory: Trajectory,
  strokes: StrokeSet,
  draw: MotionLimits,
  travel: MotionLimits,
  allowed = 1e-9,
): Worst {
  const worst: Worst = {
    speed: 0,
    accel: 0,
    jerk: 0,
    gap: 0,
    velocityJump: 0,
    accelJump: 0,
    restSpeed: 0,
    distance: 0,
    clock: 0,
    finite: allFinite(trajectory),
  };
  const { runs } = trajectory;
  const penMoves = penMovesOf(trajectory);
  let clock = 0;
  let move = 0;
  let end: readonly [number, number] | null = null;
  for (let run = 0; run < runs.count; run++) {
    for (; move < penMoves.length && penMoves[move].beforeRun <= run; move++) clock += penMoves[move].waitS;
    worst.clock = Math.max(worst.clock, Math.abs(clock - runs.startS[run]));
    const stroke = runs.stroke[run];
    const limits = stroke < 0 ? travel : draw;
    const near = stroke < 0 ? null : new NearStroke(strokes, stroke);
    let before = { vx: 0, vy: 0, ax: 0, ay: 0 };
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
      const duration = trajectory.durationS[k];
      worst.clock = Math.max(worst.clock, Math.abs(clock - trajectory.startS[k]));
      const samples = Math.max(SAMPLES, Math.min(MOST_SAMPLES, Math.ceil(duration / EVERY_S)));
      for (let i = 0; i <= samples; i++) {
        const s = sample(trajectory, k, (duration * i) / samples);
        worst.speed = Math.max(worst.speed, Math.hypot(s.vx, s.vy) / limits.speedMmPerS);
        worst.accel = Math.max(worst.accel, Math.hypot(s.ax, s.ay) / limits.accelMmPerS2);
        if (near)
          worst.distance = Math.max(worst.distance, near.distance(s.x, s.y, Math.max(allowed, NOTHING)));
        if (i === 0) {
          if (end) worst.gap = Math.max(worst.gap, Math.hypot(s.x - end[0], s.y - end[1]));
          const jump = Math.hypot(s.vx - before.vx, s.vy - before.vy);
          if (k === runs.firstBlock[run]) worst.restSpeed = Math.max(worst.restSpeed, jump);
          else {
            worst.velocityJump = Math.max(worst.velocityJump, jump);
          }
          worst.accelJump = Math.max(worst.accelJump, Math.hypot(s.ax - before.ax, s.ay - before.ay));
        }
        before = s;
        if (i === samples) end = [s.x, s.y];
      }
      if (trajectory.jx && trajectory.jy) {
        worst.jerk = Math.max(
          worst.jerk,
          Math.hypot(trajectory.jx[k], trajectory.jy[k]) / limits.jerkMmPerS3,
        );
      }
      clock += duration;
    }
    worst.restSpeed = Math.max(worst.restSpeed, Math.hypot(before.vx, before.vy));
    worst.accelJump = Math.max(worst.accelJump, Math.hypot(before.ax, before.ay));
  }
  for (; move < penMoves.length; move++) clock += penMoves[move].waitS;
  worst.clock = Math.max(worst.clock, Math.abs(clock - trajectory.totalS));
  if (end) worst.gap = Math.max(worst.gap, Math.hypot(trajectory.endX - end[0], trajectory.endY - end[1]));
  return worst;
}

function sample(trajectory: Trajectory, k: number, t: number) {
  const { x, y, vx, vy, ax, ay, jx, jy } = trajectory;
  const j = jx && jy ? [jx[k], jy[k]] : [0, 0];
  return {
    x: x[k] + vx[k] * t + (ax[k] * t * t) / 2 + (j[0] * t ** 3) / 6,
    y: y[k] + vy[k] * t + (ay[k] * t * t) / 2 + (j[1] * t ** 3) / 6,
    vx: vx[k] + ax[k] * t + (j[0] * t * t) / 2,
    vy: vy[k] + ay[k] * t + (j[1] * t * t) / 2,
    ax: ax[k] + j[0] * t,
    ay: ay[k] + j[1] * t,
  };
}

function allFinite(trajectory: Trajectory): boolean {
  const { durationS, x, y, vx, vy, ax, ay, jx, jy, startS, alongMm } = trajectory;
  for (const column of [durationS, x, y, vx, vy, ax, ay, startS, alongMm, jx, jy]) {
    if (!column) continue;
    for (let k = 0; k < trajectory.blockCount; k++) if (!Number.isFinite(column[k])) return false;
  }
  return (
    durationS.subarray(0, trajectory.blockCount).every((t) => t > 0) && Number.isFinite(trajectory.totalS)
  );
}

/** Distance from one stroke; remembers the last nearest segment, because a pen moves along it. */
export class NearStroke {
  private readonly points: readonly (readonly [number, number])[];
  private last = 0;

  constructor(strokes: StrokeSet, stroke: number) {
    const points: [number, number][] = [];
    for (let i = strokes.offsets[stroke]; i < strokes.offsets[stroke + 1]; i++) {
      points.push([strokes.xy[2 * i], strokes.xy[2 * i + 1]]);
    }
    if (points.length === 1) points.push(points[0]);
    this.points = points;
  }

  /** The distance, or to save time that of any segment nearer than `enough`. */
  distance(x: number, y: number, enough = 1e-9): number {
    const n = this.points.length - 1;
    let best = Infinity;
    let where = this.last;
    for (let step = 0; step < n && best >= enough; step++) {
      const i = (this.last + step) % n;
      const d = this.toSegment(i, x, y);
      if (d < best) {
        best = d;
        where = i;
      }
    }
    this.last = where;
    return best;
  }

  private toSegment(i: number, x: number, y: number): number {
    const [ax, ay] = this.points[i];
    const [bx, by] = this.points[i + 1];
    const dx = bx - ax;
    const dy = by - ay;
    const l2 = dx * dx + dy * dy;
    const t = l2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / l2)) : 0;
    return Math.hypot(x - ax - t * dx, y - ay - t * dy);
  }
}
