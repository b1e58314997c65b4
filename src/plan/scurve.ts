/**
 * Mode `scurve`: |j| ≤ J at every instant and acceleration without jumps. Blocks of constant acceleration, as in `blend`,
 * are filtered by a box over time (filter.ts).
 *
 *   line with corners   box of w = 2 A'/J, since a can go from −A' to A' within it
 *                       the box leaves the line by A' w²/24 = A'³/6J², which gets the share of δ below; corners get the rest
 *   single straight     box of w = A'/J: the speed is chosen so that the steady phase lasts for w, so a never goes
 *                       from A' to −A' within a box, and the box does not leave a straight
 *
 * The share of δ: the more the box gets, the greater A', and the less is left for corners. On the samples 3/4 takes the
 * least time in all (1/2: 2 % more; 0.85: about as much). As J grows, w falls to 0, A' is A, and the mode becomes `blend`.
 */
import { boxKernel, type Kernel } from "./filter.js";
import { capSegments, type RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";

/** Share of δ for the box. */
const BOX_SHARE = 3 / 4;

/** The limits to plan blocks of constant acceleration with, and the filter for them. */
export interface FilteredPlan {
  readonly limits: RunLimits;
  readonly kernel: Kernel;
}

export function filteredPlan(path: RunPath, limits: RunLimits): FilteredPlan {
  return path.segmentCount === 1 ? forStraight(path, limits) : forLine(limits);
}

function forLine(limits: RunLimits): FilteredPlan {
  const { jerk, corner } = limits;
  const accel = Math.min(limits.accel, Math.cbrt(6 * jerk * jerk * BOX_SHARE * corner));
  const width = (2 * accel) / jerk;
  return {
    limits: { ...limits, accel, corner: corner - (accel * width * width) / 24 },
    kernel: boxKernel(width),
  };
}

/**
 * The fastest profile under |j| ≤ J. It is A'/J shorter than with w = 2 A'/J: of the accelerations that it could have, A' is
 * the greatest that a short straight (L) or a low limit of speed (V) leaves time to reach.
 */
function forStraight(path: RunPath, limits: RunLimits): FilteredPlan {
  const { jerk } = limits;
  capSegments(path, limits);
  const top = Math.sqrt(path.cap2[0]!);
  const length = path.length[0]!;
  const accel = Math.min(limits.accel, Math.cbrt((length * jerk * jerk) / 2), Math.sqrt(top * jerk));
  const width = accel / jerk;
  // v/A' to speed up, as long to brake, w at speed v: v²/A' + v w = L.
  const speed = (accel / 2) * (Math.sqrt(width * width + (4 * length) / accel) - width);
  return { limits: { ...limits, accel, speed: Math.min(limits.speed, speed) }, kernel: boxKernel(width) };
}
