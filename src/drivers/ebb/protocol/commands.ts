/** Command lines of the EiBotBoard: those at the start and end of a plot, and pen moves. */
import { penServoOf } from "../../../machines/pen-servo.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { PenSettings } from "../../../settings/pen.js";
import { checkEbbProfile, ebbOf, STANDARD_PIN } from "./ebb-controller.js";
import { firmwareFeatures } from "./firmware.js";
import { servoPosFromPct } from "./servo-height.js";

/** Duration of one servo channel's pulse slot, ms. A frame is one slot for each channel. */
const SLOT_MS = 3;

/** Whole slots, nearest to the frame of the machine's servo. */
const slotsPerFrame = (machine: MachineProfile): number => Math.round(penServoOf(machine).frameMs / SLOT_MS);

/**
 * The commands to send before the first plot after connecting: motors on, which sets the step counters to zero, and the
 * pen's heights, speeds and servo frame.
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

/**
 * Sets the pen's heights and speeds for all later SP, and the servo's frame, which other software may have changed. If S2
 * moves the pen, only the frame.
 */
export function penSetUpCommands(machine: MachineProfile, pen: PenSettings): string[] {
  const [upLine, upRateLine] = penMoveSetUp(machine, penMoveOf(pen, true));
  const [downLine, downRateLine] = penMoveSetUp(machine, penMoveOf(pen, false));
  const frameLines = [`SC,8,${slotsPerFrame(machine)}`, `SC,9,${SLOT_MS}`];
  return [...frameLines, upLine, downLine, upRateLine, downRateLine].filter((line) => line !== undefined);
}

/** One move of the pen. */
export interface ServoMove {
  readonly up: boolean;
  /** Target height, percent of the servo's range. */
  readonly heightPct: number;
  /** Requested speed; null or left out: the servo's. */
  readonly ratePctPerS?: number | null | undefined;
}

/** The move to the up or the down height of the settings. */
export const penMoveOf = (pen: PenSettings, up: boolean): ServoMove => ({
  up,
  heightPct: up ? pen.upPct : pen.downPct,
  ratePctPerS: up ? pen.liftPctPerS : pen.dropPctPerS,
});

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
export function penCommand(machine: MachineProfile, move: ServoMove, waitMs: number): string {
  const delayMs = Math.max(0, Math.min(MAX_DELAY_MS, Math.round(waitMs)));
  if (ebbOf(machine).servoPin === STANDARD_PIN) return `SP,${move.up ? 1 : 0},${delayMs}`;
  const position = servoPosFromPct(machine, move.heightPct);
  return `S2,${position},${ebbOf(machine).servoPin},${servoRate(machine, move)},${delayMs}`;
}

/** Max delay of SP and S2. */
export const MAX_DELAY_MS = 65_535;

/** Change of servo position per frame. */
function servoRate(machine: MachineProfile, { up, ratePctPerS }: ServoMove): number {
  const { servoPosAt0Pct, servoPosAt100Pct } = ebbOf(machine);
  const { liftPctPerS, dropPctPerS } = penServoOf(machine);
  const unitsPerPct = Math.abs(servoPosAt100Pct - servoPosAt0Pct) / 100;
  const frameS = (slotsPerFrame(machine) * SLOT_MS) / 1_000;
  const pctPerFrame = (ratePctPerS ?? (up ? liftPctPerS : dropPctPerS)) * frameS;
  return Math.max(1, Math.min(MAX_DELAY_MS, Math.ceil(pctPerFrame * unitsPerPct - 1e-9)));
}
