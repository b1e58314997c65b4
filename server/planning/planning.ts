/** Planning for the queue: by a stored drawing's id, on a few threads at a time. */
import { stat } from "node:fs/promises";
import { machineOf } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { DrawingFiles } from "../queue/drawing-files.js";
import type { Planning } from "../queue/queue-parts.js";
import { lane } from "./lane.js";
import { OWN_PLANNING_LIMITS } from "./planning-limits.js";
import { WorkerPlanner, measureDrawing } from "./planner.js";

/** Uploads measured at once in each lane; the board's own planner never waits behind them. */
const PLACES = 2;
/** What is larger, or may be searched for longer, waits in a lane of its own: the others never wait behind it. */
const LARGE_BYTES = 5_000_000;
const LONG_ORDER_S = 30;

export function createPlanning(files: DrawingFiles): Planning {
  const shortWork = lane(PLACES);
  const longWork = lane(PLACES);
  const input = (drawing: string, settings: PlotSettings) => ({
    path: files.path(drawing),
    settings,
    machine: machineOf(settings),
  });
  const isLong = async (path: string, { order, orderS }: PlotSettings["prepare"]): Promise<boolean> =>
    (order === "best" && orderS > LONG_ORDER_S) || (await stat(path)).size > LARGE_BYTES;
  return {
    measure: async (drawing, settings, firmware, asker = {}) => {
      const wanted = input(drawing, settings);
      const turn = (await isLong(wanted.path, settings.prepare)) ? longWork : shortWork;
      return turn(asker, () => measureDrawing(wanted, firmware, asker.signal));
    },
    open: (drawing, settings, signal) =>
      WorkerPlanner.open({ ...input(drawing, settings), limits: OWN_PLANNING_LIMITS }, signal),
  };
}
