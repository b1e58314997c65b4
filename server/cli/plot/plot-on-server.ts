/** `plotwright plot FILE…` while a server has the plotter: each drawing becomes a job there, is started and followed. */
import { sizeInWords } from "../../../src/internal.js";
import type { Job } from "../../../src/schema/index.js";
import type { PenChoice } from "../../planning/layers-by-name.js";
import { printed, type CliIo } from "../io.js";
import { JobPlot } from "./job-plot.js";
import { plotReport } from "./plot-report.js";
import { CANCELLED, cancelled, watch } from "./plot-watch.js";
import type { ServerClient } from "../../../host/handle/server-client.js";
import { addDrawing } from "../client/queue-commands.js";
import type { ServedPlotter } from "../client/served-plotter.js";

interface Options {
  readonly only?: readonly string[];
  readonly pen?: readonly PenChoice[];
  readonly quiet?: boolean;
  readonly json?: boolean;
}

/** Returns the exit code: 0, or 5 when it was cancelled or this command was ended. Failures are thrown. */
export async function plotOnServer(
  { file, name, settings }: Pick<Job, "name" | "settings"> & { readonly file: string },
  served: ServedPlotter,
  end: AbortSignal,
  options: Options,
  io: CliIo,
): Promise<number> {
  const { access, client, plotter } = served;
  const { only, pen } = options;
  let isInterrupted = false;
  /** Until the plot is watched. */
  const forget = io.onInterrupt((isFinal) => {
    if (!isFinal && !isInterrupted) io.err("Stopping.\n");
    isInterrupted = true;
  });
  try {
    const job = await addDrawing(access, settings, file, { name, only, pen, plotterId: plotter.id });
    if (isInterrupted && (await isRemoved(client, job))) return cancelled(io);
    if (options.quiet !== true) {
      io.err(printed`The server at ${access.url} has ${plotter.name}, and plots it: job ${job.id}.\n`);
      job.warnings.forEach((warning) => io.err(printed`note: ${warning}\n`));
      if (job.stats) io.err(printed`${job.name}: ${sizeInWords(job.stats.size)}\n`);
    }
    await start(client, job);
    const report = plotReport(job.name, options, io);
    const endWords = `The plot continues on the server. To follow it: plotwright follow ${job.id}`;
    const run = new JobPlot(client, job.id);
    forget();
    const ended = await watch(run, { report, resumed: null, isInterrupted, end, endWords }, io);
    if (ended === "interrupted") return CANCELLED;
    return ended === "done" ? 0 : cancelled(io);
  } finally {
    forget();
  }
}

async function start(client: ServerClient, job: Job): Promise<void> {
  try {
    await client.jobs.start(job.id);
  } catch (error) {
    if (await isRemoved(client, job)) throw error;
  }
}

/** Removes the job if it waits. A queue that runs on by itself may have started it already: then false. */
async function isRemoved({ jobs }: ServerClient, { id }: Job): Promise<boolean> {
  if ((await jobs.get(id)).state !== "queued") return false;
  await jobs.remove(id);
  return true;
}
