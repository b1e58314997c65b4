/**
 * Plans a job in the planner's thread. The machine is passed as a profile, so custom machines need no lookup
 * here. This file must not import zod, so that the thread starts fast.
 */
import {
  planJob,
  trajectoryStats,
  type MachineProfile,
  type Prepared,
  type StrokeSet,
  type Trajectory,
} from "../../src/index.js";
import { penOf, penStopsOf, pointCount, strokeCount } from "../../src/internal.js";
import type { JobPens, JobStats, PlotSettings } from "../../src/schema/index.js";
import { faultOf, type FromWorker, type ToWorker } from "./messages.js";
import type { Measured, PlanRequest, PlannedPlot } from "./planning.js";

/** Longer lists are cut off: nobody reads them, and every page gets them. */
const MAX_PEN_STOPS = 20;

/** The input with which the planner's thread is started. */
export interface ThreadInput {
  readonly settings: PlotSettings;
  readonly machine: MachineProfile;
}

/** The answer of the planner's thread to a message. Never throws. */
export function answerOf(
  prepared: Prepared,
  warnings: readonly string[],
  input: ThreadInput,
  message: ToWorker,
): FromWorker {
  const { id } = message;
  try {
    if (message.type === "plan") {
      return { type: "planned", id, plot: planAndCompile(prepared, message.request, input.machine) };
    }
    return { type: "measured", id, ...measurePrepared(prepared, warnings, input, message.firmware) };
  } catch (error) {
    return { type: "failed", id, ...faultOf(error) };
  }
}

/** The trajectory and commands for a request, in a form that can be sent between threads. */
export function planAndCompile(
  prepared: Pick<Prepared, "strokes">,
  { settings, ...options }: PlanRequest,
  machine: MachineProfile,
): PlannedPlot {
  const job = planJob(prepared, settings, machine, options);
  return { trajectory: job.trajectory, commands: job.commands() };
}

/**
 * Also compiles the job, although only the figures are needed: what the board cannot do is then found before the job is
 * added, not during the plot.
 */
function measurePrepared(
  prepared: Prepared,
  warnings: readonly string[],
  { settings, machine }: ThreadInput,
  firmware: string | null,
): Measured {
  const job = planJob(prepared, settings, machine, { firmware });
  const { drawMm, travelMm, penLiftCount, durationS } = trajectoryStats(job.trajectory);
  const counts = { strokeCount: strokeCount(prepared.strokes), pointCount: pointCount(prepared.strokes) };
  const pens = pensOf(prepared.strokes, settings, job.trajectory);
  const stats: JobStats = { size: prepared.size, ...counts, drawMm, travelMm, penLiftCount, durationS, pens };
  return { stats, warnings: [...warnings, ...job.commands().warnings] };
}

/** Which pens the plot begins and ends with, and when it waits for others. Linear in strokes and runs. */
export function pensOf(strokes: StrokeSet, settings: PlotSettings, { runs }: Trajectory): JobPens {
  const penAt = (stroke: number): JobPens["first"] => {
    if (stroke < 0) return null;
    const layer = strokes.layers[strokes.layer[stroke]];
    const pen = penOf(settings, layer);
    return pen === null ? null : { name: pen.name, color: pen.color ?? layer.color };
  };
  const count = strokeCount(strokes);
  let run = 0;
  const stops = penStopsOf(strokes, settings)
    .slice(0, MAX_PEN_STOPS)
    .map(({ strokeIndex, penName, layerName, color }) => {
      while (run < runs.count && runs.stroke[run] < strokeIndex) run++;
      return { name: penName ?? layerName, color, strokeIndex, atS: runs.startS[run] ?? 0 };
    });
  return { first: penAt(count > 0 ? 0 : -1), last: penAt(count - 1), stops };
}

/** The buffers of all arrays in `value`, to transfer between threads. A buffer that arrays share is listed once. */
export function buffersOf(value: object): ArrayBuffer[] {
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
