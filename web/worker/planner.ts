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
  FileMeasured,
  PlanFault,
  Planned,
  Sketch,
  PageSheet,
  SheetOnPaper,
  SketchRequest,
  WorkerFile,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";
import { markMoment } from "./moments.js";

const PATIENCE_MS = 1_500;
const READING_MS = 120_000;
const TOO_LONG = "This file takes too long to read. It may be damaged. Simplify it, or export it again.";

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

export interface PlannerFile {
  /** Identifies the text: different texts have different keys. */
  readonly key: string;
  readonly text: DrawingText;
}

export interface PlannerDrawing extends PlannerFile {
  /** In place of the text: several files. */
  readonly sheet?: PageSheet | null;
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
  /** The files whose texts the running worker has. */
  private readonly sent = new Set<string>();
  /** Files that are being measured, by key. */
  private readonly measuring = new Map<
    string,
    { readonly file: PlannerFile; take(measured: FileMeasured): void }
  >();
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

  /** What a file draws. Never rejects. */
  measure(file: PlannerFile): Promise<FileMeasured> {
    return new Promise((resolve) => {
      const stopWaiting = this.timer.after(READING_MS, () => {
        const isPlanning = this.isBusy;
        this.end(TOO_LONG);
        if (isPlanning && this.latest) this.send(this.latest);
      });
      const take = (measured: FileMeasured): void => {
        stopWaiting();
        this.measuring.delete(file.key);
        resolve(measured);
      };
      this.measuring.set(file.key, { file, take });
      if (this.worker) this.worker.postMessage({ type: "measure", file: this.withText(file) });
      else this.worker = this.open();
    });
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
    const { key: drawingKey, sheet: kept = null } = drawing;
    const files = (kept?.files ?? [drawing]).map((file) => this.withText(file));
    const sheet = kept && onPaper(kept);
    this.sent.clear();
    for (const file of files) this.sent.add(file.key);
    this.isBusy = true;
    const id = this.newestId;
    worker.postMessage({ type: "plan", id, drawingKey, files, sheet, settings, firmware });
  }

  /** With its text, unless the worker has it. */
  private withText({ key, text }: PlannerFile): WorkerFile {
    const isSent = this.sent.has(key);
    this.sent.add(key);
    return { key, text: isSent ? null : text };
  }

  /** A new worker, with the files to measure that the last one did not answer for. */
  private open(): WorkerLike {
    const worker = this.start();
    this.sent.clear();
    for (const { file } of this.measuring.values()) {
      worker.postMessage({ type: "measure", file: this.withText(file) });
    }
    worker.onmessage = ({ data }) => this.take(data);
    worker.onerror = (event) => {
      const message =
        event.message || "The planner stopped. The drawing may be too large for this device's memory.";
      this.end(message);
      this.listener.onFault({ message, stage: "plan" });
    };
    return worker;
  }

  private take(reply: WorkerReply): void {
    if (reply.type === "exported") return this.listener.onExported(reply.format, reply.text);
    if (reply.type === "export-failed") return this.listener.onExportFailed(reply.message);
    if (reply.type === "measured") return this.measuring.get(reply.key)?.take(reply.measured);
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
    this.end(TOO_LONG);
    this.listener.onFault({ message: TOO_LONG, stage: "import" });
  }

  /** Ends the worker, and gives up the files that it was to measure. */
  private end(fault: string): void {
    this.close();
    for (const { take } of [...this.measuring.values()]) take({ fault });
  }

  private restart(): void {
    this.close();
    if (this.latest) this.send(this.latest);
  }
}

const onPaper = ({ files, pieces }: PageSheet): SheetOnPaper => ({
  names: files.map(({ name, layerPrefix }) => ({ name, layerPrefix })),
  items: pieces.map(({ fileKey, map, isCropped }) => ({
    source: files.findIndex(({ key }) => key === fileKey),
    map,
    isCropped,
  })),
});
