/**
 * The host's planner: prepares one drawing, then plans it on request. A separate thread, so that the stream never
 * waits.
 */
import { importDrawing } from "../../../src/index.js";
import { prepareJob } from "../../../src/internal.js";
import { faultOf, type FromWorker, type ToWorker } from "../../../host/planning/messages.js";
import { answerOf, buffersOf, type ThreadInput } from "../../../host/planning/stages.js";
import { textOf, type DrawingText } from "../drawing-text.js";

/** The first message. All others are `ToWorker`. */
export interface PlannerStart extends ThreadInput {
  readonly drawing: DrawingText;
}

const scope = globalThis as unknown as {
  postMessage(message: FromWorker, transfer?: ArrayBuffer[]): void;
  onmessage: ((event: MessageEvent<unknown>) => void) | null;
};

scope.onmessage = ({ data }) => void begin(data as PlannerStart);

/** The host asks nothing before the planner is ready. */
async function begin(input: PlannerStart): Promise<void> {
  try {
    // Without a file name the format is detected from the content.
    const drawing = await importDrawing("", textOf(input.drawing));
    const { prepared, warnings } = prepareJob(drawing, input.settings, input.machine);
    scope.onmessage = (event) => {
      const answer = answerOf(prepared, warnings, input, event.data as ToWorker);
      scope.postMessage(answer, answer.type === "planned" ? buffersOf(answer.plot) : []);
    };
    scope.postMessage({ type: "ready", strokes: prepared.strokes, size: prepared.size, warnings });
  } catch (error) {
    scope.postMessage({ type: "failed", id: null, ...faultOf(error) });
  }
}
