/** Plans strokes for an EBB within the limits of its firmware, and compiles the commands. */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { plan } from "../../../plan/plan.js";
import type { MotionSettings } from "../../../settings/motion.js";
import type { DriverPlanOptions, JobSettings, MachineJob } from "../../machine-job.js";
import { dropsAtStroke, motionForFirmware } from "../protocol/firmware-motion.js";
import type { BoardState, CommandStream } from "./command-stream.js";
import { commandLine, compile } from "./compile.js";
import { setUpCommands, closingCommands } from "../protocol/commands.js";

/** Firmware to plan for while the board's is unknown. All newer ones can do at least as much. */
export const OLDEST_PLANNED_FIRMWARE = "2.5.3";

export function planEbbJob(
  strokes: StrokeSet,
  settings: JobSettings,
  machine: MachineProfile,
  options: DriverPlanOptions,
): MachineJob<CommandStream> {
  const firmware = options.firmware ?? OLDEST_PLANNED_FIRMWARE;
  const { pen } = settings;
  const motion = motionForFirmware(settings.motion, firmware);
  const trajectory = plan(strokes, motion, pen, {
    machine,
    from: options.from ?? undefined,
    startX: options.startXMm,
    startY: options.startYMm,
    endX: options.endXMm,
    endY: options.endYMm,
    penOffsetMm: penBesideMmOf(motion, machine),
    liftFirst: options.liftFirst,
    dropsAtStroke: dropsAtStroke(firmware),
    cancel: options.cancel,
    ...(options.live && {
      penDown: options.live.penDown,
      liftAtEnd: options.live.end !== "down",
      returnHome: options.live.end === "home",
      mayGrow: options.live.mayGrow,
    }),
  });
  const start = options.board as BoardState | undefined;
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
