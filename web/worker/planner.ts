/**
 * The page's side of the planning worker: the latest request wins.
 *
 * When a request follows another one, the worker first finishes its current stage. If it has not begun the new request
 * after PATIENCE_MS, it is terminated and replaced, so that a huge drawing opened by mistake does not block the next
 * one. A worker that reads a file for longer than READING_MS is terminated too: a damaged file may keep it busy
 * endlessly.
 */
import type { StrokeSet } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { DrawingText } from "../backend/drawing-text.js";
import type {
  ExportFormat,
  PlanFault,
  Planned,
  Sketch,
  SketchRequest,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";
import { markMoment } from "./moments.js";

const PATIENCE_MS = 1_500;
const READING_MS = 120_000;

/** The used part of a Worker. Tests pass their own. */
export interface WorkerLike {
  postMessage(message: WorkerRequest): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<WorkerReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

interface PlannerTimer {
  after(delayMs: number, callback: () => void): () => void;
}

interface PlanListener {
  /** Called before each plan. */
  onImported(drawingKey: string): void;
  onPlanned(planned: Planned): void;
  onFault(fault: PlanFault): void;
  onExported(format: ExportFormat, text: string): void;
  onExportFailed(message: string): void;
}

export interface PlannerDrawing {
  /** Identifies the text: different texts have different keys. */
  readonly key: string;
  readonly text: DrawingText;
}

export interface PlannerTask {
  readonly drawing: PlannerDrawing;
  readonly settings: PlotSettings;
  /** Firmware of the board that will plot it; null: unknown. */
  readonly firmware: string | null;
}

/** A planner with a worker of this page. */
export const openPlanner = (listener: PlanListener): Planner =>
  new Planner(
    () => new Worker(new URL("./plan.worker.ts", import.meta.url), { type: "module" }),
    {
      after: (delayMs, callback) => {
        const timer = setTimeout(callback, delayMs);
        return () => clearTimeout(timer);
      },
    },
    listener,
  );

export class Planner {
  private worker: WorkerLike | null = null;
  /** The drawing whose text the running worker has. */
  private sentKey: string | null = null;
  private newestId = 0;
  private latest: PlannerTask | null = null;
  private isBusy = false;
  private takeStrokes: ((strokes: StrokeSet) => void) | null = null;
  private takeSketches: ((sketches: readonly Sketch[]) => void) | null = null;
  private stopWaiting: (() => void) | null = null;
  /** Set while the worker reads the file. */
  private stopReading: (() => void) | null = null;

  constructor(
    private readonly start: () => WorkerLike,
    private readonly timer: PlannerTimer,
    private readonly listener: PlanListener,
  ) {}

  /** Requests a plan. Earlier requests that are not answered yet are dropped. */
  request(task: PlannerTask): void {
    this.latest = task;
    if (this.isBusy) this.stopWaiting ??= this.timer.after(PATIENCE_MS, () => this.restart());
    this.newestId++;
    this.send(task);
  }

  /** Requests the prepared drawing as text, which `onExported` gets. */
  export(format: ExportFormat, firmware: string): void {
    this.worker?.postMessage({ type: "export", format, firmware });
  }

  /** Requests a copy of the last plan's strokes. Not answered while a newer plan is being made. */
  strokes(take: (strokes: StrokeSet) => void): void {
    this.takeStrokes = take;
    if (!this.isBusy) this.worker?.postMessage({ type: "strokes", id: this.newestId });
  }

  /** Requests small pictures of the last plan's drawing. Not answered while a newer plan is being made. */
  sketches(changes: SketchRequest["changes"], take: (sketches: readonly Sketch[]) => void): void {
    this.takeSketches = take;
    if (!this.isBusy) this.worker?.postMessage({ type: "sketches", id: this.newestId, changes });
  }

  /** Ends the worker. A later request starts another one. */
  close(): void {
    this.stopWaiting?.();
    this.stopWaiting = null;
    this.stopReading?.();
    this.worker?.terminate();
    this.worker = null;
    this.isBusy = false;
  }

  private send({ drawing, settings, firmware }: PlannerTask): void {
    const worker = (this.worker ??= this.open());
    const text = this.sentKey === drawing.key ? null : drawing.text;
    this.sentKey = drawing.key;
    this.isBusy = true;
    const id = this.newestId;
    worker.postMessage({ type: "plan", id, drawingKey: drawing.key, text, settings, firmware });
  }

  private open(): WorkerLike {
    const worker = this.start();
    this.sentKey = null;
    worker.onmessage = ({ data }) => this.take(data);
    worker.onerror = (event) => {
      this.close();
      this.listener.onFault({
        message:
          event.message || "The planner stopped. The drawing may be too large for this device's memory.",
        stage: "plan",
      });
    };
    return worker;
  }

  private take(reply: WorkerReply): void {
    if (reply.type === "exported") return this.listener.onExported(reply.format, reply.text);
    if (reply.type === "export-failed") return this.listener.onExportFailed(reply.message);
    if (reply.id !== this.newestId) return;
    if (reply.type === "strokes") return this.takeStrokes?.(reply.strokes);
    if (reply.type === "sketches") return this.takeSketches?.(reply.sketches);
    this.stopWaiting?.();
    this.stopWaiting = null;
    this.stopReading?.();
    if (reply.type === "imported") return this.listener.onImported(reply.drawingKey);
    if (reply.type === "started") {
      this.stopReading = this.timer.after(READING_MS, () => this.endReading());
      return;
    }
    this.isBusy = false;
    if (reply.type === "planned") {
      markMoment("plotwright-planned");
      this.listener.onPlanned(reply.planned);
    } else this.listener.onFault(reply.fault);
  }

  private endReading(): void {
    this.close();
    this.listener.onFault({
      message: "This file takes too long to read. It may be damaged. Simplify it, or export it again.",
      stage: "import",
    });
  }

  private restart(): void {
    this.close();
    if (this.latest) this.send(this.latest);
  }
}
