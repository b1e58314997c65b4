/** Commands to a running server's queue. */
import { Option, type Command } from "commander";
import { basename } from "node:path";
import { importDrawing } from "../../src/index.js";
import { textOfBytes } from "../../src/internal.js";
import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import { withOnlyLayers } from "../planning/only-layers.js";
import { readBytes } from "../planning/read-drawing.js";
import { nameOf, withDrawingFile } from "./files.js";
import { addData, addJson, copies, type Declare } from "./options.js";
import { minutes } from "./plan.js";
import { addJob, DEFAULT_URL, serverState, type ServerOptions } from "./server-client.js";
import { addSettingOptions, settingsFromOptions, type OptionValues } from "./settings-options.js";

interface AddOptions extends ServerOptions {
  readonly only?: readonly string[];
  readonly copies: number;
  readonly plotter?: string;
  readonly quiet?: boolean;
}

export const declareAdd: Declare = (command, { io }) => {
  addData(addServer(addSettingOptions(command.argument("<files...>", "drawings; - for stdin"))))
    .option("--only <layer...>", "draw these layers only, by name or id")
    .option("--copies <number>", "number of times to plot each", copies, 1)
    .option("--plotter <id>", "which of the server's plotters (default: its first one)")
    .option("--quiet", "print nothing but errors")
    .action(async (files: string[], options: AddOptions & OptionValues) => {
      const { plotters } = await serverState(options);
      const plotter = plotters.find(({ id }) => id === (options.plotter ?? plotters[0]?.id));
      // The plotter's own model, unless the user names one.
      const machine = (options["machine"] ?? options["machineFile"]) ? undefined : plotter?.machine;
      const base = settingsFromOptions(machine ? { ...options, machine } : options);
      for (const file of files) {
        const drawing = await withDrawingFile(file, (path) => Promise.resolve(readBytes(path)));
        const settings =
          options.only === undefined
            ? base
            : withOnlyLayers(importDrawing(file, textOfBytes(drawing)), base, options.only);
        const wanted = {
          name: basename(nameOf(file)),
          settings,
          copies: options.copies,
          ...(options.plotter === undefined ? {} : { plotterId: options.plotter }),
        };
        const job = await addJob(options, wanted, drawing);
        if (options.quiet !== true) io.out(`${job.id}\t${job.name}\t${timeOf(job)}\n`);
      }
    });
};

export const declareQueue: Declare = (command, { io }) => {
  addJson(addServer(command)).action(async (options: ServerOptions & { json?: boolean }) => {
    const { jobs } = await serverState(options);
    const waiting = jobs.filter((job) => !ENDED_STATES.some((state) => state === job.state));
    if (options.json === true) io.out(`${JSON.stringify(waiting)}\n`);
    else if (waiting.length === 0) io.err("The queue is empty.\n");
    else waiting.forEach((job) => io.out(`${line(job)}\n`));
  });
};

const addServer = (command: Command): Command =>
  command
    .option("--url <url>", "address of the server", DEFAULT_URL)
    .addOption(new Option("--key <key>", "access key of a server on another computer").env("PLOTWRIGHT_KEY"));

const line = (job: Job): string =>
  [job.id, job.state, `${Math.round(100 * job.progress)} %`, timeOf(job), job.name].join("\t");

/** The time left, or the whole time if it has not begun. */
const timeOf = ({ remainingS, expectedS, stats, state }: Job): string =>
  minutes(state === "queued" ? (expectedS ?? stats?.durationS ?? remainingS ?? 0) : (remainingS ?? 0));
