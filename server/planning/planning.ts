/** Planning for the queue: plans stored drawings in a limited number of threads. */
import { stat } from "node:fs/promises";
import { machineOf } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import { lane } from "../../host/planning/lane.js";
import type { Planning } from "../../host/planning/planning.js";
import { OWN_PLANNING_LIMITS } from "./planning-limits.js";
import { measureDrawing, openPlanner } from "./planner.js";

export type { Planning } from "../../host/planning/planning.js";

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
      openPlanner({ ...input(drawing, settings), limits: OWN_PLANNING_LIMITS }, signal),
  };
}
