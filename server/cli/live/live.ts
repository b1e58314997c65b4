/**
 * `plotwright live`: draws points from stdin as they come. At the end of the input the rest is drawn, and the carriage goes
 * home; at Ctrl-C at once. When the process must end (SIGTERM, its terminal is closed), the pen lifts where it is. The next
 * `plotwright live` then first draws what was left, also after a crash. If a server has the plotter, the server draws.
 */
import { readFileSync } from "node:fs";
import { PlotwrightError } from "../../../src/index.js";
import { machineOf } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { isOtherBoard } from "../../../host/plotter/board-id.js";
import { stopped } from "../../../host/handle/current-plot.js";
import { endedOtherwise, LiveSender } from "../../../host/handle/live-sender.js";
import { liveSocket } from "../../../host/handle/live-socket.js";
import { drawLine } from "../../../host/plotter/live-lines.js";
import { LIFT_AFTER_MS, livePlanner, LiveStrokes } from "../../../host/plotter/live-strokes.js";
import type { PlotStart, PlotterPort, RunningPlot } from "../../../host/plotter/plotter-port.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { settingsOfOwnPlotter, withPortByName } from "../client/known-plotters.js";
import { openSocket } from "../../plotter/node-parts.js";
import { servedPlotter, type ServedPlotter } from "../client/served-plotter.js";
import { withPlotter } from "../hand-commands.js";
import { printed, type CliIo } from "../io.js";
import { addData, addDevice, milliseconds, type Declare, type DeviceOptions } from "../options.js";
import { journalIn } from "../plot/plot.js";
import { PlotRecord, type InterruptedPlot } from "../plot/plot-record.js";
import { CANCELLED, cancelled } from "../plot/plot-watch.js";
import { addSettingOptions, type OptionValues } from "../settings-options.js";

interface LiveCommandOptions extends DeviceOptions {
  readonly liftAfterMs: number;
  readonly restart?: boolean;
  readonly quiet?: boolean;
  readonly data?: string;
}

const NAME = "live drawing";

export const declareLive: Declare = (command, { io, setExitCode }) => {
  addData(addDevice(addSettingOptions(command, ["machine", "pen", "motion"])))
    .option(
      "--lift-after-ms <number>",
      "time that the pen rests on the line when points are late",
      milliseconds,
      LIFT_AFTER_MS,
    )
    .option("--restart", "discard what an interrupted live drawing has left")
    .option("--quiet", "print nothing but errors")
    .action(async (given: LiveCommandOptions & OptionValues) => {
      const served = await servedPlotter(given);
      if (served !== null) {
        setExitCode(await drawOnServer(served, given, io));
        return;
      }
      const options = await withPortByName(given);
      const { settings, note } = await settingsOfOwnPlotter(options);
      if (note !== null && options.quiet !== true) io.err(printed`note: ${note}\n`);
      setExitCode(await drawLive(settings, options, io));
    });
};

async function drawLive(settings: PlotSettings, options: LiveCommandOptions, io: CliIo): Promise<number> {
  const record = new PlotRecord(options.data ?? defaultDataDir(), options.device, "live");
  const found = options.restart === true ? null : record.find();
  return withPlotter(options, settings, async (plotter) => {
    const source = new LiveStrokes(machineOf(settings), options.liftAfterMs);
    const left = found !== null && isStillThere(found, plotter) ? found : null;
    if (found !== null && left === null) {
      io.err(
        "What the last live drawing left is discarded, because the board has lost its position. Home is where it is now.\n",
      );
    }
    if (left !== null) readAgain(record, source);
    if (left === null) record.begin(null, { name: NAME, settings, only: undefined });
    else record.takeOver({ name: NAME, settings, only: undefined });
    const run = await begin(plotter, settings, { source, left, record }, io);
    if (options.quiet !== true) {
      if (left !== null) io.err("The last live drawing was interrupted: what it left is drawn first.\n");
      io.err("Drawing live: one point on each line, in mm from home. A line with up lifts the pen.\n");
    }
    return follow(run, source, record, io);
  });
}

/** Whether this is the board that was drawing, and it still knows where it is. */
function isStillThere({ stopped: { board } }: InterruptedPlot, plotter: PlotterPort): boolean {
  const now = plotter.snapshot();
  return now.xMm !== null && !(board !== undefined && isOtherBoard(board, now));
}

interface LiveCourse {
  readonly source: LiveStrokes;
  readonly left: InterruptedPlot | null;
  readonly record: PlotRecord;
}

function begin(
  plotter: PlotterPort,
  settings: PlotSettings,
  { source, left, record }: LiveCourse,
  io: CliIo,
): Promise<RunningPlot> | RunningPlot {
  const start: PlotStart = {
    live: source,
    journal: journalIn(record, () => 0, io),
    noted: (message) => io.err(printed`${message}\n`),
    ...(left && { from: left.from, ...left.stopped, held: false }),
  };
  return plotter.plot(livePlanner(source), settings, start);
}

/** Until everything is drawn, or the process must end. Returns the exit code. */
async function follow(run: RunningPlot, source: LiveStrokes, record: PlotRecord, io: CliIo): Promise<number> {
  let isInterrupted = false;
  const forget = io.onInterrupt((isFinal) => {
    isInterrupted ||= isFinal;
    void (isFinal ? run.interrupt() : run.cancel()).catch(() => undefined);
  });
  const fail = (error: unknown): void =>
    source.fail(error instanceof Error ? error : new Error(String(error)));
  run.finished.then(({ kind }) => kind === "done" || fail(stopped()), fail);
  const end = new AbortController();
  try {
    const reading = read(source, (line) => record.append(`${line}\n`), io, end.signal);
    reading.catch(() => run.cancel().catch(() => undefined));
    const { kind } = await run.finished;
    end.abort();
    const exitCode = await reading;
    if (isInterrupted) {
      io.err("plotwright: interrupted, the pen is up. The next plotwright live draws what is left.\n");
      return CANCELLED;
    }
    record.end();
    return kind === "done" ? exitCode : cancelled(io);
  } finally {
    end.abort();
    forget();
  }
}

/** Adds the lines of stdin. A line that can't be drawn is named and left out. `keep` stores one. Returns the exit code. */
async function read(
  source: LiveStrokes | LiveSender,
  keep: (line: string) => void,
  io: CliIo,
  end: AbortSignal,
): Promise<number> {
  let number = 0;
  let exitCode = 0;
  for await (const line of io.inputLines(end)) {
    number++;
    try {
      drawLine(line, source);
      keep(line);
      await source.room();
    } catch (error) {
      if (source.hasFailed) return CANCELLED;
      if (!(error instanceof PlotwrightError)) throw error;
      io.err(printed`line ${number}: ${error.message}\n`);
      exitCode = 3;
    }
  }
  source.end();
  return exitCode;
}

/** What an interrupted live drawing was given. */
function readAgain(record: PlotRecord, source: LiveStrokes): void {
  for (const line of readFileSync(record.drawingPath, "utf8").split("\n").slice(0, -1))
    drawLine(line, source);
  source.penUp();
}

/** A server that has the plotter draws: as a job, which is paused if this process must end. */
async function drawOnServer(
  { access, client, plotter, settings: { settings, note } }: ServedPlotter,
  { liftAfterMs, quiet }: LiveCommandOptions,
  io: CliIo,
): Promise<number> {
  const socket = liveSocket(openSocket, access.url, plotter.id, access.key);
  const sender = await LiveSender.begin(socket, { name: NAME, settings, liftAfterMs });
  const { id } = sender.job;
  if (quiet !== true) {
    if (note !== null) io.err(printed`note: ${note}\n`);
    io.err(printed`Drawing live on ${plotter.name}: one point on each line, in mm from home.\n`);
  }
  let isInterrupted = false;
  const forget = io.onInterrupt((isFinal) => {
    isInterrupted ||= isFinal;
    if (isFinal) sender.close();
    else void client.jobs.cancel(id).catch(() => undefined);
  });
  const end = new AbortController();
  try {
    const reading = read(sender, () => undefined, io, end.signal);
    reading.catch(() => sender.close());
    const { state, message } = await sender.ended.finally(() => end.abort());
    const exitCode = await reading;
    if (state === "done") return exitCode;
    if (state === "cancelled") return cancelled(io);
    throw endedOtherwise(state, message);
  } catch (error) {
    if (!isInterrupted) throw error;
    io.err("plotwright: interrupted, the pen is up. The job waits on the server.\n");
    return CANCELLED;
  } finally {
    end.abort();
    forget();
  }
}
