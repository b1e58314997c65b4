/**
 * A pen in flight: the part of its way for which the carriage need not wait, because the tip is clear of the paper.
 *
 *   height ^  full           /‾‾‾‾‾‾‾\               only for long travels
 *          |  hop       ____/_________\____          contact height and a margin: what a short travel needs
 *          |  contact  /                   \         below it the tip may touch the paper
 *          |  down  __/                     \____
 *          +---------|---------------------|----> time
 *             carriage starts        carriage arrives
 *
 * The servo needs the lift and drop times for the whole way between the down and up heights, and moves evenly. It moves
 * in frames: it starts up to one frame after the command. The carriage counts as arrived within `NEAR_MM` of the stroke.
 *
 * A shaped travel is a weighted mean of copies of the planned one, the last of which ends with it. So it is never farther
 * from the stroke than the planned one is at the same time before its end, and needs no rule of its own.
 *
 * "safe" trusts the tip to be clear at the hop height only; "fast" at the contact height itself.
 */
import type { PenSettings } from "../settings/pen.js";
import { liftTiming, penOfLayer } from "./pen-times.js";

/** A frame of the servo's pulses. */
const FRAME_S = 0.024;
/** What the hop height is above the contact height, percent of the way from down to up. */
const MARGIN_PCT = 15;
/** A tip that touches this near to a stroke's start leaves no mark to be seen. */
const NEAR_MM = 0.1;

/** A lift that has begun. */
export interface Lift {
  readonly heightPct: number;
  /** How long the carriage waits for it. */
  readonly waitS: number;
  /** How long the pen takes. */
  readonly moveS: number;
}

/** The travel between a lift and a drop, s. */
export interface Approach {
  readonly startS: number;
  readonly endS: number;
  /** The travel's acceleration limit, mm/s². */
  readonly accel: number;
}

export interface Lowering {
  /** When the pen goes down to the hop height; null if it is not above. */
  readonly hoverS: number | null;
  readonly dropS: number;
  /** When it is down. */
  readonly downS: number;
}

/** A pen with its own lift rate lifts as gently as that says, and the carriage waits for it. */
export const liftsInFlight = (pen: PenSettings): boolean => pen.overlap !== "off" && !pen.liftPctPerS;
export const dropsInFlight = (pen: PenSettings): boolean => pen.overlap !== "off" && !pen.dropPctPerS;

/** The lift before a travel of `travelMm`. */
export function liftBefore(pen: PenSettings, travelMm: number): Lift {
  const isHop = liftsInFlight(pen) && travelMm < pen.fullHeightMm;
  const heightPct = isHop ? hopHeight(pen) : pen.upPct;
  const { waitS: moveS } = liftTiming(pen, heightPct);
  if (!liftsInFlight(pen)) return { heightPct, waitS: moveS, moveS };
  const clearS = FRAME_S + (clearHeight(pen) - pen.downPct) / liftRate(pen);
  return { heightPct, waitS: wholeMs(Math.min(clearS, pen.liftMs / 1_000)), moveS };
}

/** The time of a lift to the hop height. */
export function hopLift(pen: PenSettings): Lift {
  const heightPct = hopHeight(pen);
  return { heightPct, waitS: 0, moveS: liftTiming(pen, heightPct).waitS };
}

/** How the pen comes down during a travel, after it was lifted to `heightPct` from `liftS` on. */
export function lowerDuring(
  pen: PenSettings,
  { heightPct, liftS }: { readonly heightPct: number; readonly liftS: number },
  { startS, endS, accel }: Approach,
): Lowering {
  const nearS = endS - nearTime(accel);
  const up = liftRate(pen);
  const down = dropRate(pen);
  const clearPct = clearHeight(pen);
  const hopPct = hopHeight(pen);
  const topPct = Math.min(heightPct, hopPct);
  const firstFrameS = liftS + FRAME_S;
  let fromPct = topPct;
  let dropS = nearS - Math.max(0, topPct - clearPct) / down;
  if (dropS < firstFrameS + (topPct - pen.downPct) / up) {
    // It turns back on its way up: t + (down + up rate (t − first frame) − clear) / down rate = near.
    dropS = (down * nearS + clearPct - pen.downPct + up * firstFrameS) / (down + up);
    fromPct = Math.max(clearPct, pen.downPct + up * (dropS - firstFrameS));
  }
  dropS = Math.max(startS, dropS);
  let hoverS: number | null = null;
  if (heightPct > hopPct) {
    const hoverTimeS = FRAME_S + liftTiming(pen, heightPct).waitS - liftTiming(pen, hopPct).waitS;
    if (dropS - hoverTimeS > startS) hoverS = dropS - hoverTimeS;
    else fromPct = heightPct;
  }
  const waitS = wholeMs(dropS + (fromPct - pen.downPct) / down - endS);
  return { hoverS, dropS, downS: endS + waitS };
}

/** The carriage is at most this far from the stroke when the drop is given, mm; 0 if it waits for the whole drop. */
export function landingMm(pen: PenSettings, accel: number): number {
  const layers = Object.keys(pen.layers ?? {}).map((id) => penOfLayer(pen, id));
  return Math.max(...[pen, ...layers].map((one) => (dropsInFlight(one) ? landingOf(one, accel) : 0)));
}

function landingOf(pen: PenSettings, accel: number): number {
  const aboveClearS = (hopHeight(pen) - clearHeight(pen)) / dropRate(pen);
  const beforeEndS = nearTime(accel) + aboveClearS;
  return (accel * beforeEndS * beforeEndS) / 2;
}

/** A board waits for whole milliseconds. So must the plan: half a millisecond for each stroke adds up to seconds. */
const wholeMs = (s: number): number => Math.max(0, Math.ceil(1_000 * s - 1e-6)) / 1_000;

/** Braking from `NEAR_MM` to rest takes this long, s. */
const nearTime = (accel: number): number => Math.sqrt((2 * NEAR_MM) / accel);

/** At this height the tip is clear of the paper, whatever the servo: percent of its range. */
const hopHeight = (pen: PenSettings): number => atShare(pen, pen.contactPct + MARGIN_PCT);

/** From this height on the planner takes the tip to be clear. */
const clearHeight = (pen: PenSettings): number =>
  pen.overlap === "safe" ? hopHeight(pen) : atShare(pen, pen.contactPct);

const atShare = ({ upPct, downPct }: PenSettings, sharePct: number): number =>
  downPct + ((upPct - downPct) * Math.min(100, sharePct)) / 100;

/** Percent of the servo's range per second. */
const dropRate = (pen: PenSettings): number => ((pen.upPct - pen.downPct) * 1_000) / Math.max(1, pen.dropMs);
const liftRate = (pen: PenSettings): number => ((pen.upPct - pen.downPct) * 1_000) / Math.max(1, pen.liftMs);
