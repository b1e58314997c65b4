/**
 * Mode `scurve`: |j| ≤ J at every instant, and continuous acceleration. Blocks of constant acceleration, as
 * in `blend`, are filtered by a box over time (filter.ts).
 *
 *   line with corners   w = 2 A'/J, since a can go from −A' to A' within w
 *                       the box deviates by A' w²/24 = A'³/6J², which is BOX_SHARE of δ
 *   single straight     w = A'/J, and a speed for which the constant-speed phase lasts w, so that a never goes
 *                       from A' to −A' within w; on a straight the box does not deviate
 *   polygon             a stop at every corner, if that is faster: each side is then a single straight
 *
 * A larger BOX_SHARE allows a larger A', but leaves less of δ for corners. On the sample drawings 5/8 takes the
 * least total time. As J grows, w tends to 0, A' to A, and the motion to
 * that of `blend`.
 */
import { capSegments, mmPerFrameMm, type RunLimits } from "../limits.js";
import type { RunPath } from "../run-path.js";

/** Share of δ for the box. */
const BOX_SHARE = 5 / 8;

/** The limits for planning the blocks of constant acceleration, and the width of the box that filters them, s. */
export interface FilteredPlan {
  readonly limits: RunLimits;
  readonly widthS: number;
}

export function filteredPlan(path: RunPath, limits: RunLimits): FilteredPlan {
  return path.segmentCount === 1 && !path.mayGrow ? forStraight(path, limits) : forLine(limits);
}

function forLine(limits: RunLimits): FilteredPlan {
  const { jerk, corner } = limits;
  const accel = Math.min(limits.accel, Math.cbrt(6 * jerk * jerk * BOX_SHARE * corner));
  const width = (2 * accel) / jerk;
  return {
    limits: { ...limits, accel, corner: corner - (accel * width * width) / 24 },
    widthS: width,
  };
}

/** Width of the box in s, acceleration and speed of the fastest profile of a straight under |j| ≤ J. */
interface StraightProfile {
  readonly width: number;
  readonly accel: number;
  readonly speed: number;
}

/**
 * The fastest profile under |j| ≤ J. It is shorter by A'/J than with w = 2 A'/J. A' is the largest
 * acceleration that a short straight (L) or a low speed limit (V) leaves time to reach.
 */
function straightProfile(length: number, top: number, { accel: maxAccel, jerk }: RunLimits): StraightProfile {
  const accel = Math.min(maxAccel, Math.cbrt((length * jerk * jerk) / 2), Math.sqrt(top * jerk));
  const width = accel / jerk;
  // v/A' to accelerate, the same to brake, and w at speed v: v²/A' + v w = L.
  const speed = (accel / 2) * (Math.sqrt(width * width + (4 * length) / accel) - width);
  return { width, accel, speed: Math.min(top, speed) };
}

function forStraight(path: RunPath, limits: RunLimits): FilteredPlan {
  capSegments(path, limits);
  const { width, accel, speed } = straightProfile(path.length[0], Math.sqrt(path.cap2[0]), limits);
  const mm = mmPerFrameMm(limits, path.ux[0], path.uy[0]);
  return { limits: { ...limits, accel, speed: speed * mm }, widthS: width };
}

/**
 * Whether the run takes less than `lineS` with a stop at every point. That is the case for long straights
 * with sharp corners: each straight alone has the full acceleration and a box of half the width.
 */
export function stopsAreFaster(path: RunPath, limits: RunLimits, lineS: number): boolean {
  capSegments(path, limits);
  const { segmentCount, length, cap2 } = path;
  let timeS = 0;
  for (let i = 0; i < segmentCount && timeS < lineS; i++) {
    const { width, accel, speed } = straightProfile(length[i], Math.sqrt(cap2[i]), limits);
    timeS += length[i] / speed + speed / accel + width;
  }
  return timeS < lineS;
}
