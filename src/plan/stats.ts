/** Summary figures of a trajectory, as shown to users and by `plan --json`. */
import { blockLength, runEndS, type Trajectory } from "./trajectory.js";

/** The result of `trajectoryStats`. */
export interface TrajectoryStats {
  /** Distance with the pen down, mm. */
  readonly drawMm: number;
  /** Distance with the pen up, mm. */
  readonly travelMm: number;
  /** Lifts of a pen that was down. */
  readonly penLiftCount: number;
  /** Max speed, mm/s. */
  readonly maxSpeed: number;
  /** Max acceleration, mm/s², within blocks; excludes the velocity jump at a `junction` corner. */
  readonly maxAccel: number;
  /** Total duration, pen waits included. */
  readonly durationS: number;
}

/** Seconds of a plot by what the machine does. Their sum is the whole time. */
export interface TimesByKind {
  readonly drawS: number;
  readonly travelS: number;
  /** The carriage waits: for the pen to lift or lower, or as a layer's name asks for. */
  readonly penS: number;
}

/** A layer's part of a plot: from the end of what is drawn before, until the end of its own last stroke. */
export interface LayerTimes extends TimesByKind {
  /** Index in `StrokeSet.layers`. */
  readonly layer: number;
  readonly drawMm: number;
}

/** The time of each layer in the order of drawing, and of what follows the last one: the way home. Linear in runs. */
export function timesByLayer(
  trajectory: Trajectory,
  layerOf: Uint16Array,
): { readonly layers: readonly LayerTimes[]; readonly home: TimesByKind } {
  const { runs } = trajectory;
  const layers: LayerTimes[] = [];
  let travelS = 0;
  let beganS = 0;
  for (let run = 0; run < runs.count; run++) {
    const [stroke, endS] = [runs.stroke[run], runEndS(trajectory, run)];
    const runS = endS - runs.startS[run];
    if (stroke < 0) {
      travelS += runS;
      continue;
    }
    const layer = layerOf[stroke];
    const before = layers.at(-1)?.layer === layer ? layers.pop() : undefined;
    layers.push({
      layer,
      drawMm: (before?.drawMm ?? 0) + runMm(trajectory, run),
      drawS: (before?.drawS ?? 0) + runS,
      travelS: (before?.travelS ?? 0) + travelS,
      penS: (before?.penS ?? 0) + (endS - beganS - runS - travelS),
    });
    [beganS, travelS] = [endS, 0];
  }
  return { layers, home: { drawS: 0, travelS, penS: trajectory.totalS - beganS - travelS } };
}

function runMm(trajectory: Trajectory, run: number): number {
  let lengthMm = 0;
  for (let k = trajectory.runs.firstBlock[run]; k < trajectory.runs.firstBlock[run + 1]; k++)
    lengthMm += blockLength(trajectory, k, trajectory.durationS[k]);
  return lengthMm;
}

/** Distances, pen lifts, duration and maxima of a trajectory. Linear in the number of blocks. */
export function trajectoryStats(trajectory: Trajectory): TrajectoryStats {
  const { runs } = trajectory;
  let drawMm = 0;
  let travelMm = 0;
  let speed2 = 0;
  let accel2 = 0;
  for (let run = 0; run < runs.count; run++) {
    const lengthMm = runMm(trajectory, run);
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
      speed2 = Math.max(speed2, blockMaxSpeed2(trajectory, k));
      accel2 = Math.max(accel2, blockMaxAccel2(trajectory, k));
    }
    if (runs.stroke[run] < 0) travelMm += lengthMm;
    else drawMm += lengthMm;
  }
  return {
    drawMm,
    travelMm,
    penLiftCount: liftCount(trajectory),
    maxSpeed: Math.sqrt(speed2),
    maxAccel: Math.sqrt(accel2),
    durationS: trajectory.totalS,
  };
}

/**
 * Moving up when the pen is already up is a wait, and the first pen move only makes sure that the pen is up:
 * neither counts as a lift.
 */
function liftCount({ penMoves }: Trajectory): number {
  let lifts = 0;
  for (let k = 1; k < penMoves.count; k++) if (penMoves.up[k] > penMoves.up[k - 1]) lifts++;
  return lifts;
}

/**
 * Without jerk, speed² is a convex parabola in time: its max is at an end. With jerk the inside is sampled.
 */
function blockMaxSpeed2(trajectory: Trajectory, k: number): number {
  const { jx, jy } = trajectory;
  const inner = jx && jy && (jx[k] !== 0 || jy[k] !== 0) ? 8 : 1;
  let max2 = 0;
  for (let i = 0; i <= inner; i++) {
    const t = (trajectory.durationS[k] * i) / inner;
    const vx = trajectory.vx[k] + t * (trajectory.ax[k] + (t * (jx ? jx[k] : 0)) / 2);
    const vy = trajectory.vy[k] + t * (trajectory.ay[k] + (t * (jy ? jy[k] : 0)) / 2);
    max2 = Math.max(max2, vx * vx + vy * vy);
  }
  return max2;
}

function blockMaxAccel2(trajectory: Trajectory, k: number): number {
  const t = trajectory.durationS[k];
  const ax = trajectory.ax[k];
  const ay = trajectory.ay[k];
  const bx = ax + t * (trajectory.jx ? trajectory.jx[k] : 0);
  const by = ay + t * (trajectory.jy ? trajectory.jy[k] : 0);
  return Math.max(ax * ax + ay * ay, bx * bx + by * by);
}
