/**
 * Speed profiles of a straight piece in which no phase is shorter than the floor F: a board that gets a command for
 * 3 ms of cruise starves. A little acceleration is given up for that, never more of it used.
 *
 *   v ^    __            v ^                v ^   ____
 *     |   /  \             |  .----.          |  /    `-.      and others: the fastest one that keeps F
 *     |  /    \   F too    | /      \         | /        `-.
 *     +----------> short   +----F----->       +--------------> t
 *
 * A profile: up from v0 to `peak` over `rise` mm, steady, down to v1 over `fall` mm; 0 for a phase that is not there.
 */
export interface Phases {
  peak: number;
  rise: number;
  fall: number;
}

/** Seconds that a profile takes over `length`. */
function timeOf(length: number, v0: number, v1: number, { peak, rise, fall }: Phases): number {
  const up = rise > 0 ? (2 * rise) / (v0 + peak) : 0;
  const down = fall > 0 ? (2 * fall) / (peak + v1) : 0;
  const steady = length - rise - fall;
  return up + down + (steady > 0 ? steady / peak : 0);
}

/** A profile may take longer than the fastest one by this share of the floor. */
export const LOSS = 0.1;

/** Rounding that a phase's time may differ by, s; and a share of the length that no steady phase is made of. */
const SAME_S = 1e-9;
const NO_PHASE = 1e-9;

/** Whether every phase of a profile lasts for the floor, or is not there. */
function keepsFloor(length: number, v0: number, v1: number, phases: Phases, floorS: number): boolean {
  const { peak, rise, fall } = phases;
  const steady = length - rise - fall;
  const least = floorS - SAME_S;
  return (
    (rise === 0 || 2 * rise >= least * (v0 + peak)) &&
    (fall === 0 || 2 * fall >= least * (peak + v1)) &&
    (Math.abs(steady) <= NO_PHASE * length || steady >= least * peak)
  );
}

/** Profiles to choose from: peak, rise, fall, peak … */
const candidates = new Float64Array(3 * 10);
let candidateCount = 0;

function add(peak: number, rise: number, fall: number): void {
  candidates[candidateCount++] = peak;
  candidates[candidateCount++] = rise;
  candidates[candidateCount++] = fall;
}

/**
 * Puts the fastest profile that keeps the floor in place of `phases`, the fastest of all, if that has a phase
 * too short and there is one.
 */
export function keepFloor(
  length: number,
  v0: number,
  v1: number,
  accel: number,
  floorS: number,
  phases: Phases,
): void {
  if (keepsFloor(length, v0, v1, phases, floorS)) return;
  const top = phases.peak;
  let fastest = timeOf(length, v0, v1, phases) + LOSS * floorS;
  // From rest to rest there are two phases at least.
  if (v0 === 0 && v1 === 0 && fastest <= 2 * floorS) return;
  addCandidates(length, v0, v1, accel, floorS, phases);
  const next = { peak: 0, rise: 0, fall: 0 };
  for (let k = 0; k < candidateCount; k += 3) {
    next.peak = candidates[k]!;
    next.rise = candidates[k + 1]!;
    next.fall = candidates[k + 2]!;
    const { peak, rise, fall } = next;
    if (!(peak > 0 && peak <= top && rise >= 0 && fall >= 0 && rise + fall <= length * (1 + NO_PHASE)))
      continue;
    const time = timeOf(length, v0, v1, next);
    if (!(time < fastest) || !keepsFloor(length, v0, v1, next, floorS)) continue;
    fastest = time;
    phases.peak = peak;
    phases.rise = rise;
    phases.fall = fall;
  }
}

function addCandidates(
  length: number,
  v0: number,
  v1: number,
  accel: number,
  floorS: number,
  { peak: top, rise: up, fall: down }: Phases,
): void {
  candidateCount = 0;
  const high = Math.max(v0, v1);
  // Ramps made longer where they are too short, at the same peak.
  const rampTo = (peak: number, v: number): number =>
    peak > v ? ((peak + v) / 2) * Math.max((peak - v) / accel, floorS) : 0;
  add(top, up > 0 ? rampTo(top, v0) : 0, down > 0 ? rampTo(top, v1) : 0);
  // A lower peak, with a steady phase as long as the floor; or two phases of that length.
  const lower =
    (accel / 2) *
    (Math.sqrt(floorS ** 2 + (4 / accel) * (length + (v0 * v0 + v1 * v1) / (2 * accel))) - floorS);
  if (lower > high) add(lower, rampTo(lower, v0), rampTo(lower, v1));
  const even = length / floorS - (v0 + v1) / 2;
  if (even > high && even - Math.min(v0, v1) <= accel * floorS) {
    const rise = ((v0 + even) / 2) * floorS;
    add(even, rise, length - rise);
  }
  // Two phases, one as long as the floor and the other at full acceleration.
  const early = 2 * accel * length - accel * floorS * v0 + v1 * v1;
  const first = (Math.sqrt((accel * floorS) ** 2 + 4 * early) - accel * floorS) / 2;
  if (first > high) add(first, ((v0 + first) / 2) * floorS, length - ((v0 + first) / 2) * floorS);
  const late = 2 * accel * length - accel * floorS * v1 + v0 * v0;
  const last = (Math.sqrt((accel * floorS) ** 2 + 4 * late) - accel * floorS) / 2;
  if (last > high) add(last, length - ((v1 + last) / 2) * floorS, ((v1 + last) / 2) * floorS);
  // No steady phase: one of the ramps, or both, take its way.
  if (top > high && up > 0 && down > 0) {
    const share = (top * top - v0 * v0) / (2 * top * top - v0 * v0 - v1 * v1);
    add(top, share * length, length - share * length);
    add(top, length - down, down);
    add(top, up, length - up);
  }
  // One phase for all.
  if (v1 >= v0 && v1 > 0) add(v1, length, 0);
  else if (v0 > 0) add(v0, 0, length);
}
