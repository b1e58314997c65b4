/**
 * Plans a drawing in a worker thread. A drawing that needs too much time or memory ends the worker, not the server.
 */
import type { MachineProfile } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { FromWorker } from "../../host/planning/messages.js";
import {
  measureAndClose,
  openPlanner as openWith,
  type OpenPlanner,
  type PlannerListener,
  type PlannerThread,
} from "../../host/planning/open-planner.js";
import type { Measured } from "../../host/planning/planning.js";
import { BoundedThread } from "./bounded-thread.js";
import {
  importLimit,
  planLimit,
  prepareLimit,
  PLANNING_LIMITS,
  type PlanningLimits,
} from "./planning-limits.js";

/** Passed to the worker when it starts. It prepares the drawing at once and answers "ready". */
export interface WorkerInput {
  /** The drawing's file. The worker reads it, so that its text never passes through the main thread. */
  readonly path: string;
  readonly settings: PlotSettings;
  readonly machine: MachineProfile;
  /** Names of the layers to draw; default: all. */
  readonly only?: readonly string[] | undefined;
}

export interface WorkerData extends WorkerInput {
  /** How much memory planning may take. */
  readonly growthMb: number;
}

export interface PlannerInput extends WorkerInput {
  /** Default PLANNING_LIMITS. */
  readonly limits?: PlanningLimits;
}

/** Reads and prepares the drawing; throws the errors of import and prepare, or `cancelled`. */
export const openPlanner = (input: PlannerInput, signal?: AbortSignal): Promise<OpenPlanner> =>
  openWith((listener) => startThread(input, listener), signal);

/** The figures and warnings of a job with this drawing. Throws the errors of import, prepare and plan. */
export const measureDrawing = async (
  input: PlannerInput,
  firmware: string | null,
  signal?: AbortSignal,
): Promise<Measured> => measureAndClose(await openPlanner(input, signal), firmware);

/** Starts the worker. Each step has a time limit: reading, preparing, and each plan. */
function startThread(
  { limits = PLANNING_LIMITS, ...input }: PlannerInput,
  { message, ended }: PlannerListener,
): PlannerThread {
  const { heapMb, growthMb } = limits;
  const workerData: WorkerData = { ...input, growthMb };
  const start = { name: "plan-worker", starterUrl: import.meta.url, workerData, heapMb, growthMb };
  /** Answers that are still to come; the first is "ready". */
  let dueCount = 1;
  const thread = new BoundedThread<FromWorker>(start, {
    message: (answer) => {
      if (answer.type === "imported") thread.allow(prepareLimit(limits, input.settings.prepare));
      else thread.allow(--dueCount === 0 ? null : planLimit(limits));
      message(answer);
    },
    ended,
  });
  thread.allow(importLimit(limits));
  return {
    post: (question) => {
      dueCount++;
      thread.allow(planLimit(limits));
      thread.post(question);
    },
    stop: (reason) => thread.stop(reason),
  };
}
