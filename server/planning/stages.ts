/** The plan of a job, as the worker makes it. The machine comes in as data (a profile), so own machines need no look-up. */
import { planJob, type MachineProfile, type Prepared } from "../../src/index.js";
import type { PlanRequest, PlannedPlot } from "../plotter/types.js";

/** The plan of a request with its commands, as it crosses threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}
