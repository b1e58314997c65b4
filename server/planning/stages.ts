/**
 * Text to strokes to commands, as the worker and the command line run them. The machine comes in as data
 * (a profile), so custom machines need no look-up here.
 */
import { importDrawing, planJob, type MachineProfile, type Prepared } from "../../src/index.js";
import { prepareJob, type PreparedJob } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlanRequest, PlannedPlot } from "../plotter/types.js";

/**
 * The format is told from the content. No clock goes in: the same text and settings give the same strokes in
 * every process, so that a place in a job stays valid after a restart.
 *
 * Throws `bad-file` (also when nothing is left to draw), `out-of-bounds`, `bad-setting`.
 */
export function prepareText(text: string, settings: PlotSettings, machine: MachineProfile): PreparedJob {
  return prepareJob(importDrawing("", text), settings, machine);
}

/** The plan of a request with its commands, as it crosses threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}
