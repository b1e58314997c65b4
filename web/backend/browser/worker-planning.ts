/** Planning for the queue, each drawing in its own worker. */
import { PlotwrightError, type StrokeSet } from "../../../src/index.js";
import { machineOf } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { lane } from "../../../host/planning/lane.js";
import type { FromWorker, ToWorker } from "../../../host/planning/messages.js";
import type { Measured, Planning } from "../../../host/planning/planning.js";
import type { PlannedPlot, PlanRequest, PlotPlanner } from "../../../host/planning/plot-planner.js";
import type { DrawingText } from "../../worker/drawing-text.js";
import { reasonOf } from "./worker-fault.js";
import type { PlannerStart } from "./planner.worker.js";

/** Drawings measured at the same time. The planner of a running plot does not wait for them. */
const SLOTS = 2;

/** `drawingOf` resolves only when all changes so far are stored, because a plot begins by opening its planner. */
export function workerPlanning(drawingOf: (id: string) => Promise<DrawingText>): Planning {
  const turn = lane(SLOTS);
  const open = async (id: string, settings: PlotSettings, signal?: AbortSignal): Promise<WorkerPlanner> =>
    WorkerPlanner.open({ drawing: await drawingOf(id), settings, machine: machineOf(settings) }, signal);
  return {
    open,
    measure: (id, settings, firmware, requester = {}) =>
      turn(requester, async () => {
        const planner = await open(id, settings, requester.signal);
        try {
          return await planner.measure(firmware);
        } finally {
          await planner.close();
        }
      }),
  };
}

interface Waiting {
  readonly resolve: (message: FromWorker) => void;
  readonly reject: (error: Error) => void;
}

class WorkerPlanner implements PlotPlanner {
  readonly #worker = new Worker(new URL("./planner.worker.ts", import.meta.url), { type: "module" });
  /** By the request's id; null: the first answer, sent when the drawing is prepared. */
  readonly #waiting = new Map<number | null, Waiting>();
  #strokes: StrokeSet | null = null;
  #nextId = 1;
  #ended: Error | null = null;

  private constructor() {
    this.#worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#settle(data);
    this.#worker.onerror = (event) =>
      this.#end(new PlotwrightError("internal", `Planning failed: ${reasonOf(event)}`));
  }

  /** Reads and prepares the drawing. Throws the errors of import and prepare, or `cancelled`. */
  static async open(start: PlannerStart, signal?: AbortSignal): Promise<WorkerPlanner> {
    const planner = new WorkerPlanner();
    const stop = (): void => planner.#end(cancelled());
    signal?.addEventListener("abort", stop, { once: true });
    if (signal?.aborted === true) stop();
    const ready = await planner.#send(null, start);
    if (ready.type !== "ready") throw new Error(`The planner answered ${ready.type} first`);
    planner.#strokes = ready.strokes;
    return planner;
  }

  get strokes(): StrokeSet {
    if (this.#strokes === null) throw new Error("The planner is not ready.");
    return this.#strokes;
  }

  async plan(request: PlanRequest): Promise<PlannedPlot> {
    const id = this.#nextId++;
    const answer = await this.#send(id, { type: "plan", id, request });
    if (answer.type !== "planned") throw new Error(`The planner answered ${answer.type} to plan`);
    return answer.plot;
  }

  async measure(firmware: string | null): Promise<Measured> {
    const id = this.#nextId++;
    const answer = await this.#send(id, { type: "measure", id, firmware });
    if (answer.type !== "measured") throw new Error(`The planner answered ${answer.type} to measure`);
    return { stats: answer.stats, warnings: answer.warnings };
  }

  close(): Promise<void> {
    this.#end(cancelled());
    return Promise.resolve();
  }

  #send(id: number | null, message: PlannerStart | ToWorker): Promise<FromWorker> {
    if (this.#ended !== null) return Promise.reject(this.#ended);
    this.#worker.postMessage(message);
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #settle(message: FromWorker): void {
    if (message.type === "imported") return;
    const id = message.type === "ready" ? null : message.id;
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (message.type === "failed") {
      // The drawing can't be prepared, so the worker is not needed any more.
      if (id === null) this.#worker.terminate();
      waiting?.reject(new PlotwrightError(message.code, message.message));
    } else waiting?.resolve(message);
  }

  #end(reason: Error): void {
    this.#ended ??= reason;
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(reason);
    this.#waiting.clear();
  }
}

const cancelled = (): PlotwrightError => new PlotwrightError("cancelled", "Planning was cancelled.");
