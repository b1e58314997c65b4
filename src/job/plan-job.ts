/**
 * Turns prepared strokes into a job for a machine. Page, server, command line and library all call this
 * function, so the preview always matches the plot.
 *
 *   1. cut the strokes at `until`
 *   2. add the codes of the layers' names to the settings
 *   3. plan with the driver of the machine's controller: trajectory and commands
 */
import { checkObject } from "../check-arguments.js";
import { checkStrokes, type StrokeSet } from "../drawing/stroke-set.js";
import type { DriverPlanOptions, JobSettings, MachineJob } from "../drivers/machine-job.js";
import { checkMachine, plannerOf } from "../drivers/registry.js";
import type { MachineProfile } from "../machines/profile.js";
import type { PenSetup } from "../prepare/layers/pens.js";
import { checkSettingNames } from "../plan/check-settings.js";
import { withLayerCodes } from "../plan/coded-layers.js";
import { DEFAULT_MOTION } from "../settings/motion.js";
import { withGiven, type DeepPartial } from "../settings/partial.js";
import { DEFAULT_PEN } from "../settings/pen.js";

export type { JobSettings, MachineJob } from "../drivers/machine-job.js";

/** Where a job begins and ends, and for which firmware. Every option has a default. */
export interface JobOptions extends DriverPlanOptions {
  /** Index of the stroke before which to stop and go home; default: the end of the drawing. */
  readonly until?: number | null | undefined;
}

/**
 * Plans `strokes` for a machine, from any position in the drawing to any stroke. Settings that are left out have their
 * defaults: `{ motion: { draw: { speedMmPerS: 40 } } }`. The pens of the layers only matter for `lines`.
 *
 * @throws PlotwrightError "bad-setting" for contradictory settings, an invalid firmware version or an incomplete
 *   machine profile; "cancelled"
 * @throws RangeError for coordinates that are not finite, or a start outside the drawing
 */
export function planJob(
  prepared: { readonly strokes: StrokeSet },
  settings: DeepPartial<JobSettings> & Partial<PenSetup>,
  machine: MachineProfile,
  { until = null, ...options }: JobOptions = {},
): MachineJob {
  checkObject(
    "planJob",
    "the first argument",
    prepared,
    ["strokes"],
    "{ strokes }, for example what prepare returns",
  );
  const { strokes } = prepared;
  checkStrokes("planJob", strokes);
  checkObject("planJob", "the settings object", settings, [], "{}, or { motion: …, pen: … }");
  const motion = withGiven(DEFAULT_MOTION, settings.motion ?? {});
  const pen = withGiven(DEFAULT_PEN, settings.pen ?? {});
  checkSettingNames(motion, pen);
  checkMachine(machine);
  const coded = withLayerCodes({ ...settings, motion, pen }, strokes.layers);
  return plannerOf(machine)(firstStrokes(strokes, until), coded, machine, options);
}

/** The first `count` strokes; they keep their indices. */
function firstStrokes(strokes: StrokeSet, count: number | null): StrokeSet {
  if (count === null) return strokes;
  const { xy, offsets, layer, layers, speedFactor } = strokes;
  return {
    ...(speedFactor && { speedFactor: speedFactor.subarray(0, count) }),
    xy: xy.subarray(0, 2 * (offsets[count] ?? 0)),
    offsets: offsets.subarray(0, count + 1),
    layer: layer.subarray(0, count),
    layers,
  };
}
