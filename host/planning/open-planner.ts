/**
 * A prepared drawing in a thread, ready to be planned from any place. Planning a large drawing takes seconds, and the
 * thread that streams to the board must not wait for it. The host program starts the thread.
 */
import { PlotwrightError } from "../../src/index.js";
import type { FromWorker, ReadyDrawing, ToWorker } from "./messages.js";
import type { Measured, PlotPlanner } from "./planning.js";

export interface PlannerListener {
  message(message: FromWorker): void;
  /** The thread has ended; no message follows. */
  ended(reason: Error): void;
}

export interface PlannerThread {
  post(message: ToWorker): void;
  /** Ends the thread and calls `ended` with the reason. */
  stop(reason: Error): void | Promise<void>;
}

/** Starts a thread that prepares the drawing and answers "ready" or "failed". */
type StartPlanner = (listener: PlannerListener) => PlannerThread;

export interface OpenPlanner extends PlotPlanner, ReadyDrawing {
  /** Plans the whole drawing from home, for a board with this firmware (null: unknown), and returns only its figures. */
  measure(firmware: string | null): Promise<Measured>;
}

interface Waiting {
  readonly resolve: (message: FromWorker) => void;
  readonly reject: (error: Error) => void;
}

/** Throws the errors of import and prepare, or `cancelled`. */
export async function openPlanner(start: StartPlanner, signal?: AbortSignal): Promise<OpenPlanner> {
  /** By the request's id; null: the first answer, sent when the drawing is prepared. */
  const waiting = new Map<number | null, Waiting>();
  let nextId = 1;
  let end: Error | null = null;
  const answerTo = (id: number | null): Promise<FromWorker> =>
    new Promise((resolve, reject) => waiting.set(id, { resolve, reject }));

  const firstAnswer = answerTo(null);
  const thread = start({
    message: (message) => {
      if (message.type === "imported") return;
      const id = message.type === "ready" ? null : message.id;
      const request = waiting.get(id);
      waiting.delete(id);
      if (message.type === "failed") request?.reject(new PlotwrightError(message.code, message.message));
      else request?.resolve(message);
    },
    ended: (reason) => {
      end ??= reason;
      for (const { reject } of waiting.values()) reject(reason);
      waiting.clear();
    },
  });
  const close = async (): Promise<void> => thread.stop(cancelled());
  signal?.addEventListener("abort", () => void close(), { once: true });
  if (signal?.aborted === true) void close();
  const ready = await firstAnswer;
  if (ready.type !== "ready") throw new Error(`The planner answered ${ready.type} first`);

  const ask = (question: (id: number) => ToWorker): Promise<FromWorker> => {
    if (end !== null) return Promise.reject(end);
    const id = nextId++;
    const answer = answerTo(id);
    thread.post(question(id));
    return answer;
  };
  return {
    strokes: ready.strokes,
    size: ready.size,
    warnings: ready.warnings,
    plan: async (request) => {
      const answer = await ask((id) => ({ type: "plan", id, request }));
      if (answer.type !== "planned") throw new Error(`The planner answered ${answer.type} to plan`);
      return answer.plot;
    },
    measure: async (firmware) => {
      const answer = await ask((id) => ({ type: "measure", id, firmware }));
      if (answer.type !== "measured") throw new Error(`The planner answered ${answer.type} to measure`);
      return { stats: answer.stats, warnings: answer.warnings };
    },
    close,
  };
}

/** The figures and warnings of a job with the planner's drawing. Closes the planner. */
export async function measureAndClose(planner: OpenPlanner, firmware: string | null): Promise<Measured> {
  try {
    return await planner.measure(firmware);
  } finally {
    await planner.close();
  }
}

const cancelled = (): PlotwrightError => new PlotwrightError("cancelled", "Planning was cancelled.");
