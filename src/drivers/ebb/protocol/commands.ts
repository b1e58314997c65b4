/** Command lines of the EiBotBoard: those at the start and end of a plot, and pen moves. */
import type { MachineProfile } from "../../../machines/profile.js";
import type { PenSettings } from "../../../settings/pen.js";
import { checkEbbProfile, ebbOf, STANDARD_PIN } from "./ebb-controller.js";
import { firmwareFeatures } from "./firmware.js";
import { servoPosFromPct } from "./servo-height.js";

/** The servo moves during this part of its wait; the rest is time to settle. */
const SERVO_PART_OF_WAIT = 0.65;
/** A drop during travel takes its full time: a quicker one would touch the paper before the carriage arrives. */
const WHOLE_WAIT = 1;
const SERVO_FRAME_MS = 24;

/**
 * The commands to send before the first plot after connecting: motors on, which sets the step counters to zero, and the
 * pen's heights and speeds.
 */
export function setUpCommands(machine: MachineProfile, pen: PenSettings, firmware: string): string[] {
  checkEbbProfile(machine);
  const features = firmwareFeatures(firmware);
  const { microstepMode } = ebbOf(machine);
  const lines = [`EM,${microstepMode},${microstepMode}`];
  // On older boards EM does not clear the accumulators: CS sets them to a known value.
  if (!features.enableClearsAccumulators && features.hasStepQuery) lines.push("CS");
  return [...lines, ...penSetUpCommands(machine, pen)];
}

/** After the last plot: motors off, so that the carriage can be moved by hand. */
export const closingCommands = (): string[] => ["EM,0,0"];

/** Sets the pen's heights and speeds for all later SP. Empty if S2 moves the pen. */
export function penSetUpCommands(machine: MachineProfile, pen: PenSettings): string[] {
  const lift = penMoveOf(pen, true);
  const drop = penMoveOf(pen, false);
  const [upLine, upRateLine] = penMoveSetUp(machine, lift);
  const [downLine, downRateLine] = penMoveSetUp(machine, drop);
  return [upLine, downLine, upRateLine, downRateLine].filter((line) => line !== undefined);
}

/** One move of the pen from one height to another. */
export interface ServoMove {
  readonly up: boolean;
  /** Target height and distance, percent of the servo's range. */
  readonly heightPct: number;
  readonly distancePct: number;
  /** Total time from the command until the pen has settled. */
  readonly timeMs: number;
  /** Requested speed; null or left out: fast enough to arrive within `timeMs`. */
  readonly ratePctPerS?: number | null | undefined;
  /** It comes down while the carriage moves. */
  readonly inFlight?: boolean | undefined;
}

/** The full move between the up and down heights of the settings. */
export function penMoveOf(pen: PenSettings, up: boolean): ServoMove {
  const distancePct = Math.abs(pen.upPct - pen.downPct);
  const heightPct = up ? pen.upPct : pen.downPct;
  const delayMs = up ? pen.liftMs : pen.dropMs;
  const ratePctPerS = up ? pen.liftPctPerS : pen.dropPctPerS;
  const timeMs = ratePctPerS ? delayMs + (1_000 * distancePct) / ratePctPerS : delayMs;
  return { up, heightPct, distancePct, timeMs, ratePctPerS };
}

/** Height and speed of SP in one direction. Empty if S2 moves the pen. */
export function penMoveSetUp(machine: MachineProfile, move: ServoMove): string[] {
  if (ebbOf(machine).servoPin !== STANDARD_PIN) return [];
  const [heightNumber, rateNumber] = move.up ? [4, 11] : [5, 12];
  return [
    `SC,${heightNumber},${servoPosFromPct(machine, move.heightPct)}`,
    `SC,${rateNumber},${servoRate(machine, move)}`,
  ];
}

/** One pen move, which holds the queue for `waitMs`. SP uses the heights and speeds that were set up before. */
export function penCommand(machine: MachineProfile, move: ServoMove, waitMs: number = move.timeMs): string {
  const delayMs = Math.max(0, Math.min(MAX_DELAY_MS, Math.round(waitMs)));
  if (ebbOf(machine).servoPin === STANDARD_PIN) return `SP,${move.up ? 1 : 0},${delayMs}`;
  const position = servoPosFromPct(machine, move.heightPct);
  return `S2,${position},${ebbOf(machine).servoPin},${servoRate(machine, move)},${delayMs}`;
}

/** Max delay of SP and S2. */
export const MAX_DELAY_MS = 65_535;

/** Change of servo position per 24 ms frame: the requested rate, or one that arrives within the wait. */
function servoRate(
  machine: MachineProfile,
  { distancePct, timeMs, ratePctPerS, inFlight }: ServoMove,
): number {
  const { servoPosAt0Pct, servoPosAt100Pct } = ebbOf(machine);
  const unitsPerPct = Math.abs(servoPosAt100Pct - servoPosAt0Pct) / 100;
  const partOfWait = inFlight ? WHOLE_WAIT : SERVO_PART_OF_WAIT;
  const frames = ratePctPerS
    ? ((distancePct / ratePctPerS) * 1_000) / SERVO_FRAME_MS
    : Math.max(1, Math.floor((timeMs * partOfWait) / SERVO_FRAME_MS));
  const rate = ratePctPerS && distancePct === 0 ? 1 : (distancePct * unitsPerPct) / frames;
  return Math.max(1, Math.min(MAX_DELAY_MS, Math.ceil(rate - 1e-9)));
}
