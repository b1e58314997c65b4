/** Planning for the queue, each drawing in its own worker. */
import { PlotwrightError } from "../../../src/index.js";
import { machineOf } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { lane } from "../../../host/planning/lane.js";
import type { FromWorker } from "../../../host/planning/messages.js";
import {
  measureAndClose,
  openPlanner,
  type OpenPlanner,
  type PlannerListener,
  type PlannerThread,
} from "../../../host/planning/open-planner.js";
import type { Planning } from "../../../host/planning/planning.js";
import type { DrawingText } from "../drawing-text.js";
import { reasonOf } from "./worker-fault.js";
import type { PlannerStart } from "./planner.worker.js";

/** Drawings measured at the same time. The planner of a running plot does not wait for them. */
const SLOTS = 2;

/** `drawingOf` first waits for all changes so far to be stored, because a plot begins by opening its planner. */
export function workerPlanning(drawingOf: (id: string) => Promise<DrawingText>): Planning {
  const turn = lane(SLOTS);
  const open = async (id: string, settings: PlotSettings, signal?: AbortSignal): Promise<OpenPlanner> => {
    const input = { drawing: await drawingOf(id), settings, machine: machineOf(settings) };
    return openPlanner((listener) => startThread(input, listener), signal);
  };
  return {
    open,
    measure: (id, settings, firmware, requester = {}) =>
      turn(requester, async () => measureAndClose(await open(id, settings, requester.signal), firmware)),
  };
}

function startThread(input: PlannerStart, { message, ended }: PlannerListener): PlannerThread {
  const worker = new Worker(new URL("./planner.worker.ts", import.meta.url), { type: "module" });
  const stop = (reason: Error): void => {
    worker.terminate();
    ended(reason);
  };
  worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
    // The drawing can't be prepared, so the worker is not needed any more.
    if (data.type === "failed" && data.id === null) worker.terminate();
    message(data);
  };
  worker.onerror = (event) => stop(new PlotwrightError("internal", `Planning failed: ${reasonOf(event)}`));
  worker.postMessage(input);
  return { post: (question) => worker.postMessage(question), stop };
}
