/** Plans a job in the worker. The machine is passed as a profile, so custom machines need no lookup here. */
import { planJob, type MachineProfile, type Prepared } from "../../src/index.js";
import type { PlanRequest, PlannedPlot } from "./plot-planner.js";

/** The trajectory and commands for a request, in a form that can be sent between threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}
