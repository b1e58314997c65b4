/** The whole way from a drawing's text to commands, in one call. */
import { importSvg } from "../import/svg/import-svg.js";
import { machineOf, type MachineChoice } from "../machines/profiles.js";
import { NO_PENS, type PenSetup } from "../prepare/pens.js";
import type { Prepared } from "../prepare/prepare.js";
import { DEFAULT_MOTION } from "../settings/motion.js";
import { DEFAULT_PEN } from "../settings/pen.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../settings/prepare.js";
import { planJob, type JobOptions, type JobSettings, type MachineJob } from "./plan-job.js";
import { prepareJob } from "./prepare-job.js";

/** What is left out is as on the page before anything was set there; a job's whole settings fit too. */
export interface SvgSettings extends Partial<JobSettings & MachineChoice & PenSetup> {
  readonly prepare?: PrepareSettings;
}

export interface PlannedSvg extends MachineJob {
  readonly prepared: Prepared;
  /** What of the file is not drawn, and what the paper cuts off. */
  readonly warnings: readonly string[];
}

/** @throws PlotwrightError "bad-file" (also where nothing is left to draw), "out-of-bounds", "bad-setting", "cancelled" */
export function planSvg(text: string, settings: SvgSettings = {}, options: JobOptions = {}): PlannedSvg {
  const whole = {
    machine: "axidraw-v3",
    prepare: DEFAULT_PREPARE,
    motion: DEFAULT_MOTION,
    pen: DEFAULT_PEN,
    ...NO_PENS,
    ...settings,
  };
  const machine = machineOf(whole);
  const { prepared, warnings } = prepareJob(importSvg(text), whole, machine);
  return { ...planJob(prepared, whole, machine, options), prepared, warnings };
}
