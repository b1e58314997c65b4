/** Planning for the queue: takes the id of a stored drawing and uses a few threads at a time. */
import { stat } from "node:fs/promises";
import { machineOf } from "../../src/internal.js";
import type { JobStats, PlotSettings } from "../../src/schema/index.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import { lane, type Requester } from "./lane.js";
import { OWN_PLANNING_LIMITS } from "./planning-limits.js";
import type { PlotPlanner } from "./plot-planner.js";
import { WorkerPlanner, measureDrawing } from "./planner.js";

export interface Planning {
  /** `firmware` of the board that will plot it; null: unknown. */
  measure(
    drawing: string,
    settings: PlotSettings,
    firmware: string | null,
    requester?: Requester,
  ): Promise<{ readonly stats: JobStats; readonly warnings: readonly string[] }>;
  open(drawing: string, settings: PlotSettings, signal: AbortSignal): Promise<PlotPlanner>;
}

/** Uploads measured at the same time in each lane. The planner of a running plot does not wait for them. */
const SLOTS = 2;
/**
 * Larger files, and longer searches for an order, use a separate lane, so that short work never waits for
 * them.
 */
const LARGE_BYTES = 5_000_000;
const LONG_ORDER_S = 30;

export function createPlanning(files: DrawingFiles): Planning {
  const shortWork = lane(SLOTS);
  const longWork = lane(SLOTS);
  const input = (drawing: string, settings: PlotSettings) => ({
    path: files.path(drawing),
    settings,
    machine: machineOf(settings),
  });
  const isLong = async (path: string, { order, orderS }: PlotSettings["prepare"]): Promise<boolean> =>
    (order === "best" && orderS > LONG_ORDER_S) || (await stat(path)).size > LARGE_BYTES;
  return {
    measure: async (drawing, settings, firmware, requester = {}) => {
      const wanted = input(drawing, settings);
      const turn = (await isLong(wanted.path, settings.prepare)) ? longWork : shortWork;
      return turn(requester, () => measureDrawing(wanted, firmware, requester.signal));
    },
    open: (drawing, settings, signal) =>
      WorkerPlanner.open({ ...input(drawing, settings), limits: OWN_PLANNING_LIMITS }, signal),
  };
}
