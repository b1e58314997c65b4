/**
 * The planner's thread: prepares one drawing, then plans it on request. Must not import zod, so that it
 * starts fast.
 */
import { parentPort, workerData, type TransferListItem } from "node:worker_threads";
import { importDrawing, type Prepared } from "../../src/index.js";
import { prepareJob } from "../../src/internal.js";
import { faultOf, type FromWorker, type ToWorker, type WorkerInput } from "./messages.js";
import { withOnlyLayers } from "./only-layers.js";
import { readDrawing } from "./read-drawing.js";
import { buffersOf, measurePrepared, planAndCompile } from "../../host/planning/stages.js";

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
      post({
        type: "measured",
        id: message.id,
        ...measurePrepared(prepared, warnings, input, message.firmware),
      });
    }
  } catch (error) {
    post({ type: "failed", id: message.id, ...faultOf(error) });
  }
}
