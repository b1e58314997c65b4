/**
 * Turns prepared strokes into a job for a machine. Page, server, command line and library all call this
 * function, so the preview always matches the plot.
 *
 *   settings ──layer codes──> settings per layer ──firmware limits──> plan ──> trajectory ──compile──> commands
 */
import type { StrokeLayer, StrokeSet } from "../drawing/stroke-set.js";
import type { BoardState, CommandStream } from "../drivers/ebb/compile/command-stream.js";
import { compile } from "../drivers/ebb/compile/compile.js";
import { motionForFirmware } from "../drivers/ebb/protocol/firmware-motion.js";
import { checkProfile } from "../machines/check-profile.js";
import type { MachineProfile } from "../machines/profile.js";
import { withLayerCodes } from "../plan/coded-layers.js";
import { plan } from "../plan/plan.js";
import type { MotionSettings } from "../settings/motion.js";
import type { PenSettings } from "../settings/pen.js";
import type { Place, Trajectory } from "../plan/trajectory.js";

/** Firmware to plan for while no board is connected: every newer one is at least as capable. */
export const OLDEST_PLANNED_FIRMWARE = "2.5.3";

/** The part of a job's settings that determines its motion. */
export interface JobSettings {
  readonly motion: MotionSettings;
  readonly pen: PenSettings;
}

export interface JobOptions {
  /** Where in the drawing to begin, possibly within a stroke; default: at its start. */
  readonly from?: Place | null | undefined;
  /** Index of the stroke before which to stop and go home; default: the end of the drawing. */
  readonly until?: number | null | undefined;
  /** Where the carriage is, mm from home; default 0, 0. The pen is up there. */
  readonly startXMm?: number | undefined;
  readonly startYMm?: number | undefined;
  /** The board's counters at that position; default: at home, with the motors just switched on. */
  readonly board?: BoardState | undefined;
  /** The board's firmware: "2.8.1". Left out or null: the oldest that supports acceleration. */
  readonly firmware?: string | null | undefined;
  /** Begin with a lift, because the pen's position is unknown. Default false. */
  readonly liftFirst?: boolean | undefined;
  /** Where to go after the last stroke, mm from home; default home. */
  readonly endXMm?: number | undefined;
  readonly endYMm?: number | undefined;
  /** Checked before every stroke. An AbortSignal fits. */
  readonly cancel?: { readonly aborted: boolean } | undefined;
}

/** A planned job for one machine: its motion, and the commands for it. */
export interface MachineJob {
  readonly trajectory: Trajectory;
  /** Compiled on each call, because a preview needs only the motion. */
  commands(): CommandStream;
}

/**
 * Plans `strokes` for a machine, from any position in the drawing to any stroke.
 *
 * @throws PlotwrightError "bad-setting" for contradictory settings, an invalid firmware version or an incomplete
 *   machine profile; "cancelled"
 * @throws RangeError for coordinates that are not finite, or a start outside the drawing
 */
export function planJob(
  { strokes }: { readonly strokes: StrokeSet },
  settings: JobSettings,
  machine: MachineProfile,
  options: JobOptions = {},
): MachineJob {
  checkProfile(machine);
  const firmware = options.firmware ?? OLDEST_PLANNED_FIRMWARE;
  const { motion, pen } = followedSettings(settings, strokes.layers, firmware);
  const trajectory = plan(firstStrokes(strokes, options.until ?? null), motion, pen, {
    machine,
    from: options.from ?? undefined,
    startX: options.startXMm,
    startY: options.startYMm,
    endX: options.endXMm,
    endY: options.endYMm,
    penBesideMm: penBesideMmOf(motion, machine),
    liftFirst: options.liftFirst,
    cancel: options.cancel,
  });
  return {
    trajectory,
    commands: () => compile(trajectory, { machine, firmware, pen, start: options.board }),
  };
}

/**
 * The settings that a plan uses: with the codes from layer names applied, limited to
 * what the firmware supports.
 */
export function followedSettings<S extends JobSettings>(
  settings: S,
  layers: readonly StrokeLayer[],
  firmware: string,
): S {
  const coded = withLayerCodes(settings, layers);
  return { ...coded, motion: motionForFirmware(coded.motion, firmware) };
}

/**
 * How far from the drawing a pen that was stopped on its line may be: the allowed deviation of the planned
 * line plus the rounding to steps.
 */
function penBesideMmOf({ draw, layers, fit }: MotionSettings, machine: MachineProfile): number {
  const corners = Object.values(layers ?? {}).map((layer) => layer.cornerMm ?? 0);
  return Math.max(draw.cornerMm, ...corners) + (fit?.toleranceMm ?? 0) + 2 / machine.stepsPerMm;
}

/** The first `count` strokes; they keep their indices. */
function firstStrokes(strokes: StrokeSet, count: number | null): StrokeSet {
  if (count === null) return strokes;
  const { xy, offsets, layer, layers } = strokes;
  return {
    xy: xy.subarray(0, 2 * (offsets[count] ?? 0)),
    offsets: offsets.subarray(0, count + 1),
    layer: layer.subarray(0, count),
    layers,
  };
}
