/**
 * The planner's thread: prepares one drawing, then plans it on request. Must not import zod, so that it
 * starts fast.
 */
import { parentPort, workerData, type TransferListItem } from "node:worker_threads";
import { importDrawing, planJob, trajectoryStats, type Prepared } from "../../src/index.js";
import { prepareJob, pointCount, strokeCount } from "../../src/internal.js";
import type { JobStats } from "../../src/schema/index.js";
import { faultOf, type FromWorker, type ToWorker, type WorkerInput } from "./messages.js";
import { withOnlyLayers } from "./only-layers.js";
import { readDrawing } from "./read-drawing.js";
import { planAndCompile } from "./stages.js";

const input = workerData as WorkerInput;
const port = parentPort;
if (port === null) throw new Error("plan-worker runs as a worker thread only");

const post = (message: FromWorker, transfer: TransferListItem[] = []): void =>
  port.postMessage(message, transfer);

try {
  // Without a file name the format is detected from the content.
  const drawing = importDrawing("", readDrawing(input.path));
  post({ type: "imported" });
  const settings = withOnlyLayers(drawing, input.settings, input.only);
  const { prepared, warnings } = prepareJob(drawing, settings, input.machine);
  port.on("message", (message: ToWorker) => answer(prepared, warnings, message));
  post({ type: "ready", strokes: prepared.strokes, warnings });
} catch (error) {
  post({ type: "failed", id: null, ...faultOf(error) });
}

function answer(prepared: Prepared, warnings: readonly string[], message: ToWorker): void {
  try {
    if (message.type === "plan") {
      const plot = planAndCompile(prepared, message.request, input.machine);
      post({ type: "planned", id: message.id, plot }, buffersOf(plot));
    } else {
      post({ type: "measured", id: message.id, ...measure(prepared, warnings, message.firmware) });
    }
  } catch (error) {
    post({ type: "failed", id: message.id, ...faultOf(error) });
  }
}

/**
 * Compiles too, although only the figures are needed: so anything the board can't do shows now, not during
 * the plot.
 */
function measure(
  prepared: Prepared,
  warnings: readonly string[],
  firmware: string | null,
): { stats: JobStats; warnings: readonly string[] } {
  const job = planJob(prepared, input.settings, input.machine, { firmware });
  const { trajectory } = job;
  const figures = trajectoryStats(trajectory);
  const stats: JobStats = {
    strokeCount: strokeCount(prepared.strokes),
    pointCount: pointCount(prepared.strokes),
    drawMm: figures.drawMm,
    travelMm: figures.travelMm,
    penLiftCount: figures.penLiftCount,
    durationS: figures.durationS,
  };
  return { stats, warnings: [...warnings, ...job.commands().warnings] };
}

/** The buffer of every array, once each: columns may share a buffer. */
function buffersOf(value: object): ArrayBuffer[] {
  const found = new Set<ArrayBuffer>();
  const visit = (part: unknown): void => {
    if (ArrayBuffer.isView(part)) {
      if (part.buffer instanceof ArrayBuffer) found.add(part.buffer);
    } else if (typeof part === "object" && part !== null) {
      Object.values(part).forEach(visit);
    }
  };
  visit(value);
  return [...found];
}
