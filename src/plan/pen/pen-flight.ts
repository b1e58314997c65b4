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
 * The lift and drop times are for the full distance between the down and up heights; the servo's speed is constant. The
 * servo reads its pulse once per frame, so it starts up to one frame after the command. The carriage counts as arrived
 * within `NEAR_MM` of the stroke.
 *
 * A shaped travel is a weighted mean of copies of the planned one. The last copy ends with the shaped travel, the others
 * earlier. So the shaped travel is never farther from the stroke than the planned one at the same time before its end,
 * and the same rules are safe for both.
 *
 * With "safe" the tip counts as clear at the hop height, with "fast" already at the contact height.
 *
 * So with "fast" the drop begins up to `lowerAheadMm` before the stroke. A machine that loses its connection may then lack
 * the end of the travel, and would put the pen down there. For such a machine (`dropsAtStroke`) "fast" lifts the pen as
 * above, but begins the drop only within `NEAR_MM`.
 */
import type { PenSettings } from "../../settings/pen.js";
import { liftTime, penOfLayer } from "./pen-times.js";

/** Interval of the servo's pulses. */
const FRAME_S = 0.024;
/** Hop height above the contact height, percent of the distance from down to up. */
const MARGIN_PCT = 15;
/** A tip that touches the paper this close to a stroke's start leaves no visible mark. */
const NEAR_MM = 0.1;

/** The timing of a lift. */
export interface Lift {
  readonly heightPct: number;
  /** How long the carriage waits for it. */
  readonly waitS: number;
  /** How long the pen takes. */
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

/** The lift before a travel of `travelMm`. */
export function liftBefore(pen: PenSettings, travelMm: number): Lift {
  if (!liftsInFlight(pen)) {
    const waitS = liftTime(pen, pen.upPct);
    return { heightPct: pen.upPct, waitS, moveS: waitS };
  }
  const heightPct = travelMm < pen.fullHeightMm ? hopHeight(pen) : pen.upPct;
  const clearS = FRAME_S + (clearHeight(pen) - pen.downPct) / liftRate(pen);
  const waitS = wholeMs(Math.min(clearS, pen.liftMs / 1_000));
  return { heightPct, waitS, moveS: liftTime(pen, heightPct) };
}

/** The time of a lift to the hop height. */
export function hopLift(pen: PenSettings): Lift {
  const heightPct = hopHeight(pen);
  return { heightPct, waitS: 0, moveS: liftTime(pen, heightPct) };
}

/** How the pen comes down during a travel, after a lift to `heightPct` that began at `liftS`. */
export function lowerDuring(
  pen: PenSettings,
  { heightPct, liftS }: { readonly heightPct: number; readonly liftS: number },
  { startS, endS, accel, dropsAtStroke }: Approach,
): Lowering {
  const nearS = endS - nearTime(accel);
  const up = liftRate(pen);
  const down = dropRate(pen);
  const hopPct = hopHeight(pen);
  const clearPct = dropsAtStroke ? hopPct : clearHeight(pen);
  const topPct = Math.min(heightPct, hopPct);
  const firstFrameS = liftS + FRAME_S;
  // The height at which the drop begins.
  let fromPct = topPct;
  let dropS = nearS - Math.max(0, topPct - clearPct) / down;
  if (clearPct < hopPct && dropS < firstFrameS + (topPct - pen.downPct) / up) {
    // The pen turns back before it reaches the top: t + (down + up rate (t − first frame) − clear) / down rate = near.
    dropS = (down * nearS + clearPct - pen.downPct + up * firstFrameS) / (down + up);
    fromPct = Math.max(clearPct, pen.downPct + up * (dropS - firstFrameS));
  }
  dropS = Math.max(startS, dropS);
  let hoverS: number | null = null;
  if (heightPct > hopPct) {
    const hoverTimeS = FRAME_S + liftTime(pen, heightPct) - liftTime(pen, hopPct);
    // If there is no time to lower it to the hop height first, it drops from where it is.
    if (dropS - hoverTimeS > startS) hoverS = dropS - hoverTimeS;
    else fromPct = heightPct;
  }
  const waitS = wholeMs(dropS + (fromPct - pen.downPct) / down - endS);
  return { hoverS, dropS, downS: endS + waitS };
}

/**
 * Max distance of the carriage from the stroke when the drop begins, mm; 0 if the carriage waits for the whole drop. With
 * `dropsAtStroke` it is less.
 */
export function lowerAheadMm(pen: PenSettings, accel: number): number {
  const layers = Object.keys(pen.layers ?? {}).map((id) => penOfLayer(pen, id));
  return Math.max(...[pen, ...layers].map((one) => (dropsInFlight(one) ? landingOf(one, accel) : 0)));
}

function landingOf(pen: PenSettings, accel: number): number {
  const aboveClearS = (hopHeight(pen) - clearHeight(pen)) / dropRate(pen);
  const beforeEndS = nearTime(accel) + aboveClearS;
  return (accel * beforeEndS * beforeEndS) / 2;
}

/**
 * A board waits for whole milliseconds, so the plan does too. Otherwise a difference of half a millisecond per stroke
 * would add up to seconds.
 */
const wholeMs = (s: number): number => Math.max(0, Math.ceil(1_000 * s - 1e-6)) / 1_000;

/** Time to brake over the last `NEAR_MM`, s. */
const nearTime = (accel: number): number => Math.sqrt((2 * NEAR_MM) / accel);

/** At this height the tip is clear of the paper, with a margin for the servo's errors; percent of the servo's range. */
const hopHeight = (pen: PenSettings): number => atShare(pen, pen.contactPct + MARGIN_PCT);

/** From this height on the planner treats the tip as clear of the paper. */
const clearHeight = (pen: PenSettings): number =>
  pen.overlap === "safe" ? hopHeight(pen) : atShare(pen, pen.contactPct);

const atShare = ({ upPct, downPct }: PenSettings, sharePct: number): number =>
  downPct + ((upPct - downPct) * Math.min(100, sharePct)) / 100;

/** Percent of the servo's range per second. */
const dropRate = (pen: PenSettings): number => ((pen.upPct - pen.downPct) * 1_000) / Math.max(1, pen.dropMs);
const liftRate = (pen: PenSettings): number => ((pen.upPct - pen.downPct) * 1_000) / Math.max(1, pen.liftMs);
