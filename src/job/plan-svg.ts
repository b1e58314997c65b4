/** Plans SVG text in one call. */
import { checkNames } from "../check-arguments.js";
import { importSvg } from "../import/svg/import-svg.js";
import { machineOf, type MachineChoice } from "../machines/profiles.js";
import { completeSettings } from "../prepare/complete-settings.js";
import { NO_PENS, type PenSetup } from "../prepare/layers/pens.js";
import type { Prepared } from "../prepare/prepare.js";
import { DEFAULT_MOTION } from "../settings/motion.js";
import { withGiven, type DeepPartial } from "../settings/partial.js";
import { DEFAULT_PEN } from "../settings/pen.js";
import { STREAM_TABLE } from "../settings/machine.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { type JobOptions, type JobSettings, type MachineJob, planJob } from "./plan-job.js";
import { prepareJob } from "./prepare-job.js";

/**
 * Settings of `planSvg`. Settings that are left out have their defaults, as on the page. The complete settings of a job
 * (`PlotSettings` of `plotwright/schema`) fit too.
 */
export interface SvgSettings extends DeepPartial<JobSettings>, Partial<MachineChoice & PenSetup> {
  /** Paper, placing, hatching, order of strokes … Default: `DEFAULT_PREPARE`. */
  readonly prepare?: Partial<PrepareSettings>;
}

/** A job, and the strokes that it draws. */
export interface PlannedSvg extends MachineJob {
  /** The strokes on the paper, with their layers and lengths. */
  readonly prepared: Prepared;
  /** Warnings about features of the file that are not drawn, lines cut off by the paper, and unused settings. */
  readonly warnings: readonly string[];
}

const NAMES = [
  ...["machine", "customMachine", "prepare", "motion", "pen"],
  ...Object.keys(NO_PENS),
  ...Object.keys(STREAM_TABLE),
];

/**
 * Turns SVG text into motion and commands for a machine: import, prepare, check that the machine reaches
 * everything, and plan. The default machine is an AxiDraw V3, the default paper A4 in landscape.
 *
 * @throws PlotwrightError "bad-file" (also if nothing is left to draw), "out-of-bounds", "bad-setting", "cancelled"
 */
export async function planSvg(
  text: string,
  settings: SvgSettings = {},
  options: JobOptions = {},
): Promise<PlannedSvg> {
  checkNames("planSvg", settings, NAMES);
  const whole = {
    machine: "axidraw-v3",
    ...NO_PENS,
    ...settings,
    motion: withGiven(DEFAULT_MOTION, settings.motion ?? {}),
    pen: withGiven(DEFAULT_PEN, settings.pen ?? {}),
    prepare: completeSettings(settings.prepare ?? {}),
  };
  const machine = machineOf(whole);
  const { prepared, warnings } = prepareJob(await importSvg(text), whole, machine);
  return { ...planJob(prepared, whole, machine, options), prepared, warnings };
}
