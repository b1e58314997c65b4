/**
 * One straight piece between known speeds, as blocks under constant acceleration: the trapezoid of
 * `trapezoid.ts` for callers that come piece by piece instead of segment by segment.
 *
 * The caller's look-ahead has made sure that |v1² − v0²| ≤ 2 A d.
 */
import type { BlockColumns } from "./block-columns.js";
import { keepFloor, type Phases } from "./floor-phases.js";

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
