/**
 * Speed ramps under bounded acceleration and jerk, at rest in acceleration at both ends.
 *
 *   a ^    ____            T(Δ) = 2 √(Δ/J)        Δ ≤ A²/J   two blocks, the peak √(Δ J) below A
 *     |   /    \                = Δ/A + A/J       else       three blocks
 *     |  /      \          D = (v0 + v1)/2 · T    since the ramp is symmetric in time
 *     +-/--------\-> t
 *
 *   v0, v1  mm/s      Δ = |v1 − v0|      A, J  mm/s², mm/s³      D  length, mm
 */

/** Seconds from one speed to another. */
export function rampTime(change: number, accel: number, jerk: number): number {
  const delta = Math.abs(change);
  return delta * jerk <= accel * accel ? 2 * Math.sqrt(delta / jerk) : delta / accel + accel / jerk;
}

export function rampLength(v0: number, v1: number, accel: number, jerk: number): number {
  return ((v0 + v1) / 2) * rampTime(v1 - v0, accel, jerk);
}

/** The greatest speed reached from `v0` within `length`. */
export function rampReach(v0: number, length: number, accel: number, jerk: number): number {
  if (!(length > 0)) return v0;
  // Trapezoid: Δ² + Δ (2 v0 + A²/J) + 2 v0 A²/J − 2 A D = 0, in the form that does not cancel.
  const corner = (accel * accel) / jerk;
  const b = 2 * v0 + corner;
  const c = 2 * v0 * corner - 2 * accel * length;
  if (c < 0) {
    const delta = (-2 * c) / (b + Math.sqrt(b * b - 4 * c));
    if (delta >= corner) return v0 + delta;
  }
  // Triangle: x³ + 2 v0 x = D √J with x = √Δ. Convex, so Newton's steps fall to the root from above.
  const target = length * Math.sqrt(jerk);
  let x = Math.min(Math.cbrt(target), v0 > 0 ? target / (2 * v0) : Infinity);
  for (let i = 0; i < 40; i++) {
    const step = (x * (x * x + 2 * v0) - target) / (3 * x * x + 2 * v0);
    x -= step;
    if (!(step > 1e-13 * x)) break;
  }
  return v0 + x * x;
}

/**
 * As `rampReach`, but never falling when `v0` rises, which the two passes need. The reach itself falls a
 * little first: from a slow start the ramp is longer in time than it saves in way. Its least value, at the
 * start speed `slowest` below, stands in for all slower starts (at most 5.5 % less).
 */
export function steadyReach(v0: number, length: number, accel: number, jerk: number): number {
  const corner = (accel * accel) / jerk;
  const triangle = Math.cbrt((length * length * jerk) / 32);
  const slowest = Math.min(triangle, corner / 2);
  return rampReach(Math.max(v0, slowest), length, accel, jerk);
}

/** The greatest peak speed ≤ `most` between `v0` and `v1` for which both ramps fit into `length`. */
export function rampPeak(
  v0: number,
  v1: number,
  most: number,
  length: number,
  accel: number,
  jerk: number,
): number {
  const fits = (peak: number): boolean =>
    rampLength(v0, peak, accel, jerk) + rampLength(peak, v1, accel, jerk) <= length;
  let low = Math.max(v0, v1);
  if (most <= low || fits(most)) return Math.max(most, low);
  let high = most;
  for (let i = 0; i < 60 && high - low > 1e-12 * high; i++) {
    const middle = (low + high) / 2;
    if (fits(middle)) low = middle;
    else high = middle;
  }
  return low;
}

/** A hump of speed from v over v + `change` and back to v, with ramps under `accel`. */
export interface Hump {
  readonly change: number;
  readonly accel: number;
}

/** Seconds that may be lost to longer holds, as a share of their length. */
const LOSS = 0.1;

/**
 * The hump nearest to the fastest one, of `change` under `accel`, whose ramps hold their acceleration for `hold` seconds; or
 * that one itself where they do so for longer or not at all, or where too much time would be lost.
 * With a little less acceleration a:
 *
 *     Δ = a hold + a²/J        T = hold + 2 a/J        (2 v + Δ) T ≤ length
 */
export function heldHump(
  v: number,
  change: number,
  length: number,
  accel: number,
  jerk: number,
  hold: number,
): Hump {
  const holds = change / accel - accel / jerk;
  if (!(holds > 0 && holds < hold)) return { change, accel };
  const changeOf = (a: number): number => a * hold + (a * a) / jerk;
  let low = 0;
  let high = accel;
  for (let i = 0; i < 60; i++) {
    const a = (low + high) / 2;
    const fits = changeOf(a) <= change && (2 * v + changeOf(a)) * (hold + (2 * a) / jerk) <= length;
    if (fits) low = a;
    else high = a;
  }
  const timeOf = (delta: number, a: number): number => {
    const ramp = delta / a + a / jerk;
    return 2 * ramp + (length - (2 * v + delta) * ramp) / (v + delta);
  };
  const held = { change: changeOf(low), accel: low };
  return timeOf(held.change, low) <= timeOf(change, accel) + LOSS * hold ? held : { change, accel };
}
