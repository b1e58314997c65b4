/** Commands to a running server's queue. */
import { basename } from "node:path";
import { importDrawing, PlotwrightError } from "../../../src/index.js";
import { printableJson, sizeInWords, textOfBytes } from "../../../src/internal.js";
import { ENDED_STATES, type Job, type PlotSettings } from "../../../src/schema/index.js";
import { withLayerPens, withOnlyLayers, type PenChoice } from "../../planning/layers-by-name.js";
import { readBytes } from "../../planning/read-drawing.js";
import { mustBeReadable, nameOf, withDrawingFile } from "../files.js";
import { minutes, printed, row, type CliIo } from "../io.js";
import { addJson, addLayerOptions, copies, type Declare } from "../options.js";
import {
  accessOf,
  addJob,
  addServer,
  fontUnknownTo,
  serverState,
  type ServerState,
} from "./server-client.js";
import { serverClient, type ServerAccess, type ServerClient } from "../../../host/handle/server-client.js";
import { machinesOf, plotterOf, storedOf } from "./served-plotter.js";
import { addSettingOptions, settingsOver, type OptionValues } from "../settings-options.js";

type Options = Partial<ServerAccess> & { readonly data?: string; readonly json?: boolean };

interface AddOptions extends Options {
  readonly only?: readonly string[];
  readonly pen?: readonly PenChoice[];
  readonly font?: string;
  readonly copies: number;
  readonly plotter?: string;
  readonly start?: boolean;
  readonly quiet?: boolean;
}

export const declareAdd: Declare = (command, { io }) => {
  addLayerOptions(addServer(addSettingOptions(command.argument("<files...>", "drawings; - for stdin"))))
    .option("--copies <number>", "number of times to plot each", copies, 1)
    .option("--plotter <name>", "which of the server's plotters, by name or id (default: its first one)")
    .option("--font <file>", "not here: make lines of text first, with plotwright plan --font --svg")
    .option("--start", "start the first one, if nothing else is plotting")
    .option("--quiet", "print nothing but errors")
    .option("--json", "print the jobs as JSON, one line for each")
    .action(async (files: string[], options: AddOptions & OptionValues) => {
      const access = accessOf(options);
      if (options.font !== undefined) throw fontUnknownTo(access.url);
      const state = await serverState(access);
      const plotter = plotterOf(state.plotters, options.plotter);
      const base = settingsOver(options, storedOf(state, plotter), machinesOf(state)).settings;
      mustBeReadable(files);
      for (const [index, file] of files.entries()) {
        const { copies, only, pen } = options;
        const plotterId = options.plotter === undefined ? undefined : plotter?.id;
        const added = await addDrawing(access, base, file, { copies, only, pen, plotterId });
        const isStarted = index === 0 && options.start === true;
        const job = isStarted ? await startIfFree(serverClient(access), added, options, io) : added;
        if (options.json === true) io.out(`${printableJson(job)}\n`);
        if (options.json === true || options.quiet === true) continue;
        // The server says first that it plots on the plotter's machine, not on the one that was named.
        if (job.settings.machine !== base.machine) io.err(printed`note: ${job.warnings[0] ?? ""}\n`);
        io.out(row(job.id, job.name, timeOf(job), ...plotterNameOf(job, state)));
        if (job.stats) io.err(printed`${job.name}: ${sizeInWords(job.stats.size)}\n`);
      }
    });
};

/** Returns the job as it is afterwards: while another one is plotted, it waits in the queue. */
async function startIfFree({ jobs }: ServerClient, job: Job, { quiet }: AddOptions, io: CliIo): Promise<Job> {
  try {
    return await jobs.start(job.id);
  } catch (error) {
    const now = await jobs.get(job.id);
    // A queue that runs on by itself may have started it already.
    if (now.state !== "queued") return now;
    if (!(error instanceof PlotwrightError) || error.code !== "busy") throw error;
    if (quiet !== true) io.err(printed`note: ${job.name} waits in the queue: ${error.message}\n`);
    return now;
  }
}

interface AddedDrawing {
  /** Left out: the file's. */
  readonly name?: string;
  readonly only?: readonly string[] | undefined;
  readonly pen?: readonly PenChoice[] | undefined;
  readonly plotterId?: string | undefined;
  readonly copies?: number;
}

/** Adds a drawing to the server's queue, with its layers and pens chosen by name. Returns the first copy's job. */
export const addDrawing = (
  access: ServerAccess,
  base: PlotSettings,
  file: string,
  { name = nameOf(file), only, pen, ...job }: AddedDrawing,
): Promise<Job> =>
  withDrawingFile(file, async (path) => {
    const bytes = readBytes(path);
    const isByName = only !== undefined || pen !== undefined;
    const drawing = isByName ? await importDrawing(file, textOfBytes(bytes)) : null;
    const settings =
      drawing === null ? base : withLayerPens(drawing, withOnlyLayers(drawing, base, only), pen);
    return addJob(access, { name: basename(name), settings, ...job }, bytes);
  });

export const declareQueue: Declare = (command, { io }) => {
  addJson(addServer(command)).action(async (options: Options) => {
    const state = await serverState(accessOf(options));
    const waiting = state.jobs.filter((job) => !ENDED_STATES.some((ended) => ended === job.state));
    if (options.json === true) io.out(`${printableJson(waiting)}\n`);
    else if (waiting.length === 0) io.err("The queue is empty.\n");
    else waiting.forEach((job) => io.out(line(job, state)));
  });
};

const line = (job: Job, state: ServerState): string =>
  row(
    ...[job.id, job.state, `${Math.round(100 * job.progress)} %`, timeOf(job), job.name],
    ...plotterNameOf(job, state),
  );

/** One more column, if the server has several plotters. */
const plotterNameOf = ({ plotterId }: Job, { plotters }: ServerState): string[] =>
  plotters.length < 2 ? [] : [plotters.find(({ id }) => id === plotterId)?.name ?? plotterId];

/** The time left, or the whole time if it has not begun. */
const timeOf = ({ remainingS, expectedS, stats, state }: Job): string =>
  minutes(state === "queued" ? (expectedS ?? stats?.durationS ?? remainingS ?? 0) : (remainingS ?? 0));
