/** Planning for the queue: by a stored drawing's id, on a few threads at a time. */
import { machineOf } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { DrawingFiles } from "../queue/drawing-files.js";
import type { Planning } from "../queue/queue-parts.js";
import { WorkerPlanner, measureDrawing } from "./planner.js";

/** Uploads measured at once; the board's own planner never waits behind them. */
const MAX_MEASURING = 2;

export function createPlanning(files: DrawingFiles): Planning {
  const turn = limiter(MAX_MEASURING);
  const input = (drawing: string, settings: PlotSettings) => ({
    path: files.path(drawing),
    settings,
    machine: machineOf(settings),
  });
  return {
    measure: (drawing, settings, firmware, signal) =>
      turn(() => measureDrawing(input(drawing, settings), firmware, signal)),
    open: (drawing, settings, signal) => WorkerPlanner.open(input(drawing, settings), signal),
  };
}

function limiter(most: number): <T>(work: () => Promise<T>) => Promise<T> {
  let running = 0;
  const waiting: (() => void)[] = [];
  return async (work) => {
    if (running >= most) await new Promise<void>((resolve) => waiting.push(resolve));
    else running++;
    try {
      return await work();
    } finally {
      // The place goes straight to the next in line, so that no newcomer can slip in between.
      const next = waiting.shift();
      if (next === undefined) running--;
      else next();
    }
  };
}
