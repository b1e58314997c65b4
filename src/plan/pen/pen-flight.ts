/**
 * Pen moves during travel: the carriage does not wait while the tip is clear of the paper.
 *
 *   height ^  full           /‾‾‾‾‾‾‾\               only for long travels
 *          |  hop       ____/_________\____          contact height and a margin: what a short travel needs
 *          |  contact  /                   \         below this the tip may touch the paper
 *          |  down  __/                     \____
 *          +---------|---------------------|----> time
 *             carriage starts        carriage arrives
 *
 * A real servo takes up to `1 / SLOW` of its time (src/machines/pen-servo.ts), and at least `1 / FAST` of what its signal
 * takes. It reads its pulse once per frame, so it starts up to one frame after the command. The tip leaves the paper up to
 * `CONTACT_PCT` beside the contact height. The carriage may be within `NEAR_MM` of the stroke while the tip touches.
 * With that it waits long enough for any such servo:
 *
 *   - It starts when the slowest one has lifted the tip clear of the paper, or moves it only `NEAR_MM` until then.
 *   - With "fast" the drop begins so late that the fastest one touches the paper only within `NEAR_MM` of the stroke, and
 *     the stroke begins when the slowest one touches it.
 *   - With "safe" the drop begins only within `NEAR_MM`, and the stroke not before the servo's usual time for the whole
 *     drop: this also suits a contact height that was never measured.
 *
 * A shaped travel is a weighted mean of copies of the planned one. The last copy ends with the shaped travel, the others
 * earlier. So the shaped travel is never farther from the stroke than the planned one at the same time before its end,
 * and the same rules are safe for both.
 *
 * So with "fast" the drop begins up to `lowerAheadMm` before the stroke. A machine that loses its connection may then lack
 * the end of the travel, and would put the pen down there. For such a machine (`dropsAtStroke`) "fast" begins the drop only
 * within `NEAR_MM`, too.
 */
import type { PenSettings } from "../../settings/pen.js";
import {
  dropMoveTime,
  dropTime,
  liftMoveTime,
  liftTime,
  penOfLayer,
  shareOfTime,
  waitOf,
  type TimedPen,
} from "./pen-times.js";

/** The speeds of the slowest and the fastest servo, as shares of the expected one. */
const SLOW = 0.8;
const FAST = 1.2;
/** How far the tip may touch above or below the contact height, percent of the distance from down to up. */
const CONTACT_PCT = 5;
/** Hop height above the contact height, percent of the distance from down to up. */
const MARGIN_PCT = 15;
/** A tip that touches the paper this close to a stroke leaves no visible mark. */
const NEAR_MM = 0.1;

/** The timing of a lift. */
export interface Lift {
  readonly heightPct: number;
  /** How long the carriage waits for it. */
  readonly waitS: number;
  /** How long the pen takes until it is certainly clear of the paper. */
  readonly moveS: number;
}

/** The travel between a lift and a drop. Times in s. */
export interface Approach {
  readonly startS: number;
  readonly endS: number;
  /** The travel's acceleration limit, mm/s². */
  readonly accel: number;
  /** The drop begins only within `NEAR_MM` of the stroke. */
  readonly dropsAtStroke: boolean;
}

export interface Lowering {
  /** When the pen is lowered to the hop height; null if it is not above it. */
  readonly hoverS: number | null;
  readonly dropS: number;
  /** When it is down. */
  readonly downS: number;
}

/** A pen with a lift rate is lifted slowly on purpose, so the carriage waits for it. */
const liftsInFlight = (pen: PenSettings): boolean => pen.overlap !== "off" && !pen.liftPctPerS;
export const dropsInFlight = (pen: PenSettings): boolean => pen.overlap !== "off" && !pen.dropPctPerS;

/** The lift before a travel of `travelMm` with that acceleration limit, mm/s². */
export function liftBefore(pen: TimedPen, travelMm: number, accel: number): Lift {
  if (!liftsInFlight(pen)) return liftTo(pen, pen.upPct, liftTime(pen, pen.upPct));
  const heightPct = travelMm < pen.fullHeightMm ? hopHeight(pen) : pen.upPct;
  return liftTo(pen, heightPct, waitOf(clearTime(pen, heightPct) - nearTime(accel), pen.extraLiftMs));
}

/** The time of a lift to the hop height. */
export const hopLift = (pen: TimedPen): Lift => liftTo(pen, hopHeight(pen), 0);

const liftTo = (pen: TimedPen, heightPct: number, waitS: number): Lift => ({
  heightPct,
  waitS,
  moveS: Math.max(liftMoveTime(pen, heightPct - pen.downPct), clearTime(pen, heightPct)),
});

/** How long the carriage waits at the stroke for a whole drop from `fromPct`. */
export function dropWait(pen: TimedPen, fromPct: number): number {
  const wholeS = dropTime(pen, fromPct);
  if (pen.overlap === "off") return wholeS;
  return Math.max(wholeS, waitOf(touchTime(pen, fromPct), pen.extraDropMs));
}

/** How the pen comes down during a travel, after a lift to `heightPct` that began at `liftS`. */
export function lowerDuring(
  pen: TimedPen,
  { heightPct, liftS }: { readonly heightPct: number; readonly liftS: number },
  { startS, endS, accel, dropsAtStroke }: Approach,
): Lowering {
  const nearS = endS - nearTime(accel);
  const isFast = pen.overlap === "fast";
  const hopPct = hopHeight(pen);
  let fromPct = Math.min(heightPct, hopPct);
  const aheadS =
    isFast && !dropsAtStroke ? nearS - fastestDrop(pen, { heightPct, liftS, fromPct, nearS }) : 0;
  const dropS = Math.max(startS, nearS - aheadS);
  let hoverS: number | null = null;
  if (heightPct > hopPct) {
    // A fall, but at the rate of a lift, because the board takes it for one.
    const fallPct = heightPct - hopPct;
    const fallS = Math.max(liftMoveTime(pen, fallPct), dropMoveTime(pen, fallPct));
    const hoverTimeS = frameS(pen) + fallS / SLOW;
    // A servo that is still below the hop height would take a new move from there, and clear the paper later.
    const earliestS = Math.max(startS, liftS + riseTime(pen, heightPct, hopPct));
    // If there is no time to lower it to the hop height first, it drops from where it is.
    if (dropS - hoverTimeS > earliestS) hoverS = dropS - hoverTimeS;
    else fromPct = heightPct;
  }
  const touchS = touchTime(pen, fromPct);
  const dropTimeS = isFast ? touchS : Math.max(touchS, dropMoveTime(pen, fromPct - pen.downPct));
  return { hoverS, dropS, downS: endS + waitOf(dropS + dropTimeS - endS, pen.extraDropMs) };
}

/**
 * The earliest time for a drop from `fromPct` after which no servo touches the paper before `nearS`. The fastest one drops
 * from the top. The slowest one may still be rising, at a share of the speed at which it then drops:
 * SLOW · up · (t − liftS − frame) − clear = SLOW · down · (near − t).
 */
function fastestDrop(
  pen: TimedPen,
  { heightPct, liftS, fromPct, nearS }: { heightPct: number; liftS: number; fromPct: number; nearS: number },
): number {
  const { downPct } = pen;
  const risePct = heightPct - downPct;
  const up = risePct / liftMoveTime(pen, risePct);
  const down = dropSpeed(pen);
  const clearPct = clearHeight(pen);
  const fromTopS = nearS - Math.max(0, fromPct - clearPct) / (FAST * down);
  const risingFromS = liftS + frameS(pen);
  const whileRisingS = (down * nearS + up * risingFromS + (clearPct - downPct) / SLOW) / (up + down);
  return Math.min(nearS, Math.max(fromTopS, whileRisingS));
}

/**
 * Max distance of the carriage from the stroke when the drop begins, mm; 0 if the carriage waits for the whole drop. With
 * `dropsAtStroke` it is less.
 */
export function lowerAheadMm(pen: TimedPen, accel: number): number {
  const layers = Object.keys(pen.layers ?? {}).map((id) => penOfLayer(pen, id));
  return Math.max(...[pen, ...layers].map((one) => (dropsInFlight(one) ? landingOf(one, accel) : 0)));
}

function landingOf(pen: TimedPen, accel: number): number {
  const aboveClearS =
    pen.overlap === "fast" ? (hopHeight(pen) - clearHeight(pen)) / (FAST * dropSpeed(pen)) : 0;
  const beforeEndS = nearTime(accel) + aboveClearS;
  return (accel * beforeEndS * beforeEndS) / 2;
}

/** The highest speed of a drop, percent per second: that of the signal or of the servo itself. */
function dropSpeed(pen: TimedPen): number {
  const { dropPctPerS, slopeMsPerPct } = pen.servo;
  const share = shareOfTime(pen, pen.extraDropMs, dropPctPerS);
  return Math.min(dropPctPerS, 1_000 / slopeMsPerPct / share);
}

/** Time to move the first or the last `NEAR_MM` of a travel, s. */
const nearTime = (accel: number): number => Math.sqrt((2 * NEAR_MM) / accel);

const frameS = ({ servo }: TimedPen): number => servo.frameMs / 1_000;

/** When the slowest servo has lifted the tip clear of the paper, s after the command of a lift to `heightPct`. */
const clearTime = (pen: TimedPen, heightPct: number): number => riseTime(pen, heightPct, clearHeight(pen));

/** When the slowest servo passes `passPct`, s after the command of a lift to `heightPct`. */
function riseTime(pen: TimedPen, heightPct: number, passPct: number): number {
  const risePct = heightPct - pen.downPct;
  const share = Math.min(1, (passPct - pen.downPct) / risePct);
  return frameS(pen) + (share * liftMoveTime(pen, risePct)) / SLOW;
}

/** When the slowest servo has put the tip on the paper, s after the command of a drop from `fromPct`. */
function touchTime(pen: TimedPen, fromPct: number): number {
  const fallPct = fromPct - pen.downPct;
  const touchPct = heightAt(pen, pen.contactPct - CONTACT_PCT);
  // The layer before may have a lower pen, which then does not fall.
  const share = fromPct > touchPct ? (fromPct - touchPct) / fallPct : 0;
  return frameS(pen) + (share * dropMoveTime(pen, fallPct)) / SLOW;
}

/** The height of short travels, percent of the servo's range. */
const hopHeight = (pen: PenSettings): number => heightAt(pen, pen.contactPct + MARGIN_PCT);

/** At this height the tip is clear of the paper, also if it leaves the paper late. */
const clearHeight = (pen: PenSettings): number => heightAt(pen, pen.contactPct + CONTACT_PCT);

const heightAt = ({ upPct, downPct }: PenSettings, sharePct: number): number =>
  downPct + ((upPct - downPct) * Math.min(100, Math.max(0, sharePct))) / 100;
