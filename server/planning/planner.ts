/**
 * A prepared drawing in a worker thread, ready to be planned from any place. Planning a large drawing takes
 * seconds, and the thread that streams to the board must not wait for it.
 *
 * A drawing that needs too much time or memory ends the worker, not the server.
 */
import { PlotwrightError, type MachineProfile, type StrokeSet } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlanRequest, PlannedPlot, PlotPlanner } from "../../host/planning/plot-planner.js";
import type { Measured } from "../../host/planning/planning.js";
import { BoundedThread } from "./bounded-thread.js";
import type { FromWorker, ToWorker } from "../../host/planning/messages.js";
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

export interface PlannerInput extends WorkerInput {
  /** Default PLANNING_LIMITS. */
  readonly limits?: PlanningLimits;
}

interface Waiting {
  readonly resolve: (message: FromWorker) => void;
  readonly reject: (error: Error) => void;
}

export class WorkerPlanner implements PlotPlanner {
  readonly strokes: StrokeSet;
  /** Warnings, for example about features of the file that are not drawn. */
  readonly warnings: readonly string[];
  readonly #thread: PlannerThread;

  private constructor(thread: PlannerThread, strokes: StrokeSet, warnings: readonly string[]) {
    this.#thread = thread;
    this.strokes = strokes;
    this.warnings = warnings;
  }

  /** Reads and prepares the drawing; throws the errors of import and prepare, or `cancelled`. */
  static async open(input: PlannerInput, signal?: AbortSignal): Promise<WorkerPlanner> {
    const thread = new PlannerThread(input);
    const stop = (): void => void thread.stop(cancelled());
    signal?.addEventListener("abort", stop, { once: true });
    if (signal?.aborted === true) stop();
    const ready = await thread.ready();
    if (ready.type !== "ready") throw new Error(`The planner answered ${ready.type} first`);
    return new WorkerPlanner(thread, ready.strokes, ready.warnings);
  }

  async plan(request: PlanRequest): Promise<PlannedPlot> {
    const answer = await this.#thread.ask((id) => ({ type: "plan", id, request }));
    if (answer.type !== "planned") throw new Error(`The planner answered ${answer.type} to plan`);
    return answer.plot;
  }

  /**
   * Plans the whole drawing from home, for a board with this firmware (null: unknown), and returns only its
   * figures.
   */
  async measure(firmware: string | null): Promise<Measured> {
    const answer = await this.#thread.ask((id) => ({ type: "measure", id, firmware }));
    if (answer.type !== "measured") throw new Error(`The planner answered ${answer.type} to measure`);
    return { stats: answer.stats, warnings: answer.warnings };
  }

  async close(): Promise<void> {
    await this.#thread.stop(cancelled());
  }
}

/** The figures and warnings of a job with this drawing. Throws the errors of import, prepare and plan. */
export async function measureDrawing(
  input: PlannerInput,
  firmware: string | null,
  signal?: AbortSignal,
): Promise<Measured> {
  const planner = await WorkerPlanner.open(input, signal);
  try {
    return await planner.measure(firmware);
  } finally {
    await planner.close();
  }
}

/** The worker and the requests that wait for its answers. */
class PlannerThread {
  readonly #thread: BoundedThread<FromWorker>;
  readonly #limits: PlanningLimits;
  readonly #waiting = new Map<number | null, Waiting>();
  readonly #ready: Promise<FromWorker>;
  #nextId = 1;
  #ended: Error | null = null;

  constructor({ limits = PLANNING_LIMITS, ...input }: PlannerInput) {
    this.#limits = limits;
    this.#ready = this.#wait(null);
    // Avoids an unhandled rejection if ready() is never called; ready() itself still rejects.
    this.#ready.catch(() => undefined);
    const { heapMb, growthMb } = limits;
    const start = { name: "plan-worker", starterUrl: import.meta.url, workerData: input, heapMb, growthMb };
    this.#thread = new BoundedThread<FromWorker>(start, {
      message: (message) => {
        if (message.type === "imported") this.#thread.allow(prepareLimit(limits, input.settings.prepare));
        else this.#settle(message);
      },
      ended: (reason) => this.#end(reason),
    });
    this.#thread.allow(importLimit(limits));
  }

  ready(): Promise<FromWorker> {
    return this.#ready;
  }

  ask(question: (id: number) => ToWorker): Promise<FromWorker> {
    if (this.#ended !== null) return Promise.reject(this.#ended);
    const id = this.#nextId++;
    const answer = this.#wait(id);
    this.#thread.allow(planLimit(this.#limits));
    this.#thread.post(question(id));
    return answer;
  }

  stop(reason: Error): Promise<void> {
    return this.#thread.stop(reason);
  }

  #wait(id: number | null): Promise<FromWorker> {
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #settle(message: Exclude<FromWorker, { type: "imported" }>): void {
    const id = message.type === "ready" ? null : message.id;
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    this.#thread.allow(this.#waiting.size === 0 ? null : planLimit(this.#limits));
    if (message.type === "failed") {
      waiting?.reject(new PlotwrightError(message.code, message.message));
    } else {
      waiting?.resolve(message);
    }
  }

  #end(reason: Error): void {
    this.#ended = reason;
    for (const waiting of this.#waiting.values()) waiting.reject(reason);
    this.#waiting.clear();
  }
}

const cancelled = (): PlotwrightError => new PlotwrightError("cancelled", "Planning was cancelled.");
