/**
 * Where a line passes a point: each place at which the line is nearer to the point than just before and after it.
 *
 *   ━━━━━━━o━━━━━━━╮       two passes of the point ·
 *          ·       ┃
 *   ━━━━━━━o━━━━━━━╯
 */
import { nearestShare } from "./polyline.js";

export interface Pass {
  /** Where on the line: the number of a point, plus the share of the piece after it. 3.25 is between points 3 and 4. */
  readonly at: number;
  /** The last such number, if the line rests there: the next points are the same. Otherwise equal to `at`. */
  readonly until: number;
  /** The length of the line before the pass. */
  readonly alongMm: number;
  /** The distance from the point. */
  readonly awayMm: number;
}

/** Passes whose distances differ by less count as equally near: the point is rounded to steps. */
const SAME_MM = 0.02;

/** @param xy the line's points: x, y, x, y … */
export function passesOf(xy: ArrayLike<number>, x: number, y: number): Pass[] {
  const passes: Pass[] = [];
  const last = xy.length / 2 - 1;
  let lengthMm = 0;
  const awayFrom = (px: number, py: number): number => Math.hypot(px - x, py - y);
  // The point of the line that is a pass unless the line comes nearer after it. Null: the line already leads away.
  let arrivedAt: number | null = 0;
  const addPoint = (i: number): void => {
    if (arrivedAt === null) return;
    passes.push({ at: arrivedAt, until: i, alongMm: lengthMm, awayMm: awayFrom(xy[2 * i], xy[2 * i + 1]) });
  };
  for (let i = 0; i < last; i++) {
    const [x0, y0, x1, y1] = [xy[2 * i], xy[2 * i + 1], xy[2 * i + 2], xy[2 * i + 3]];
    if (x0 === x1 && y0 === y1) continue;
    const share = nearestShare(x0, y0, x1, y1, x, y);
    const pieceMm = Math.hypot(x1 - x0, y1 - y0);
    if (share === 0) addPoint(i);
    else if (share < 1) {
      const awayMm = awayFrom(x0 + share * (x1 - x0), y0 + share * (y1 - y0));
      passes.push({ at: i + share, until: i + share, alongMm: lengthMm + share * pieceMm, awayMm });
    }
    arrivedAt = share === 1 ? i + 1 : null;
    lengthMm += pieceMm;
  }
  addPoint(last);
  return passes;
}

/** The nearest of several passes; if others are as near, the one that is least `off` what is expected. */
export function likeliestPass<P extends Pick<Pass, "awayMm">>(
  passes: readonly P[],
  off: (pass: P) => number,
): P | null {
  const nearestMm = passes.reduce((mm, { awayMm }) => Math.min(mm, awayMm), Infinity);
  let likeliest: P | null = null;
  for (const pass of passes) {
    if (pass.awayMm > nearestMm + SAME_MM) continue;
    if (likeliest === null || off(pass) < off(likeliest)) likeliest = pass;
  }
  return likeliest;
}
