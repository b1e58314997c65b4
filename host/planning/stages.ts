/**
 * Plans a job in the planner's thread. The machine is passed as a profile, so custom machines need no lookup
 * here. This file must not import zod, so that the thread starts fast.
 */
import { planJob, trajectoryStats, type MachineProfile, type Prepared } from "../../src/index.js";
import { pointCount, strokeCount } from "../../src/internal.js";
import type { JobStats, PlotSettings } from "../../src/schema/index.js";
import { faultOf, type FromWorker, type ToWorker } from "./messages.js";
import type { Measured, PlanRequest, PlannedPlot } from "./planning.js";

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
  const stats: JobStats = { size: prepared.size, ...counts, drawMm, travelMm, penLiftCount, durationS };
  return { stats, warnings: [...warnings, ...job.commands().warnings] };
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
