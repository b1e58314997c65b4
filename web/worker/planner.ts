/**
 * The page's end of the planning worker: the latest request wins.
 *
 * A request that overtakes another one lets the worker finish the stage it is in; a worker that has not
 * turned to the new one PATIENCE_MS later is ended and started afresh, so that a huge drawing that was
 * dropped by mistake never stands in the way of the next one. One that reads a file for longer than READING_MS is
 * ended too: a damaged file may keep it busy without end.
 */
import type { StrokeSet } from "../../src/index.js";
import type { PaperSize } from "../../src/internal.js";
import type { DrawingText } from "./drawing-text.js";
import type {
  ExportFormat,
  PlanFault,
  Planned,
  PlanSettings,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";
import { markMoment } from "./moments.js";

const PATIENCE_MS = 1_500;
const READING_MS = 120_000;

/** What this needs of a Worker; tests give their own. */
export interface WorkerLike {
  postMessage(message: WorkerRequest): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<WorkerReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

export interface PlannerTimer {
  after(delayMs: number, callback: () => void): () => void;
}

export interface PlannerListener {
  /** Before the first plan of a drawing, and of every other one. */
  onImported(drawingKey: string, page: PaperSize): void;
  onPlanned(planned: Planned): void;
  onFault(fault: PlanFault): void;
  onExported(format: ExportFormat, text: string): void;
  onExportFailed(message: string): void;
}

export interface PlannerDrawing {
  /** Names the text: another text has another key. */
  readonly key: string;
  readonly text: DrawingText;
}

export interface PlannerTask {
  readonly drawing: PlannerDrawing;
  readonly settings: PlanSettings;
  /** Of the board that is to plot it; null: not known. */
  readonly firmware: string | null;
}

export class Planner {
  readonly #start: () => WorkerLike;
  readonly #timer: PlannerTimer;
  readonly #listener: PlannerListener;
  #worker: WorkerLike | null = null;
  /** The drawing whose text the running worker has. */
  #sentKey: string | null = null;
  #newestId = 0;
  #latest: PlannerTask | null = null;
  #isBusy = false;
  #takeStrokes: ((strokes: StrokeSet) => void) | null = null;
  #stopWaiting: (() => void) | null = null;
  /** While the worker reads the file. */
  #stopReading: (() => void) | null = null;

  constructor(start: () => WorkerLike, timer: PlannerTimer, listener: PlannerListener) {
    this.#start = start;
    this.#timer = timer;
    this.#listener = listener;
  }

  /** Asks for a plan; whatever was asked before and has not come yet will not come. */
  request(task: PlannerTask): void {
    this.#latest = task;
    if (this.#isBusy) this.#stopWaiting ??= this.#timer.after(PATIENCE_MS, () => this.#restart());
    this.#newestId++;
    this.#send(task);
  }

  /** Asks for the prepared drawing as text; `onExported` brings it. */
  export(format: ExportFormat, firmware: string): void {
    this.#worker?.postMessage({ type: "export", format, firmware });
  }

  /** Asks for a copy of the strokes of the plan that came last; none comes while a newer plan is made. */
  strokes(take: (strokes: StrokeSet) => void): void {
    this.#takeStrokes = take;
    if (!this.#isBusy) this.#worker?.postMessage({ type: "strokes", id: this.#newestId });
  }

  /** Ends the worker. */
  close(): void {
    this.#stopWaiting?.();
    this.#stopWaiting = null;
    this.#stopReading?.();
    this.#worker?.terminate();
    this.#worker = null;
    this.#isBusy = false;
  }

  #send({ drawing, settings, firmware }: PlannerTask): void {
    const worker = (this.#worker ??= this.#open());
    const text = this.#sentKey === drawing.key ? null : drawing.text;
    this.#sentKey = drawing.key;
    this.#isBusy = true;
    const id = this.#newestId;
    worker.postMessage({ type: "plan", id, drawingKey: drawing.key, text, settings, firmware });
  }

  #open(): WorkerLike {
    const worker = this.#start();
    this.#sentKey = null;
    worker.onmessage = ({ data }) => this.#take(data);
    worker.onerror = (event) => {
      this.close();
      this.#listener.onFault({
        code: "internal",
        message:
          event.message || "The planner stopped. The drawing may be too large for this device's memory.",
        stage: "plan",
      });
    };
    return worker;
  }

  #take(reply: WorkerReply): void {
    if (reply.type === "exported") return this.#listener.onExported(reply.format, reply.text);
    if (reply.type === "export-failed") return this.#listener.onExportFailed(reply.message);
    if (reply.id !== this.#newestId) return;
    if (reply.type === "strokes") return this.#takeStrokes?.(reply.strokes);
    this.#stopWaiting?.();
    this.#stopWaiting = null;
    this.#stopReading?.();
    if (reply.type === "imported") return this.#listener.onImported(reply.drawingKey, reply.page);
    if (reply.type === "started") {
      this.#stopReading = this.#timer.after(READING_MS, () => this.#endReading());
      return;
    }
    this.#isBusy = false;
    if (reply.type === "planned") {
      markMoment("plotwright-planned");
      this.#listener.onPlanned(reply.planned);
    } else this.#listener.onFault(reply.fault);
  }

  #endReading(): void {
    this.close();
    this.#listener.onFault({
      code: "bad-file",
      message: "This file takes too long to read. It may be damaged. Simplify it, or export it again.",
      stage: "import",
    });
  }

  #restart(): void {
    this.close();
    if (this.#latest) this.#send(this.#latest);
  }
}
