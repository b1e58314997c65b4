/**
 * One straight piece between known speeds, as blocks under constant acceleration: the trapezoid of
 * `trapezoid.ts` for callers that come piece by piece instead of segment by segment.
 *
 * The caller's look-ahead has made sure that |v1² − v0²| ≤ 2 A d.
 */
import type { BlockColumns } from "./block-columns.js";
import { LOSS, keepFloor, type Phases } from "./floor-phases.js";
import { capSegments, isWithinMotors, type RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";

/** A change of speed² below this share of it, or a cruise below this share of the piece or of its way from rest, is rounding. */
export const NEGLIGIBLE = 1e-11;

/** A straight piece: where it begins, where it leads, how far. */
export interface Straight {
  x: number;
  y: number;
  ux: number;
  uy: number;
  /** mm of the drawing at its beginning, and for each mm of it. */
  alongMm: number;
  alongPerMm: number;
  length: number;
}

/** Writes a run of one straight from rest to rest. Most are too short for V: up to half of the way, and down from there. */
export function writeSingle(path: RunPath, limits: RunLimits, out: BlockColumns): void {
  const { accel, speed, easeSpeed, floorS } = limits;
  const isCapped = easeSpeed < speed || !isWithinMotors(limits);
  if (isCapped) capSegments(path, limits);
  const most2 = isCapped ? path.cap2[0]! : speed * speed;
  const l = path.length[0]!;
  const x = path.x[0]!;
  const y = path.y[0]!;
  const ux = path.ux[0]!;
  const uy = path.uy[0]!;
  out.reserve(3, 1);
  const peak2 = accel * l;
  const peak = Math.sqrt(peak2);
  const t = l / peak;
  // A little below the floor there may be a slower way that keeps it (see `keepFloor`).
  if (!(peak2 <= most2) || (t < floorS && t > (1 - LOSS / 2) * floorS)) {
    single.x = x;
    single.y = y;
    single.ux = ux;
    single.uy = uy;
    single.alongMm = path.startAlong;
    single.length = l;
    writeStraight(single, 0, 0, Math.sqrt(most2), accel, floorS, out);
    return;
  }
  const half = l / 2;
  const v = ux * peak;
  const w = uy * peak;
  const a = ux * accel;
  const b = uy * accel;
  const { durationS, x: bx, y: by, vx, vy, ax, ay, startS, alongMm } = out;
  const k = out.count;
  const clock = out.clockS;
  durationS[k] = durationS[k + 1] = t;
  bx[k] = x;
  by[k] = y;
  bx[k + 1] = x + ux * half;
  by[k + 1] = y + uy * half;
  vx[k] = vy[k] = 0;
  vx[k + 1] = v;
  vy[k + 1] = w;
  ax[k] = a;
  ay[k] = b;
  ax[k + 1] = -a;
  ay[k + 1] = -b;
  startS[k] = clock;
  startS[k + 1] = clock + t;
  alongMm[k] = path.startAlong;
  alongMm[k + 1] = path.startAlong + half;
  out.count = k + 2;
  out.clockS = clock + t + t;
}

/** Filled anew for every run. */
const single: Straight = { x: 0, y: 0, ux: 0, uy: 0, alongMm: 0, alongPerMm: 1, length: 0 };

/**
 * Appends the blocks that take `piece` from speed `v0` to speed `v1` under `maxSpeed` and `accel`, none of them
 * shorter than `floorS` seconds where that can be helped.
 */
export function writeStraight(
  piece: Straight,
  v0: number,
  v1: number,
  maxSpeed: number,
  accel: number,
  floorS: number,
  out: BlockColumns,
): void {
  const l = piece.length;
  const max2 = Math.max(maxSpeed * maxSpeed, v0 * v0, v1 * v1);
  const peak2 = Math.min((v0 * v0 + v1 * v1) / 2 + accel * l, max2);
  const least2 = NEGLIGIBLE * peak2;
  const rise = peak2 - v0 * v0 > least2 ? (peak2 - v0 * v0) / (2 * accel) : 0;
  const fall = peak2 - v1 * v1 > least2 ? (peak2 - v1 * v1) / (2 * accel) : 0;
  phases.peak = rise > 0 || fall > 0 ? Math.sqrt(peak2) : Math.max(v0, v1);
  phases.rise = rise;
  phases.fall = fall;
  if (floorS > 0 && (rise > 0 || fall > 0)) keepFloor(l, v0, v1, accel, floorS, phases);
  writePhases(piece, v0, v1, Math.max(NEGLIGIBLE * l, least2 / (2 * accel)), out);
}

/** Filled anew for every piece. */
const phases: Phases = { peak: 0, rise: 0, fall: 0 };

/**
 * Each phase ends where the next begins, and the last where the piece does: rounding opens no gap. Steady for `least` mm
 * or less is what rounding left.
 */
function writePhases(piece: Straight, v0: number, v1: number, least: number, out: BlockColumns): void {
  const { peak, rise, fall } = phases;
  const l = piece.length;
  const cruises = l - rise - fall > least;
  let done = 0;
  let w = v0;
  if (rise > 0 && (fall > 0 || cruises)) {
    const d = cruises ? rise : l - fall;
    phase(piece, done, w, peak, d, out);
    done += d;
    w = peak;
  }
  if (fall > 0 && cruises) {
    const d = l - done - fall;
    phase(piece, done, w, peak, d, out);
    done += d;
    w = peak;
  }
  phase(piece, done, w, v1, l - done, out);
}

function phase(piece: Straight, from: number, w0: number, w1: number, d: number, out: BlockColumns): void {
  const { ux, uy } = piece;
  const a = ((w1 - w0) * (w1 + w0)) / (2 * d);
  out.push(
    (2 * d) / (w0 + w1),
    piece.x + ux * from,
    piece.y + uy * from,
    ux * w0,
    uy * w0,
    ux * a,
    uy * a,
    piece.alongMm + from * piece.alongPerMm,
  );
}
