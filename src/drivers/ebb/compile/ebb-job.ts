/** Plans strokes for an EBB within the limits of its firmware, and compiles the commands. */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { plan, planTravel } from "../../../plan/plan.js";
import type { Trajectory } from "../../../plan/trajectory.js";
import type { MotionSettings } from "../../../settings/motion.js";
import type { PenSettings } from "../../../settings/pen.js";
import type { DriverPlanOptions, JobSettings, MachineJob } from "../../machine-job.js";
import { closingCommands, setUpCommands } from "../protocol/commands.js";
import { dropsAtStroke, motionForFirmware } from "../protocol/firmware-motion.js";
import type { BoardState, CommandStream } from "./command-stream.js";
import { commandLine, compile } from "./compile.js";

/** Firmware to plan for while the board's is unknown. All newer ones can do at least as much. */
export const OLDEST_PLANNED_FIRMWARE = "2.5.3";

export function planEbbJob(
  strokes: StrokeSet,
  settings: JobSettings,
  machine: MachineProfile,
  options: DriverPlanOptions,
): MachineJob<CommandStream> {
  const firmware = options.firmware ?? OLDEST_PLANNED_FIRMWARE;
  const motion = motionForFirmware(settings.motion, firmware);
  const trajectory = plan(strokes, motion, settings.pen, {
    machine,
    from: options.from ?? undefined,
    startX: options.startXMm,
    startY: options.startYMm,
    endX: options.endXMm,
    endY: options.endYMm,
    penBesideMm: penBesideMmOf(motion, machine),
    liftFirst: options.liftFirst,
    dropsAtStroke: dropsAtStroke(firmware),
    cancel: options.cancel,
  });
  return ebbJob(trajectory, machine, firmware, settings.pen, options.board as BoardState | undefined);
}

/**
 * A straight move with the pen up, mm from home, as a separate job.
 *
 * @throws PlotwrightError "bad-setting" for settings that contradict each other
 */
export function planEbbWalk(
  from: { readonly x: number; readonly y: number },
  to: { readonly x: number; readonly y: number },
  { motion, pen }: JobSettings,
  machine: MachineProfile,
  firmware: string,
  board: BoardState,
): MachineJob<CommandStream> {
  const limited = motionForFirmware(motion, firmware);
  const trajectory = planTravel([from.x, from.y], [to.x, to.y], limited, pen, machine);
  return ebbJob(trajectory, machine, firmware, pen, board);
}

/** A trajectory as a job. `start`: the board's counters; undefined: all zero, as after the motors are switched on. */
function ebbJob(
  trajectory: Trajectory,
  machine: MachineProfile,
  firmware: string,
  pen: PenSettings,
  start: BoardState | undefined,
): MachineJob<CommandStream> {
  let compiled: CommandStream | null = null;
  const commands = (): CommandStream => (compiled ??= compile(trajectory, { machine, firmware, pen, start }));
  const lines = (): string[] => {
    const stream = commands();
    const drawing = Array.from({ length: stream.count }, (_, i) => commandLine(stream, i));
    return [...setUpCommands(machine, pen, firmware), ...drawing, ...closingCommands()];
  };
  return { trajectory, commands, lines };
}

/**
 * How far a pen that stopped on the planned line can be from the drawing: the deviation of the planned line, plus the
 * rounding to steps.
 */
function penBesideMmOf({ draw, layers, fit }: MotionSettings, machine: MachineProfile): number {
  const corners = Object.values(layers ?? {}).map((layer) => layer.cornerMm ?? 0);
  return Math.max(draw.cornerMm, ...corners) + (fit?.toleranceMm ?? 0) + 2 / machine.stepsPerMm;
}
