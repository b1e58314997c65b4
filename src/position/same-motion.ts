/**
 * Whether a longer plan can take over from a shorter one in motion. A plan of a line that grows is the same as before, up
 * to where the shorter one begins to brake for its end.
 */
import {
  newMotionState,
  SAME_TIME_S,
  stateAt,
  type MotionState,
  type Trajectory,
} from "../plan/trajectory.js";
import { nextPosition, PositionTimes } from "./on-plan.js";

/** Less than a motor step, mm. */
const SAME_PLACE_MM = 0.01;
/** At corners of the mode `junction` the motors' speeds jump by more, mm/s. */
const SAME_VELOCITY = 1;
/** Max difference of the places along the stroke, which plans measure along their rounded line, mm. */
const SAME_ALONG_MM = 0.5;
/** Rounds in which a time that was found by the place is corrected by the distance of the pen. */
const ROUNDS = 3;

/**
 * The time of `next` at which it moves as `current` does at `tS`; null if there is none.
 *
 * If both plans begin at the same place, that is the same time. Otherwise `next` begins on an earlier stroke or on the one
 * that is being drawn at `tS`: at its start, where every plan is at rest, or at a place before the pen.
 */
export function sameMotionS(current: Trajectory, tS: number, next: Trajectory): number | null {
  const state = stateAt(current, tS);
  const other = newMotionState();
  // Before its start, and after its end, `next` rests there.
  const isSame = (otherS: number | null): otherS is number =>
    otherS !== null &&
    otherS >= -SAME_TIME_S &&
    otherS <= next.totalS + SAME_TIME_S &&
    areSame(state, stateAt(next, otherS, other));
  if (isSame(tS)) return tS;
  const stroke = state.stroke < 0 ? nextPosition(current, tS)?.stroke : state.stroke;
  if (stroke === undefined) return null;
  const [from, to] = [new PositionTimes(current), new PositionTimes(next)];
  const start = { stroke, alongMm: 0 };
  const sameRunS = tS - (from.timeOf(start) ?? NaN) + (to.timeOf(start) ?? NaN);
  const byPlaceS = state.stroke < 0 ? null : nearestS(next, state, to.timeOf(state));
  return [sameRunS, byPlaceS].find(isSame) ?? null;
}

/** When the pen is nearest to `state` in `next`, near `aboutS`. */
function nearestS(next: Trajectory, state: MotionState, aboutS: number | null): number | null {
  if (aboutS === null) return null;
  const other = newMotionState();
  let otherS = aboutS;
  for (let round = 0; round < ROUNDS; round++) {
    const { x, y, vx, vy } = stateAt(next, otherS, other);
    const speed2 = vx * vx + vy * vy;
    if (speed2 > 0) otherS += ((state.x - x) * vx + (state.y - y) * vy) / speed2;
  }
  return otherS;
}

const areSame = (a: MotionState, b: MotionState): boolean =>
  a.penUp === b.penUp &&
  a.stroke === b.stroke &&
  Math.hypot(a.x - b.x, a.y - b.y) < SAME_PLACE_MM &&
  Math.hypot(a.vx - b.vx, a.vy - b.vy) < SAME_VELOCITY &&
  (a.stroke < 0 || Math.abs(a.alongMm - b.alongMm) < SAME_ALONG_MM);
