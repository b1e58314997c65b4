/**
 * Plans drawings in worker threads: for the queue in a limited number of them. A drawing that needs too much time or memory
 * ends its worker, not the server.
 */
import type { MachineProfile } from "../../src/index.js";
import type { PlotSettings, BoxMm } from "../../src/schema/index.js";
import type { FromWorker } from "../../host/planning/messages.js";
import {
  measureAndClose,
  openPlanner as openWith,
  type OpenPlanner,
  type PlannerListener,
  type PlannerThread,
} from "../../host/planning/open-planner.js";
import type { Measured, Planning } from "../../host/planning/planning.js";
import { BoundedThread } from "./bounded-thread.js";
import {
  importLimit,
  planLimit,
  prepareLimit,
  PLANNING_LIMITS,
  type PlanningLimits,
  OWN_PLANNING_LIMITS,
} from "./planning-limits.js";
import { stat } from "node:fs/promises";
import { machineOf } from "../../src/internal.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import { lane } from "../../host/planning/lane.js";

/** Passed to the worker when it starts. It prepares the drawing at once and answers "ready". */
interface WorkerInput {
  /** The drawing's file. The worker reads it, so that its text never passes through the main thread. */
  readonly path: string;
  readonly settings: PlotSettings;
  readonly machine: MachineProfile;
  /** Names of the layers to draw; default: all. */
  readonly only?: readonly string[] | undefined;
  /** The file of the font in whose outlines text is drawn; default: the built-in letters. */
  readonly font?: string | undefined;
}

export interface WorkerData extends WorkerInput {
  /** How much memory planning may take. */
  readonly growthMb: number;
}

interface PlannerInput extends WorkerInput {
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

/**
 * The bounding box of a drawing's strokes on the machine, as placed by its settings. Throws the errors of import and prepare;
 * `bad-file` for a drawing without strokes.
 */
export async function drawingBoxMm(
  path: string,
  settings: PlotSettings,
  { only, font }: Pick<WorkerInput, "only" | "font"> = {},
): Promise<BoxMm> {
  const planner = await openPlanner({ path, settings, machine: machineOf(settings), only, font });
  try {
    const { xy } = planner.strokes;
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < xy.length; i += 2) {
      x0 = Math.min(x0, xy[i]);
      x1 = Math.max(x1, xy[i]);
      y0 = Math.min(y0, xy[i + 1]);
      y1 = Math.max(y1, xy[i + 1]);
    }
    return { xMm: x0, yMm: y0, widthMm: x1 - x0, heightMm: y1 - y0 };
  } finally {
    await planner.close();
  }
}
