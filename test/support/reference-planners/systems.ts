/**
 * Other systems' rules for corners and speed, written from their published descriptions, so that one drawing
 * can be planned under each. φ is the turn, θ = π − φ the angle between the segments.
 */
import {
  cornersOf,
  distance,
  planTrapezoids,
  type Corner,
  type Limits,
  type ReferencePlanner,
} from "./polyline.js";

/** Jeon 2011: a circle at distance δ from the corner; v² = A R, R = δ s / (1 − s), s = sin(θ/2) = cos(φ/2). */
export function junctionDeviation({ turn }: Corner, { accel, deviation }: Limits): number {
  const s = Math.cos(turn / 2);
  return s > 1 - 1e-12 ? Infinity : Math.sqrt((accel * deviation * s) / (1 - s));
}

const GRBL: ReferencePlanner = {
  name: "Grbl",
  cornerRule: "junction deviation",
  profile: "trapezoid, buffer of 16 blocks (here: unlimited)",
  plan: (points, limits) => planTrapezoids(points, limits, (corner) => junctionDeviation(corner, limits)),
};

/** axi treats a reversal as a full stop, and anything within 1e-9 of straight as no corner. */
export const AXI: ReferencePlanner = {
  name: "axi, motion (Fogleman), saxi",
  cornerRule: "junction deviation",
  profile: "trapezoid, back-tracking look-ahead",
  plan: (points, limits) =>
    planTrapezoids(points, limits, (corner) => {
      if (Math.abs(corner.turn - Math.PI) < 1e-4) return 0;
      return junctionDeviation(corner, limits);
    }),
};

/** AxiDraw's software: junction deviation as well; it sends slices of constant speed of about 1/40 s. */
const AXIDRAW_SLICE_S = 0.025;
export const AXIDRAW: ReferencePlanner = {
  name: "AxiDraw software",
  cornerRule: "junction deviation",
  profile: "trapezoid cut into slices of constant speed",
  sliceS: AXIDRAW_SLICE_S,
  plan(points, limits) {
    const plan = planTrapezoids(points, limits, (corner) => junctionDeviation(corner, limits));
    return { ...plan, pieces: Math.max(points.length - 1, Math.ceil(plan.timeS / AXIDRAW_SLICE_S)) };
  },
};

/** Klipper: δ from the square-corner velocity, v_sq² (√2 − 1) / A, and the tangent circle at half of the shorter side. */
const KLIPPER: ReferencePlanner = {
  name: "Klipper",
  cornerRule: "junction deviation and centripetal bound",
  profile: "trapezoid (its smoothed look-ahead left out)",
  plan: (points, limits) =>
    planTrapezoids(points, limits, (corner) => {
      const radius = Math.min(corner.before, corner.after) / 2 / Math.tan(corner.turn / 2);
      return Math.min(junctionDeviation(corner, limits), Math.sqrt(limits.accel * radius));
    }),
};

/**
 * Oquam: a parabola at every corner, entered and left at the same speed, at most half of the shorter segment
 * long and at most δ away; straight pieces between them, with trapezoids.
 *
 *   δ:    v² = 2 A δ / sin²(φ/2)         length: v² = A L / sin(φ/2)
 */
const OQUAM: ReferencePlanner = {
  name: "Oquam",
  cornerRule: "parabolic blend at one speed",
  profile: "trapezoid between blends",
  blends: true,
  plan(points, limits) {
    const { accel, deviation, speed } = limits;
    const corners = cornersOf(points).map(({ turn, before, after }) => {
      const s = Math.sin(turn / 2);
      const longest = Math.min(before, after) / 2;
      const v2 = Math.min(speed ** 2, (2 * accel * deviation) / s ** 2, (accel * longest) / s);
      return { s, v2 };
    });
    // Slower corners, found by look-ahead over the rest of the segments, are shorter too.
    const speeds2 = [0, ...corners.map((c) => c.v2), 0];
    const reach = (i: number, v2: number): number => (corners[i - 1] ? (v2 * corners[i - 1].s) / accel : 0);
    const lengths = points.slice(1).map((p, i) => distance(points[i], p));
    const straight = (i: number): number =>
      Math.max(0, lengths[i] - reach(i, speeds2[i]) - reach(i + 1, speeds2[i + 1]));
    for (let i = lengths.length - 1; i >= 0; i--) {
      speeds2[i] = Math.min(speeds2[i], speeds2[i + 1] + 2 * accel * straight(i));
    }
    let timeS = 0;
    let pieces = corners.length;
    lengths.forEach((_, i) => {
      speeds2[i + 1] = Math.min(speeds2[i + 1], speeds2[i] + 2 * accel * straight(i));
      const [v0, v1] = [Math.sqrt(speeds2[i]), Math.sqrt(speeds2[i + 1])];
      const l = straight(i);
      const peak = Math.min(speed, Math.sqrt((v0 ** 2 + v1 ** 2) / 2 + accel * l));
      const cruise = l - (2 * peak ** 2 - v0 ** 2 - v1 ** 2) / (2 * accel);
      timeS += (2 * peak - v0 - v1) / accel + (peak > 0 ? Math.max(0, cruise) / peak : 0);
      const s = corners[i]?.s ?? 0;
      timeS += (2 * v1 * s) / accel;
      pieces += [peak - v0 > 1e-6, cruise > 1e-6, peak - v1 > 1e-6].filter(Boolean).length;
    });
    return { timeS, speeds: speeds2.map(Math.sqrt), pieces };
  },
};

export const REFERENCE_PLANNERS: readonly ReferencePlanner[] = [GRBL, AXI, AXIDRAW, KLIPPER, OQUAM];
