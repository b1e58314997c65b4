/**
 * The planner's thread: prepares one drawing, then plans it on request. Must not import zod, so that it
 * starts fast.
 */
import { parentPort, workerData, type TransferListItem } from "node:worker_threads";
import { importDrawing } from "../../src/index.js";
import { prepareJob } from "../../src/internal.js";
import { faultOf, type FromWorker, type ToWorker } from "../../host/planning/messages.js";
import { answerOf, buffersOf } from "../../host/planning/stages.js";
import { withOnlyLayers } from "./layers-by-name.js";
import { mustFitMemory } from "./planning-limits.js";
import { inFont, readDrawing } from "./read-drawing.js";
import type { WorkerData } from "./planner.js";

const input = workerData as WorkerData;
const port = parentPort;
if (port === null) throw new Error("plan-worker runs as a worker thread only");

const post = (message: FromWorker, transfer: TransferListItem[] = []): void =>
  port.postMessage(message, transfer);

try {
  // Without a file name the format is detected from the content.
  const drawing = await importDrawing("", readDrawing(input.path), await inFont(input.font));
  mustFitMemory(drawing, input.growthMb);
  post({ type: "imported" });
  const settings = withOnlyLayers(drawing, input.settings, input.only);
  const { prepared, warnings } = prepareJob(drawing, settings, input.machine);
  port.on("message", (message: ToWorker) => {
    const answer = answerOf(prepared, warnings, input, message);
    post(answer, answer.type === "planned" ? buffersOf(answer.plot) : []);
  });
  post({ type: "ready", strokes: prepared.strokes, size: prepared.size, warnings });
} catch (error) {
  post({ type: "failed", id: null, ...faultOf(error) });
}
