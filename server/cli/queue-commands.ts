/** Commands to a running server's queue. */
import { InvalidArgumentError, Option, type Command } from "commander";
import { basename } from "node:path";
import { importDrawing, PlotwrightError, type Drawing } from "../../src/index.js";
import { printableJson, sizeInWords, textOfBytes } from "../../src/internal.js";
import { ENDED_STATES, machineProfileSchema, type Job, type PlotSettings } from "../../src/schema/index.js";
import type { StoredOfPlotter, WithMachine } from "../../host/plotter/settings-of-plotter.js";
import { withLayerPens, withOnlyLayers, type PenChoice } from "../planning/layers-by-name.js";
import { readBytes } from "../planning/read-drawing.js";
import { mustBeReadable, nameOf, withDrawingFile } from "./files.js";
import { printed } from "./io.js";
import { addData, addJson, addLayerOptions, copies, type Declare } from "./options.js";
import { minutes } from "./plan.js";
import { NOTHING_STORED } from "./stored-plotter.js";
import { addJob, DEFAULT_URL, serverState, type ServerAccess, type ServerState } from "./server-client.js";
import { addSettingOptions, settingsOver, type OptionValues } from "./settings-options.js";

interface AddOptions extends ServerAccess {
  readonly only?: readonly string[];
  readonly pen?: readonly PenChoice[];
  readonly copies: number;
  readonly plotter?: string;
  readonly quiet?: boolean;
}

export const declareAdd: Declare = (command, { io }) => {
  addLayerOptions(
    addData(addServer(addSettingOptions(command.argument("<files...>", "drawings; - for stdin")))),
  )
    .option("--copies <number>", "number of times to plot each", copies, 1)
    .option("--plotter <id>", "which of the server's plotters (default: its first one)")
    .option("--quiet", "print nothing but errors")
    .action(async (files: string[], options: AddOptions & OptionValues) => {
      const state = await serverState(options);
      const plotter = plotterOf(state, options.plotter);
      const base = settingsOver(options, storedOf(state, plotter), machinesOf(state)).settings;
      mustBeReadable(files);
      for (const file of files) {
        await withDrawingFile(file, async (path) => {
          const drawing = readBytes(path);
          const settings =
            (options.only ?? options.pen) === undefined
              ? base
              : withLayers(importDrawing(file, textOfBytes(drawing)), base, options);
          const wanted = {
            name: basename(nameOf(file)),
            settings,
            copies: options.copies,
            ...(options.plotter === undefined ? {} : { plotterId: options.plotter }),
          };
          const job = await addJob(options, wanted, drawing);
          const columns = [job.id, job.name, timeOf(job), ...plotterNameOf(job, state)];
          if (options.quiet === true) return;
          // The server says first that it plots on the plotter's machine, not on the one that was named.
          if (job.settings.machine !== settings.machine) io.err(printed`note: ${job.warnings[0] ?? ""}\n`);
          io.out(row(columns));
          if (job.stats) io.err(printed`${job.name}: ${sizeInWords(job.stats.size)}\n`);
        });
      }
    });
};

const withLayers = (drawing: Drawing, base: PlotSettings, { only, pen }: AddOptions): PlotSettings =>
  withLayerPens(drawing, withOnlyLayers(drawing, base, only), pen);

/** What the server has stored of a plotter. */
function storedOf(
  { plotterSettings, jobs }: ServerState,
  plotter: ServerState["plotters"][number] | undefined,
): StoredOfPlotter {
  if (plotter === undefined) return NOTHING_STORED;
  const [last] = jobs
    .filter((job) => job.plotterId === plotter.id && job.startedAt !== null)
    .sort((a, b) => (b.startedAt ?? "").localeCompare(a.startedAt ?? ""));
  return { machine: plotter.machine, own: plotterSettings[plotter.id], last: last?.settings };
}

/** Adds the profiles of the server's custom machines. */
const machinesOf =
  ({ machines }: ServerState): WithMachine =>
  (settings) => {
    const custom = machines.find(({ id, builtIn }) => id === settings.machine && !builtIn);
    if (custom === undefined || settings.customMachine?.id === custom.id) return settings;
    return { ...settings, customMachine: machineProfileSchema.parse(custom) };
  };

export const declareQueue: Declare = (command, { io }) => {
  addJson(addServer(command)).action(async (options: ServerAccess & { json?: boolean }) => {
    const state = await serverState(options);
    const waiting = state.jobs.filter((job) => !ENDED_STATES.some((ended) => ended === job.state));
    if (options.json === true) io.out(`${printableJson(waiting)}\n`);
    else if (waiting.length === 0) io.err("The queue is empty.\n");
    else waiting.forEach((job) => io.out(line(job, state)));
  });
};

const addServer = (command: Command): Command =>
  command
    .option("--url <url>", "address of the server", serverUrl, DEFAULT_URL)
    .addOption(new Option("--key <key>", "access key of a server on another computer").env("PLOTWRIGHT_KEY"));

function serverUrl(text: string): string {
  if (!/^https?:\/\//.test(text) || !URL.canParse(text)) {
    throw new InvalidArgumentError(`It must be an address such as ${DEFAULT_URL}.`);
  }
  return text;
}

/** The server's first plotter, or the one with that id. */
function plotterOf(
  { plotters }: ServerState,
  id: string | undefined,
): ServerState["plotters"][number] | undefined {
  const plotter = id === undefined ? plotters[0] : plotters.find((one) => one.id === id);
  if (id === undefined || plotter !== undefined) return plotter;
  throw new PlotwrightError(
    "bad-setting",
    `--plotter: the server has no plotter ${id}. It has ${plotters.map((one) => one.id).join(", ")}.`,
  );
}

const row = (columns: readonly string[]): string =>
  `${columns.map((column) => printed`${column}`).join("\t")}\n`;

const line = (job: Job, state: ServerState): string =>
  row([
    ...[job.id, job.state, `${Math.round(100 * job.progress)} %`, timeOf(job), job.name],
    ...plotterNameOf(job, state),
  ]);

/** One more column, if the server has several plotters. */
const plotterNameOf = ({ plotterId }: Job, { plotters }: ServerState): string[] =>
  plotters.length < 2 ? [] : [plotters.find(({ id }) => id === plotterId)?.name ?? plotterId];

/** The time left, or the whole time if it has not begun. */
const timeOf = ({ remainingS, expectedS, stats, state }: Job): string =>
  minutes(state === "queued" ? (expectedS ?? stats?.durationS ?? remainingS ?? 0) : (remainingS ?? 0));
