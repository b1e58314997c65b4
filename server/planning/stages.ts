/**
 * Text to strokes to commands, as the worker and the command line run them. The machine comes in as data
 * (a profile), so custom machines need no look-up here.
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
  /** The file's and the paper's. Plain text. */
  readonly warnings: readonly string[];
}

/**
 * No clock goes in: the same drawing and settings give the same strokes in every process, so that a place in a job stays
 * valid after a restart.
 *
 * Throws `bad-file` (when nothing is left to draw), `out-of-bounds`, `bad-setting`.
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

/** The plan of a request with its commands, as it crosses threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}
