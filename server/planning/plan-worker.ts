/** The planner's thread: prepares one drawing, then plans it as often as asked. No zod in here. */
import { readFileSync } from "node:fs";
import { parentPort, workerData, type TransferListItem } from "node:worker_threads";
import {
  motionForFirmware,
  PlotwrightError,
  pointCount,
  strokeCount,
  textOfBytes,
  trajectoryStats,
  type ErrorCode,
  type Prepared,
} from "../../src/index.js";
import type { JobStats } from "../../src/schema/index.js";
import type { FromWorker, ToWorker, WorkerInput } from "./messages.js";
import { BOARD_AT_HOME, OLDEST_PLANNED_FIRMWARE, planAndCompile, prepareText } from "./stages.js";

const input = workerData as WorkerInput;
const port = parentPort;
if (port === null) throw new Error("plan-worker runs as a worker thread only");

const post = (message: FromWorker, transfer: TransferListItem[] = []): void =>
  port.postMessage(message, transfer);

try {
  const text = textOfBytes(readFileSync(input.path));
  const { prepared, warnings } = prepareText(text, input.settings, input.machine);
  port.on("message", (message: ToWorker) => answer(prepared, warnings, message));
  post({ type: "ready", strokes: prepared.strokes, warnings });
} catch (error) {
  post({ type: "failed", id: null, ...fault(error) });
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
    post({ type: "failed", id: message.id, ...fault(error) });
  }
}

/**
 * Compiled too, though only figures are wanted: what the board can't do shows here, not in mid-plot. The board's own
 * firmware says how it moves, which makes the time; its commands are not needed for that.
 */
function measure(
  prepared: Prepared,
  warnings: readonly string[],
  firmware: string | null,
): { stats: JobStats; warnings: readonly string[] } {
  const { trajectory, commands } = planAndCompile(
    prepared,
    {
      from: null,
      until: null,
      startXMm: 0,
      startYMm: 0,
      settings: { ...input.settings, motion: motionForFirmware(input.settings.motion, firmware) },
      firmware: OLDEST_PLANNED_FIRMWARE,
      board: BOARD_AT_HOME,
    },
    input.machine,
  );
  const figures = trajectoryStats(trajectory);
  const stats: JobStats = {
    strokeCount: strokeCount(prepared.strokes),
    pointCount: pointCount(prepared.strokes),
    drawMm: figures.drawMm,
    travelMm: figures.travelMm,
    penLiftCount: figures.penLiftCount,
    durationS: figures.durationS,
  };
  return { stats, warnings: [...warnings, ...commands.warnings] };
}

function fault(error: unknown): { code: ErrorCode; message: string } {
  if (error instanceof PlotwrightError) return { code: error.code, message: error.message };
  return { code: "internal", message: error instanceof Error ? error.message : String(error) };
}

/** Every array's memory, once each: columns may share one. */
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
