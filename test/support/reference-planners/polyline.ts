/** Shared code of the reference planners. Written for readability, not speed. */

export type Point = readonly [number, number];

export interface Limits {
  /** V, mm/s */
  readonly speed: number;
  /** A, mm/s² */
  readonly accel: number;
  /** δ, mm: each system's own corner setting is chosen to give the same δ. */
  readonly deviation: number;
  /** J, mm/s³, of planners whose own limit it is. */
  readonly jerk?: number;
}

/** One vertex between two segments. */
export interface Corner {
  /** φ, the turn: 0 straight on, π back. */
  readonly turn: number;
  /** Lengths of the segments before and after, mm. */
  readonly before: number;
  readonly after: number;
}

/** A system, as far as planning a polyline is concerned. */
export interface ReferencePlanner {
  readonly name: string;
  readonly cornerRule: string;
  readonly profile: string;
  /** Corners are parabolas (OQUAM); otherwise the velocity jumps there. */
  readonly blends?: boolean;
  /** It sends slices of constant speed of about this duration, s. */
  readonly sliceS?: number;
  plan(points: readonly Point[], limits: Limits): ReferencePlan;
  /** One segment from speed v0 to v1; without it, a trapezoid. */
  scurvesOf?(length: number, v0: number, v1: number, limits: Limits): readonly SCurve[];
}

/** A change of speed along a line: half of its time the jerk is +J, the other half −J. */
export interface SCurve {
  readonly durationS: number;
  readonly v0: number;
  readonly v1: number;
}

interface ReferencePlan {
  readonly timeS: number;
  /** Speed at every point, mm/s. */
  readonly speeds: readonly number[];
  /** Number of pieces of constant acceleration (or speed) that it would send. */
  readonly pieces: number;
}

/** Without repeated points. */
export function distinct(points: readonly Point[]): Point[] {
  return points.filter((p, i) => i === 0 || distance(points[i - 1], p) > 1e-6);
}

export const distance = (a: Point, b: Point): number => Math.hypot(b[0] - a[0], b[1] - a[1]);

export function cornersOf(points: readonly Point[]): Corner[] {
  const corners: Corner[] = [];
  for (let i = 1; i + 1 < points.length; i++) {
    const [a, b, c] = [points[i - 1], points[i], points[i + 1]];
    const into = Math.atan2(b[1] - a[1], b[0] - a[0]);
    const out = Math.atan2(c[1] - b[1], c[0] - b[0]);
    const difference = Math.abs(out - into) % (2 * Math.PI);
    const turn = Math.min(difference, 2 * Math.PI - difference);
    corners.push({ turn, before: distance(a, b), after: distance(b, c) });
  }
  return corners;
}

/** Full look-ahead from rest to rest under corner limits, then a trapezoid on every segment. */
export function planTrapezoids(
  points: readonly Point[],
  limits: Limits,
  cornerSpeed: (corner: Corner) => number,
): ReferencePlan {
  const { speed, accel } = limits;
  const lengths = points.slice(1).map((p, i) => distance(points[i], p));
  const speeds = [0, ...cornersOf(points).map((corner) => Math.min(speed, cornerSpeed(corner))), 0];
  for (let i = lengths.length - 1; i >= 0; i--) {
    speeds[i] = Math.min(speeds[i], Math.sqrt(speeds[i + 1] ** 2 + 2 * accel * lengths[i]));
  }
  let timeS = 0;
  let pieces = 0;
  lengths.forEach((length, i) => {
    const v0 = speeds[i];
    speeds[i + 1] = Math.min(speeds[i + 1], Math.sqrt(v0 ** 2 + 2 * accel * length));
    const v1 = speeds[i + 1];
    const peak = Math.min(speed, Math.sqrt((v0 ** 2 + v1 ** 2) / 2 + accel * length));
    const cruise = length - (2 * peak ** 2 - v0 ** 2 - v1 ** 2) / (2 * accel);
    timeS += (2 * peak - v0 - v1) / accel + Math.max(0, cruise) / peak;
    pieces += [peak - v0 > 1e-6, cruise > 1e-6, peak - v1 > 1e-6].filter(Boolean).length;
  });
  return { timeS, speeds, pieces };
}

/**
 * Max v² κ on curves (turns below 1 rad), as a share of A: κ is the curvature of the circle tangent to both
 * segments at half of the shorter one.
 */
export function worstCurveAccel(points: readonly Point[], plan: ReferencePlan, accel: number): number {
  let worst = 0;
  cornersOf(points).forEach(({ turn, before, after }, i) => {
    if (turn > 1) return;
    const curvature = Math.tan(turn / 2) / (Math.min(before, after) / 2);
    worst = Math.max(worst, (plan.speeds[i + 1] ** 2 * curvature) / accel);
  });
  return worst;
}
