/** A straight move with the pen up, as a job of its own. */
import { compile } from "../drivers/ebb/compile/compile.js";
import { motionForFirmware } from "../drivers/ebb/protocol/firmware-motion.js";
import type { BoardState } from "../drivers/ebb/compile/command-stream.js";
import type { MachineProfile } from "../machines/profile.js";
import { planTravel } from "../plan/plan.js";
import type { JobSettings, MachineJob } from "./plan-job.js";

export interface WalkOptions {
  readonly fromXMm: number;
  readonly fromYMm: number;
  readonly toXMm: number;
  readonly toYMm: number;
  readonly firmware: string;
  readonly board: BoardState;
}

/** @throws PlotwrightError "bad-setting" for settings that contradict each other */
export function planWalk(settings: JobSettings, machine: MachineProfile, walk: WalkOptions): MachineJob {
  const { fromXMm, fromYMm, toXMm, toYMm, firmware, board } = walk;
  const motion = motionForFirmware(settings.motion, firmware);
  const trajectory = planTravel([fromXMm, fromYMm], [toXMm, toYMm], motion, settings.pen, machine);
  return {
    trajectory,
    commands: () => compile(trajectory, { machine, firmware, pen: settings.pen, start: board }),
  };
}
