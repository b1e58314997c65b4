/**
 * Text to strokes to commands, as the worker and the command line run them. The machine comes in as data
 * (a profile), so custom machines need no look-up here.
 */
import {
  PlotwrightError,
  checkBounds,
  compile,
  motionForFirmware,
  plan,
  prepare,
  prepareSettingsOf,
  strokeCount,
  withLayerCodes,
  type BoardState,
  type Drawing,
  type MachineProfile,
  type Prepared,
  type StrokeSet,
  type Work,
} from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlanRequest, PlannedPlot } from "../plotter/types.js";

/** Firmware to plan for while no board has been asked: every newer one does at least as well. */
export const OLDEST_PLANNED_FIRMWARE = "2.5.3";
export const BOARD_AT_HOME: BoardState = { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };

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

export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  request: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const { from, until } = request;
  const settings = withLayerCodes(request.settings, prepared.strokes.layers);
  const strokes = until === null ? prepared.strokes : firstStrokes(prepared.strokes, until);
  const trajectory = plan(strokes, motionForFirmware(settings.motion, request.firmware), settings.pen, {
    ...(from === null ? {} : { from }),
    startX: request.startXMm,
    startY: request.startYMm,
    penBesideMm: penBesideMmOf(settings.motion, machine),
    machine,
  });
  const commands = compile(trajectory, {
    machine,
    firmware: request.firmware,
    pen: settings.pen,
    start: request.board,
  });
  return { trajectory, commands };
}

/** How far from the drawing a pen may stand that was stopped on its line: what the line may leave it by, and rounding to steps. */
function penBesideMmOf({ draw, layers, fit }: PlotSettings["motion"], machine: MachineProfile): number {
  const corners = Object.values(layers ?? {}).map((layer) => layer.cornerMm ?? 0);
  return Math.max(draw.cornerMm, ...corners) + (fit?.toleranceMm ?? 0) + 2 / machine.stepsPerMm;
}

/** A drawing without its last strokes; the others keep their numbers. */
const firstStrokes = ({ xy, offsets, layer, layers }: StrokeSet, count: number): StrokeSet => ({
  xy: xy.subarray(0, 2 * offsets[count]!),
  offsets: offsets.subarray(0, count + 1),
  layer: layer.subarray(0, count),
  layers,
});
