/**
 * The pen's motion over time: constant-acceleration (or constant-jerk) blocks in columns.
 *
 *   t from a block's start:  p(t) = p0 + v0 t + a t²/2 + j t³/6
 *
 * Blocks stand in runs. A run begins and ends at rest with the pen held up (travel) or down
 * (draw); between two runs the pen may move, and the carriage waits for it:
 *
 *   run 0 travel | drop | run 1 draw | lift | run 2 travel | drop | run 3 draw | lift | run 4 travel home
 */
export interface Trajectory {
  readonly blockCount: number;
  /** Seconds each block takes. All columns have `blockCount` used entries (arrays may be longer). */
  readonly durationS: Float64Array;
  /** Start place, mm in the machine frame. */
  readonly x: Float64Array;
  readonly y: Float64Array;
  /** Start velocity, mm/s. */
  readonly vx: Float64Array;
  readonly vy: Float64Array;
  /** Acceleration at the start, mm/s². */
  readonly ax: Float64Array;
  readonly ay: Float64Array;
  /** Jerk, mm/s³; null where it is zero everywhere. */
  readonly jx: Float64Array | null;
  readonly jy: Float64Array | null;
  /** Seconds from the trajectory's start to each block's start, pen waits included. */
  readonly startS: Float64Array;
  /** mm along the run's source polyline at the block's start. */
  readonly alongMm: Float64Array;
  readonly runs: RunColumns;
  /** Pen moves, in order of time. */
  readonly penMoves: readonly PenMove[];
  /** The whole, pen waits included. */
  readonly totalS: number;
  /** Where it ends, mm. */
  readonly endX: number;
  readonly endY: number;
}

export interface RunColumns {
  readonly count: number;
  /** count + 1: run r has blocks [firstBlock[r], firstBlock[r+1]). */
  readonly firstBlock: Uint32Array;
  /** Stroke index in the planned StrokeSet; −1 for travel. */
  readonly stroke: Int32Array;
  /** Seconds from the trajectory's start to the run's first motion. */
  readonly startS: Float64Array;
}

/** The pen is lifted or dropped before run `beforeRun` (= runs.count: after the last one). */
export interface PenMove {
  readonly beforeRun: number;
  readonly up: boolean;
  /** Seconds from the trajectory's start. */
  readonly startS: number;
  /** How long the carriage waits for it. */
  readonly waitS: number;
  /** Target height, percent of the servo's range. */
  readonly heightPct: number;
}

/** A place in the drawing from which a plan can go on: a stroke, and mm along its polyline. */
export interface Place {
  readonly stroke: number;
  readonly alongMm: number;
}

/** One instant of a trajectory. */
export interface MotionState {
  x: number;
  y: number;
  vx: number;
  vy: number;
  ax: number;
  ay: number;
  penUp: boolean;
  /** −1 while travelling or waiting for the pen. */
  stroke: number;
  alongMm: number;
}
