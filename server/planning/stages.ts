/**
 * The steps from a drawing to strokes to commands, used by the worker and the command line. The machine is
 * passed as a profile, so custom machines need no lookup here.
 */
import {
  PlotwrightError,
  checkBounds,
  planJob,
  prepare,
  prepareSettingsOf,
  strokeCount,
  type Drawing,
  type MachineProfile,
  type Prepared,
  type Work,
} from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlanRequest, PlannedPlot } from "../plotter/types.js";

export interface PreparedJob {
  readonly prepared: Prepared;
  /** Warnings about the file and the paper, as plain text. */
  readonly warnings: readonly string[];
}

/**
 * Does not depend on time: the same drawing and settings give the same strokes in every process, so that a
 * place in a job stays valid after a restart.
 *
 * Throws `bad-file` (when there is nothing to draw), `out-of-bounds`, `bad-setting`.
 */
export function prepareDrawing(
  drawing: Drawing,
  settings: PlotSettings,
  machine: MachineProfile,
  work: Work = {},
): PreparedJob {
  const prepared = prepare(drawing, prepareSettingsOf(settings), work);
  const warnings = [...drawing.warnings.map((warning) => warning.message), ...prepared.warnings];
  if (strokeCount(prepared.strokes) === 0) {
    throw new PlotwrightError("bad-file", `There is nothing to draw. ${warnings.join(" ")}`.trim());
  }
  checkBounds(prepared.strokes, machine);
  return { prepared, warnings };
}

/** The trajectory and commands for a request, in a form that can be sent between threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}
