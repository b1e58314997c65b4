/**
 * Trajectory -> the line pieces that the preview draws, with true speed along ramps and corner curves.
 *
 * A block is split into pieces so that a straight piece stays within CHORD_MM of the curve, and its speed changes by at
 * most SPEED_STEP of the top speed (the renderer interpolates the colour in between). Pieces are in order of time, so
 * the part drawn so far is a number of pieces.
 */
import type { Trajectory } from "../../src/index.js";
import type { StrokeLayer } from "../../src/internal.js";
import { buildPickGrid, type PickGrid } from "./pick.js";
import {
  jointCode,
  JOINT_SHORT,
  LAYER_SHORT,
  PIECE_BYTES,
  PIECE_FLOATS,
  PIECE_SHORTS,
  VALUE_SHORT,
  type Pieces,
} from "./pieces.js";

const CHORD_MM = 0.008;
const SPEED_STEP = 0.05;
/** Shorter ramps are not split, because the difference is not visible. */
const MIN_PIECE_MM = 0.25;
const MAX_PIECES = 256;

export interface Scene {
  readonly draw: Pieces;
  readonly travel: Pieces;
  /** Top speed with the pen down. */
  readonly topDrawMmPerS: number;
  readonly totalS: number;
  /** Finds the piece of `draw` under the pointer. */
  readonly grid: PickGrid;
}

/** How far each layer's strokes are shifted for its pen; null: no pen has an offset. */
export const shiftsOf = (layers: readonly StrokeLayer[]): Shifts | null =>
  layers.some(({ shiftMm }) => shiftMm) ? layers.map(({ shiftMm }) => shiftMm ?? NO_SHIFT) : null;

type Shifts = readonly { readonly x: number; readonly y: number }[];
const NO_SHIFT = { x: 0, y: 0 };

/**
 * `strokeLayer` is StrokeSet.layer of the planned strokes. Linear in blocks. Strokes are shown where the pen draws them
 * on paper; moves with the pen up are shown where the carriage goes.
 */
export const buildScene = (
  trajectory: Trajectory,
  strokeLayer: Uint16Array,
  shifts: Shifts | null = null,
): Scene => {
  const tops = topSpeeds(trajectory);
  const counts = { draw: 0, travel: 0 };
  const { runs } = trajectory;
  for (let r = 0; r < runs.count; r++) {
    const isDraw = runs.stroke[r] >= 0;
    const top = isDraw ? tops.draw : tops.travel;
    let pieces = isDraw && isDot(trajectory, r) ? 1 : 0;
    for (let b = runs.firstBlock[r]; b < runs.firstBlock[r + 1]; b++) {
      pieces += pieceCount(trajectory, b, top);
    }
    counts[isDraw ? "draw" : "travel"] += pieces;
  }
  const draw = new PieceWriter(counts.draw, tops.draw);
  const travel = new PieceWriter(counts.travel, tops.travel);
  for (let r = 0; r < runs.count; r++) {
    const stroke = runs.stroke[r];
    const writer = stroke >= 0 ? draw : travel;
    const layer = stroke >= 0 ? strokeLayer[stroke] : 0;
    writer.shift = (stroke >= 0 && shifts?.[layer]) || NO_SHIFT;
    writer.beginRun();
    if (stroke >= 0 && isDot(trajectory, r)) writer.addDot(trajectory, r, layer);
    for (let b = runs.firstBlock[r]; b < runs.firstBlock[r + 1]; b++) {
      writer.addBlock(trajectory, b, pieceCount(trajectory, b, writer.topMmPerS), layer);
    }
  }
  const drawn = { count: counts.draw, bytes: draw.bytes };
  return {
    draw: drawn,
    travel: { count: counts.travel, bytes: travel.bytes },
    topDrawMmPerS: tops.draw,
    totalS: trajectory.totalS,
    grid: buildPickGrid(drawn),
  };
};

/** A dot is a draw run without blocks: the pen goes down and up on the spot. */
const isDot = ({ runs }: Trajectory, r: number): boolean => runs.firstBlock[r] === runs.firstBlock[r + 1];

/** The number of pieces that begin before `tS`, to the precision with which pieces have their times. */
export const piecesBefore = (pieces: Pieces, tS: number): number => {
  const floats = new Float32Array(pieces.bytes);
  const untilS = Math.fround(tS);
  let low = 0;
  let high = pieces.count;
  while (low < high) {
    const mid = (low + high) >> 1;
    if (floats[mid * PIECE_FLOATS + 4] < untilS) low = mid + 1;
    else high = mid;
  }
  return low;
};

const topSpeeds = (trajectory: Trajectory): { draw: number; travel: number } => {
  const { runs, vx, vy } = trajectory;
  const tops = [1e-9, 1e-9];
  for (let r = 0; r < runs.count; r++) {
    const kind = runs.stroke[r] >= 0 ? 0 : 1;
    let top2 = tops[kind] ** 2;
    for (let b = runs.firstBlock[r]; b < runs.firstBlock[r + 1]; b++) {
      top2 = Math.max(top2, vx[b] * vx[b] + vy[b] * vy[b]);
    }
    tops[kind] = Math.sqrt(top2);
  }
  return { draw: tops[0], travel: tops[1] };
};

/** The number of pieces for block `b`; 0 if it does not move. */
const pieceCount = (trajectory: Trajectory, b: number, topMmPerS: number): number => {
  const t = trajectory.durationS[b];
  if (!(t > 0)) return 0;
  const vx = trajectory.vx[b];
  const vy = trajectory.vy[b];
  const jx = trajectory.jx?.[b] ?? 0;
  const jy = trajectory.jy?.[b] ?? 0;
  const ax = trajectory.ax[b];
  const ay = trajectory.ay[b];
  const dvx = (ax + jx * t * 0.5) * t;
  const dvy = (ay + jy * t * 0.5) * t;
  const dx = (vx + dvx * 0.5) * t;
  const dy = (vy + dvy * 0.5) * t;
  const length = Math.hypot(dx, dy);
  if (length === 0 && dvx === 0 && dvy === 0) return 0;
  // Sagitta of the motion over its chord: |d × a| t² / 8 per unit of chord, with the mean acceleration.
  const across = length > 0 ? Math.abs(dx * dvy - dy * dvx) / length : 0;
  const forCurve = Math.sqrt((across * t) / 8 / CHORD_MM);
  const change = Math.abs(Math.hypot(vx + dvx, vy + dvy) - Math.hypot(vx, vy));
  const forSpeed = Math.min(change / (SPEED_STEP * topMmPerS), length / MIN_PIECE_MM);
  return Math.min(MAX_PIECES, Math.max(1, Math.ceil(Math.max(forCurve, forSpeed) - 1e-9)));
};

class PieceWriter {
  readonly bytes: ArrayBuffer;
  /** Subtracted from the carriage's position, mm. */
  shift: Shifts[number] = NO_SHIFT;
  private readonly floats: Float32Array;
  private readonly shorts: Uint16Array;
  private at = 0;
  /** The first piece of the run. */
  private runAt = 0;

  constructor(
    count: number,
    readonly topMmPerS: number,
  ) {
    this.bytes = new ArrayBuffer(count * PIECE_BYTES);
    this.floats = new Float32Array(this.bytes);
    this.shorts = new Uint16Array(this.bytes);
  }

  beginRun(): void {
    this.runAt = this.at;
  }

  /** Notes how the piece that was written last follows the one before it in its run. */
  private join(): void {
    if (this.at === this.runAt) return;
    const { floats, shorts } = this;
    const b = this.at * PIECE_FLOATS;
    const a = b - PIECE_FLOATS;
    const code = jointCode(
      floats[a + 2] - floats[a],
      floats[a + 3] - floats[a + 1],
      floats[b + 2] - floats[b],
      floats[b + 3] - floats[b + 1],
    );
    const s = this.at * PIECE_SHORTS + JOINT_SHORT;
    shorts[s] = code;
    shorts[s - PIECE_SHORTS] += code << 8;
  }

  addDot(trajectory: Trajectory, run: number, layer: number): void {
    const next = trajectory.runs.firstBlock[run];
    const isLast = next >= trajectory.blockCount;
    const x = (isLast ? trajectory.endX : trajectory.x[next]) - this.shift.x;
    const y = (isLast ? trajectory.endY : trajectory.y[next]) - this.shift.y;
    const startS = trajectory.runs.startS[run];
    this.floats.set([x, y, x, y, startS, startS], this.at * PIECE_FLOATS);
    this.shorts[this.at * PIECE_SHORTS + LAYER_SHORT] = layer;
    this.at++;
  }

  addBlock(trajectory: Trajectory, b: number, pieces: number, layer: number): void {
    const x = trajectory.x[b] - this.shift.x;
    const y = trajectory.y[b] - this.shift.y;
    const vx = trajectory.vx[b];
    const vy = trajectory.vy[b];
    const ax = trajectory.ax[b];
    const ay = trajectory.ay[b];
    const jx = trajectory.jx?.[b] ?? 0;
    const jy = trajectory.jy?.[b] ?? 0;
    const duration = trajectory.durationS[b];
    const startS = trajectory.startS[b];
    const toShort = 65_535 / this.topMmPerS;
    let px = x;
    let py = y;
    let pt = 0;
    let ps = Math.hypot(vx, vy);
    for (let k = 1; k <= pieces; k++) {
      const t = (duration * k) / pieces;
      const qx = x + t * (vx + t * (ax / 2 + (t * jx) / 6));
      const qy = y + t * (vy + t * (ay / 2 + (t * jy) / 6));
      const qs = Math.hypot(vx + t * (ax + (t * jx) / 2), vy + t * (ay + (t * jy) / 2));
      const f = this.at * PIECE_FLOATS;
      this.floats[f] = px;
      this.floats[f + 1] = py;
      this.floats[f + 2] = qx;
      this.floats[f + 3] = qy;
      this.floats[f + 4] = startS + pt;
      this.floats[f + 5] = startS + t;
      const s = this.at * PIECE_SHORTS;
      this.shorts[s + VALUE_SHORT] = Math.min(65_535, ps * toShort);
      this.shorts[s + VALUE_SHORT + 1] = Math.min(65_535, qs * toShort);
      this.shorts[s + LAYER_SHORT] = layer;
      this.join();
      this.at++;
      px = qx;
      py = qy;
      pt = t;
      ps = qs;
    }
  }
}

/** From the top of the scale of time to its beginning: a mm takes so many times as long. */
export const SLOWEST_TIMES = 10;

type ScenePicture = Pick<Scene, "draw" | "travel" | "totalS">;

/** The same pieces with other values: how long a mm takes, from the least (0) to `SLOWEST_TIMES` as long (1), by ratio. */
export const withTimes = (scene: Scene): ScenePicture =>
  withValues(scene, (speed) => Math.log(1 / Math.max(1 / 65_535, speed)) / Math.log(SLOWEST_TIMES));

/** Of the top speed. */
export interface SpeedRange {
  readonly from: number;
  readonly to: number;
}

/** The same pieces with other values: the speed within a range. */
export const withSpeeds = (scene: Scene, { from, to }: SpeedRange): ScenePicture =>
  withValues(scene, (speed) => (speed - from) / (to - from));

/** `valueOf` gets the share of the top speed; values are kept within 0 … 1. */
const withValues = ({ draw, travel, totalS }: Scene, valueOf: (speed: number) => number): ScenePicture => {
  const bytes = draw.bytes.slice(0);
  const shorts = new Uint16Array(bytes);
  for (let k = VALUE_SHORT; k < shorts.length; k += PIECE_SHORTS) {
    for (const at of [k, k + 1])
      shorts[at] = Math.round(65_535 * Math.min(1, Math.max(0, valueOf(shorts[at] / 65_535))));
  }
  return { draw: { count: draw.count, bytes }, travel, totalS };
};

/** The slowest and the fastest ink that a scale of speeds leaves to its ends. */
const LEFT_AT_AN_END = 0.05;
const SPEED_STEPS = 256;
/** A scale of nearly one speed begins at 0. */
const NARROWEST = 0.1;

/** The range of speeds with which most of a drawing is drawn, by length. Linear in the pieces. */
export const usualSpeeds = ({ draw }: Pick<Scene, "draw">): SpeedRange => {
  const floats = new Float32Array(draw.bytes);
  const shorts = new Uint16Array(draw.bytes);
  const lengths = new Float64Array(SPEED_STEPS);
  for (let i = 0; i < draw.count; i++) {
    const [f, s] = [i * PIECE_FLOATS, i * PIECE_SHORTS + VALUE_SHORT];
    const speed = (shorts[s] + shorts[s + 1]) / 2 / 65_535;
    const at = Math.min(SPEED_STEPS - 1, Math.floor(speed * SPEED_STEPS));
    lengths[at] += Math.hypot(floats[f + 2] - floats[f], floats[f + 3] - floats[f + 1]);
  }
  const total = lengths.reduce((sum, length) => sum + length, 0);
  let from = 0;
  for (let sum = lengths[0]; sum < LEFT_AT_AN_END * total; sum += lengths[from]) from++;
  let to = SPEED_STEPS;
  for (let sum = lengths[to - 1]; sum < LEFT_AT_AN_END * total; sum += lengths[to - 1]) to--;
  const isNarrow = to - from < NARROWEST * to;
  return { from: isNarrow ? 0 : from / SPEED_STEPS, to: to / SPEED_STEPS };
};
