/**
 * Finds home with the machine's own switches. Each axis in turn moves towards 0 in short steps until its switch is
 * pressed, then back in very short steps until it is released. That position is home.
 *
 * Polling between short moves needs only the command PI, which every firmware has.
 */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type { Machine, StopSignal } from "../../driver.js";
import type { MachineSettings } from "../../machine-job.js";
import type { HomingSwitches, SwitchInput } from "../protocol/ebb-controller.js";
import type { BoardSession } from "../stream/session.js";
import type { EbbPosition } from "./position.js";

/** Shorter than the travel of a pressed switch. */
const SEEK_MM = 1;
const RELEASE_MM = 0.05;
/** A switch that is still pressed after this distance is not a limit switch. */
const MAX_RELEASE_MM = 10;
/** Max distance to a switch, as a multiple of the profile's travel. */
const SLACK = 1.1;
const SEEK_SPEED_MM_PER_S = 30;

interface Board extends Pick<Machine, "setHome" | "moveTo" | "positionMm" | "stopSignal"> {
  readonly position: Pick<EbbPosition, "switchOn">;
  readonly connection: { readonly session: BoardSession };
}

export async function seekHome(
  board: Board,
  settings: MachineSettings,
  homing: HomingSwitches,
): Promise<void> {
  const machine = machineOf(settings);
  const slow = withTravelSpeed(settings, SEEK_SPEED_MM_PER_S);
  // A stop ends the search of both axes: later moves have another signal.
  const { stopSignal } = board;
  await board.position.switchOn(settings);
  await seekAxis(board, slow, homing.x, "x", machine.widthMm * SLACK, stopSignal);
  await seekAxis(board, slow, homing.y, "y", machine.heightMm * SLACK, stopSignal);
  await board.setHome(settings);
}

async function seekAxis(
  board: Board,
  settings: MachineSettings,
  input: SwitchInput,
  axis: "x" | "y",
  maxMm: number,
  stopSignal: StopSignal,
): Promise<void> {
  const machine = machineOf(settings);
  await board.connection.session.send(`PD,${input.port},${input.pin},1`);
  const step = async (byMm: number): Promise<void> => {
    stopSignal.throwIfAborted();
    const { x, y } = board.positionMm(machine)!;
    await board.moveTo(axis === "x" ? x + byMm : x, axis === "y" ? y + byMm : y, settings);
  };
  for (let movedMm = 0; !(await isPressed(board, input)); movedMm += SEEK_MM) {
    if (movedMm > maxMm) throw noSwitch(machine, axis, maxMm, input);
    await step(-SEEK_MM);
  }
  for (let movedMm = 0; await isPressed(board, input); movedMm += RELEASE_MM) {
    if (movedMm > MAX_RELEASE_MM) throw stuck(axis, input);
    await step(RELEASE_MM);
  }
}

async function isPressed(board: Board, { port, pin, pressed }: SwitchInput): Promise<boolean> {
  return Number(await board.connection.session.query(`PI,${port},${pin}`)) === pressed;
}

const withTravelSpeed = (settings: MachineSettings, speedMmPerS: number): MachineSettings => {
  const { motion } = settings;
  const travel = { ...motion.travel, speedMmPerS: Math.min(speedMmPerS, motion.travel.speedMmPerS) };
  return { ...settings, motion: { ...motion, travel } };
};

const noSwitch = (
  { name }: MachineProfile,
  axis: string,
  maxMm: number,
  { port, pin }: SwitchInput,
): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The ${name} moved ${Math.round(maxMm)} mm along ${axis} and reached no switch. Check the switch's cable, and its input (${port}${pin}) in the machine's profile.`,
  );

const stuck = (axis: string, { port, pin }: SwitchInput): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The switch of ${axis} (${port}${pin}) stays pressed although the carriage moved away from it. Check whether the machine's profile has its two states swapped.`,
  );
