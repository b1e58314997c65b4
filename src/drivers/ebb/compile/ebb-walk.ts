/** A straight move with the pen up, as a separate job. */
import type { MachineProfile } from "../../../machines/profile.js";
import { planTravel } from "../../../plan/plan.js";
import type { JobSettings, MachineJob } from "../../machine-job.js";
import { motionForFirmware } from "../protocol/firmware-motion.js";
import type { BoardState, CommandStream } from "./command-stream.js";
import { ebbJob } from "./ebb-job.js";

export interface WalkOptions {
  readonly fromXMm: number;
  readonly fromYMm: number;
  readonly toXMm: number;
  readonly toYMm: number;
  readonly firmware: string;
  readonly board: BoardState;
}

/** @throws PlotwrightError "bad-setting" for settings that contradict each other */
export function planEbbWalk(
  settings: JobSettings,
  machine: MachineProfile,
  walk: WalkOptions,
): MachineJob<CommandStream> {
  const { fromXMm, fromYMm, toXMm, toYMm, firmware, board } = walk;
  const motion = motionForFirmware(settings.motion, firmware);
  const trajectory = planTravel([fromXMm, fromYMm], [toXMm, toYMm], motion, settings.pen, machine);
  return ebbJob(trajectory, machine, firmware, settings.pen, board);
}
