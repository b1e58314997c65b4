/** `plotwright plot FILE…` while a server has the plotter: each drawing becomes a job there, is started and followed. */
import { sizeInWords } from "../../../src/internal.js";
import type { PenChoice } from "../../planning/layers-by-name.js";
import { printed, type CliIo } from "../io.js";
import { JobRun } from "./job-run.js";
import { plotReport } from "./plot-report.js";
import { CANCELLED, cancelled, watch } from "./plot-watch.js";
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
  file: string,
  served: ServedPlotter,
  end: AbortSignal,
  options: Options,
  io: CliIo,
): Promise<number> {
  const {
    access,
    client,
    plotter,
    settings: { settings },
  } = served;
  const { only, pen } = options;
  const job = await addDrawing(access, settings, file, { only, pen, plotterId: plotter.id });
  if (options.quiet !== true) {
    io.err(printed`The server at ${access.url} has ${plotter.name}, and plots it: job ${job.id}.\n`);
    job.warnings.forEach((warning) => io.err(printed`note: ${warning}\n`));
    if (job.stats) io.err(printed`${job.name}: ${sizeInWords(job.stats.size)}\n`);
  }
  try {
    await client.jobs.start(job.id);
  } catch (error) {
    // A queue that runs on by itself may have started it already.
    if ((await client.jobs.get(job.id)).state === "queued") {
      await client.jobs.remove(job.id);
      throw error;
    }
  }
  const report = plotReport(job.name, options, io);
  const endWords = `The plot continues on the server. To follow it: plotwright follow ${job.id}`;
  const run = new JobRun(client, job.id);
  const ended = await watch(run, { report, resumed: null, end, endWords }, io);
  if (ended === "interrupted") return CANCELLED;
  return ended === "done" ? 0 : cancelled(io);
}
