/**
 * The one recipe from prepared strokes to a job for a machine. Page, server, command line and library all call it,
 * so the preview is the plot.
 *
 *   settings ──layer codes──> what each layer asks for ──firmware's limits──> plan ──> trajectory ──compile──> commands
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

/** Firmware to plan for while no board has been asked: every newer one does at least as well. */
export const OLDEST_PLANNED_FIRMWARE = "2.5.3";

/** The part of a job's settings that decides its motion. */
export interface JobSettings {
  readonly motion: MotionSettings;
  readonly pen: PenSettings;
}

export interface JobOptions {
  /** Where in the drawing to begin, in the middle of a stroke too; default: its beginning. */
  readonly from?: Place | null | undefined;
  /** Number of the stroke before which to stop and go home; default: the end of the drawing. */
  readonly until?: number | null | undefined;
  /** Where the carriage is, mm from home; default 0, 0. The pen is up there. */
  readonly startXMm?: number | undefined;
  readonly startYMm?: number | undefined;
  /** What the board's counters show there; default: at home, as they are after the motors were switched on. */
  readonly board?: BoardState | undefined;
  /** Of the board: "2.8.1". Default, and where it is null: the oldest that executes accelerations. */
  readonly firmware?: string | null | undefined;
  /** Begin with a lift, because nobody knows where the pen is. Default false. */
  readonly liftFirst?: boolean | undefined;
  /** Where to go when everything is drawn, mm from home; default home itself. */
  readonly endXMm?: number | undefined;
  readonly endYMm?: number | undefined;
  /** Checked before every stroke. An AbortSignal fits. */
  readonly cancel?: { readonly aborted: boolean } | undefined;
}

/** What one machine will do: its motion, and the commands for it. */
export interface MachineJob {
  readonly trajectory: Trajectory;
  /** Compiled on each call: a preview needs the motion only. */
  commands(): CommandStream;
}

/**
 * Plans `strokes` for a machine, from any place to any stroke.
 *
 * @throws PlotwrightError "bad-setting" for settings that contradict each other a firmware that is no version or a machine profile
 *   with something missing, "cancelled"
 * @throws RangeError for coordinates that are not finite, or a place that is not in the drawing
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

/** The settings that a plan follows: with the codes of the layers' names, within what the firmware can execute. */
export function followedSettings<S extends JobSettings>(
  settings: S,
  layers: readonly StrokeLayer[],
  firmware: string,
): S {
  const coded = withLayerCodes(settings, layers);
  return { ...coded, motion: motionForFirmware(coded.motion, firmware) };
}

/**
 * How far beside the drawing a pen may stand that was stopped on its line: what the planned line may leave it by, and
 * the rounding to steps.
 */
function penBesideMmOf({ draw, layers, fit }: MotionSettings, machine: MachineProfile): number {
  const corners = Object.values(layers ?? {}).map((layer) => layer.cornerMm ?? 0);
  return Math.max(draw.cornerMm, ...corners) + (fit?.toleranceMm ?? 0) + 2 / machine.stepsPerMm;
}

/** A drawing without its last strokes; the others keep their numbers. */
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
