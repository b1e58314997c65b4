/**
 * The planner of the NextDraw software (Bantam Tools, 1.x), as far as it is known:
 *
 * - A change of speed is an S-curve: half of its time the jerk is +J, the other half −J. Acceleration has no limit of its own.
 * - A vertex is passed at v cosⁿ φ, φ being the turn and v the speed reached before it: n = 4 if v is over half of the limit,
 *   n = 1 if it is over a quarter, and no reduction below. A turn of 90° or more counts as 90°. Never over 80 % of the limit.
 * - A change of speed takes at least 7 ms.
 *
 * Not known is how it shapes segments that are too short for this. Assumed here: one S-curve from the first speed to the second,
 * with the jerk that this takes.
 */
import { cornersOf, distance, type Limits, type ReferencePlanner, type SCurve } from "./polyline.js";

const MIN_RAMP_S = 0.007;
/** Of the speed limit, at any vertex. */
const VERTEX_SHARE = 0.8;
/** Halvings of the speed range: to 1e-10 of the limit. */
const HALVINGS = 34;
/** Shorter pieces are rounding errors. */
const NO_TIME_S = 1e-9;

export const NEXTDRAW: ReferencePlanner = {
  name: "NextDraw software",
  cornerRule: "cosine law, at most 80 %",
  profile: "S-curves of ± J",
  plan(points, limits) {
    const { speed } = limits;
    const jerk = jerkOf(limits);
    const lengths = points.slice(1).map((p, i) => distance(points[i], p));
    const corners = cornersOf(points);
    const speeds = [0];
    for (let i = 0; i + 1 < lengths.length; i++) {
      const v = reachable(speeds[i], lengths[i], speed, jerk);
      speeds.push(Math.min(VERTEX_SHARE * speed, v * vertexShare(corners[i].turn, v / speed)));
    }
    speeds.push(0);
    for (let i = lengths.length - 1; i >= 0; i--) {
      if (speeds[i] > speeds[i + 1]) {
        speeds[i] = Math.min(speeds[i], reachable(speeds[i + 1], lengths[i], speed, jerk));
      }
    }
    let [timeS, pieces] = [0, 0];
    lengths.forEach((length, i) => {
      const curves = scurvesOf(length, speeds[i], speeds[i + 1], limits);
      for (const { durationS } of curves) timeS += durationS;
      pieces += curves.length;
    });
    return { timeS, speeds, pieces };
  },
  scurvesOf,
};

/** Without a jerk of its own: that with which the start from rest to the speed limit has A as its peak. */
const jerkOf = ({ speed, accel, jerk }: Limits): number => jerk ?? accel ** 2 / speed;

function vertexShare(turn: number, shareOfLimit: number): number {
  const cosine = Math.max(0, Math.cos(turn));
  if (shareOfLimit > 0.5) return cosine ** 4;
  return shareOfLimit > 0.25 ? cosine : 1;
}

/** Duration of a change of speed. Its mean speed is the mean of both. */
const rampS = (v0: number, v1: number, jerk: number): number =>
  Math.max(MIN_RAMP_S, 2 * Math.sqrt(Math.abs(v1 - v0) / jerk));
const rampMm = (v0: number, v1: number, jerk: number): number => ((v0 + v1) / 2) * rampS(v0, v1, jerk);

/** The highest speed at the other end of a segment. If the segment takes under 7 ms at v, it is lower than v. */
function reachable(v: number, length: number, limit: number, jerk: number): number {
  const fits = (other: number): boolean =>
    (other > v ? rampMm(v, other, jerk) : ((v + other) / 2) * MIN_RAMP_S) <= length;
  return highest(0, limit, fits);
}

/** Speeding up, going on and slowing down in one segment. */
function scurvesOf(length: number, v0: number, v1: number, limits: Limits): SCurve[] {
  const jerk = jerkOf(limits);
  if (v0 !== v1 && rampMm(v0, v1, jerk) > length) return [{ durationS: (2 * length) / (v0 + v1), v0, v1 }];
  const ramp = (from: number, to: number): SCurve => ({
    durationS: from === to ? 0 : rampS(from, to, jerk),
    v0: from,
    v1: to,
  });
  const rampsTo = (peak: number): SCurve[] => [ramp(v0, peak), ramp(peak, v1)];
  const mmOf = (curves: readonly SCurve[]): number =>
    curves.reduce((sum, curve) => sum + (curve.durationS * (curve.v0 + curve.v1)) / 2, 0);
  const peak = highest(Math.max(v0, v1), limits.speed, (v) => mmOf(rampsTo(v)) <= length);
  const [up, down] = rampsTo(peak);
  const evenly = { durationS: Math.max(0, length - mmOf([up, down])) / peak, v0: peak, v1: peak };
  return [up, evenly, down].filter(({ durationS }) => durationS > NO_TIME_S);
}

/** The highest value up to which a condition holds; `from` if it never does. */
function highest(from: number, to: number, holds: (value: number) => boolean): number {
  if (holds(to)) return to;
  let [low, high] = [from, to];
  for (let i = 0; i < HALVINGS; i++) {
    const middle = (low + high) / 2;
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return low;
}
