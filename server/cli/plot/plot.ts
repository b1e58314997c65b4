/**
 * `plotwright plot FILE…`: plots on the server that has the plotter (plot-on-server.ts), or else without one. The first
 * Ctrl-C pauses (Enter resumes), a second one cancels: the pen lifts and the carriage goes home. Without a keyboard to
 * resume with, the first one cancels. When the process must end (SIGTERM, or its terminal is closed), the pen lifts, and
 * the plot can be resumed.
 */
import { basename } from "node:path";
import { importDrawing, PlotwrightError } from "../../../src/index.js";
import { findsHome, firmwareAdvice, HEIGHT_AGAIN, machineOf, sizeInWords } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { fileFault } from "../../storage/file-fault.js";
import type { OpenPlanner } from "../../../host/planning/open-planner.js";
import { sheetsOf } from "../../../host/queue/job-words.js";
import { PenStops } from "../../../host/plotter/pen-stops.js";
import { openPlanner } from "../../planning/planner.js";
import { withLayerPens, type PenChoice } from "../../planning/layers-by-name.js";
import { readDrawing } from "../../planning/read-drawing.js";
import { OWN_PLANNING_LIMITS } from "../../planning/planning-limits.js";
import { isOtherBoard } from "../../../host/plotter/board-id.js";
import type { JournalEntry, PlotStart, PlotterPort } from "../../../host/plotter/plotter-port.js";
import { mustBeReadable, nameOf, withDrawingFile } from "../files.js";
import { printed, type CliIo } from "../io.js";
import { withPlotter } from "../hand-commands.js";
import {
  type DeviceOptions,
  addData,
  addDevice,
  addFont,
  addLayerOptions,
  copiesOrEndless,
  seconds,
  type Declare,
} from "../options.js";
import { PlotRecord, type InterruptedPlot } from "./plot-record.js";
import { plotOnServer } from "./plot-on-server.js";
import { plotReport } from "./plot-report.js";
import { CANCELLED, cancelled, waitForPaper, watch } from "./plot-watch.js";
import type { Command, Option } from "commander";
import { fontUnknownTo } from "../client/server-client.js";
import { servedPlotter } from "../client/served-plotter.js";
import { addSettingOptions, type OptionValues } from "../settings-options.js";
import { settingsOfOwnPlotter, withPortByName } from "../client/known-plotters.js";

export interface PlotCommandOptions extends DeviceOptions {
  readonly only?: readonly string[];
  readonly pen?: readonly PenChoice[];
  readonly font?: string;
  readonly copies: number;
  readonly paperS?: number;
  readonly resume?: boolean;
  readonly restart?: boolean;
  readonly quiet?: boolean;
  readonly json?: boolean;
  readonly data?: string;
}

interface Plot {
  readonly name: string;
  readonly path: string;
  readonly settings: PlotSettings;
  readonly only: readonly string[] | undefined;
  readonly font: string | undefined;
  readonly from: InterruptedPlot["from"] | null;
  readonly stopped: InterruptedPlot["stopped"];
  /** Before it begins, 0 … 1. */
  readonly progress: number;
}

/** What is plotted on one sheet of paper. */
interface PaperSheet {
  /** With the number of the sheet, if its drawing is spread over several. */
  readonly name: string;
  readonly file: string;
  readonly settings: PlotSettings;
}

/** What a plot on the plotter needs besides its drawing. */
interface Course {
  /** Stores that the plot begins or resumes. */
  readonly begin: () => void;
  readonly record: PlotRecord;
  /** Aborted when the process must end. */
  readonly end: AbortSignal;
  /** Called when the pen is at rest for good. The plotter is closed after that, and Ctrl-C no longer concerns this plot. */
  readonly over?: () => void;
}

/** Plots the drawings one after the other. Returns the exit code: that of the first plot which does not end normally. */
async function plotInTurn(
  files: readonly string[],
  settings: PlotSettings,
  options: PlotCommandOptions,
  io: CliIo,
  plot: (sheet: PaperSheet, end: AbortSignal, over: () => void) => Promise<number>,
): Promise<number> {
  const { copies } = options;
  if (files.length === 0)
    throw new PlotwrightError("bad-setting", "No drawing was given. Use plotwright plot FILE.svg.");
  const sheets = files.map((file) =>
    sheetsOf(nameOf(file), settings).map((sheet): PaperSheet => ({ ...sheet, file })),
  );
  const isSingle = copies === 1 && sheets.flat().length === 1;
  if (!isSingle && options.paperS === undefined && !io.hasKeyboard) {
    throw new PlotwrightError(
      "bad-setting",
      "Between two plots it waits for Enter, so that the paper can be changed. Without a keyboard, use --paper-s SECONDS to set the wait.",
    );
  }
  mustBeReadable(files);
  if (copies === 0 && options.quiet !== true)
    io.err("Endless copies: to stop, press Ctrl-C twice, or once between two plots.\n");
  return untilEnd(io, async (end) => {
    let isBetween = false;
    let isStopped = false;
    const forget = io.onInterrupt(() => (isStopped ||= isBetween));
    try {
      for (const sheet of copiesInTurn(sheets, copies)) {
        if (isBetween && (end.aborted || isStopped || !(await waitForPaper(sheet.name, options, io))))
          return cancelled(io);
        isBetween = false;
        const code = await plot(sheet, end, () => (isBetween = true));
        if (code !== 0) return code;
        isBetween = true;
      }
    } finally {
      forget();
    }
    return 0;
  });
}

/** All sheets of each file as often as asked; without an end, all files over and over. */
function* copiesInTurn(files: readonly (readonly PaperSheet[])[], copies: number): Generator<PaperSheet> {
  while (copies === 0) yield* files.flat();
  for (const sheets of files) for (let copy = 0; copy < copies; copy++) yield* sheets;
}

/** Without a server. Returns the exit code: 0, or 5 when it was cancelled or interrupted. Failures are thrown. */
export async function runPlot(
  files: readonly string[],
  given: PlotSettings,
  options: PlotCommandOptions,
  io: CliIo,
): Promise<number> {
  const record = new PlotRecord(options.data ?? defaultDataDir(), options.device);
  mustHaveEnded(record, options);
  return plotInTurn(files, given, options, io, ({ file, name, settings }, end, over) =>
    withDrawingFile(file, async (path) => {
      const { only, pen, font } = options;
      const plot: Plot = {
        name: basename(name),
        path,
        settings:
          pen === undefined
            ? settings
            : withLayerPens(await importDrawing("", readDrawing(path)), settings, pen),
        only,
        font,
        from: null,
        stopped: {},
        progress: 0,
      };
      return plotOne(plot, { begin: () => record.begin(path, plot, font), record, end, over }, options, io);
    }),
  );
}

/**
 * Listens to the signals that end the process until everything is stored. No second one, as at the end of an ssh
 * session, may end it before.
 */
async function untilEnd(io: CliIo, use: (end: AbortSignal) => Promise<number>): Promise<number> {
  const end = new AbortController();
  const forget = io.onInterrupt((isFinal) => isFinal && end.abort());
  try {
    return await use(end.signal);
  } finally {
    forget();
  }
}

/** Resumes an interrupted plot: where it stopped, or after a crash from at most half a second before. */
export async function resumePlot(
  files: readonly string[],
  options: PlotCommandOptions,
  io: CliIo,
): Promise<number> {
  if (files.length > 0) {
    throw new PlotwrightError(
      "bad-setting",
      "--resume continues the drawing that was begun, so give no file.",
    );
  }
  const record = new PlotRecord(options.data ?? defaultDataDir(), options.device);
  const found = record.mustFind();
  const plot: Plot = { ...found, path: record.drawingPath, font: record.fontPath };
  return untilEnd(io, (end) =>
    plotOne(plot, { begin: () => record.takeOver(found), record, end }, options, io),
  );
}

/** Refuses a new plot after an interrupted one: the carriage is in the middle of that drawing, so it is rarely intended. */
function mustHaveEnded(record: PlotRecord, { restart }: PlotCommandOptions): void {
  const found = record.find();
  if (found === null || restart === true) return;
  throw new PlotwrightError(
    "conflict",
    `${wasInterrupted(found)} Use plotwright plot --resume to resume it, or add --restart to discard it and plot from the beginning.`,
  );
}

async function plotOne(plot: Plot, course: Course, options: PlotCommandOptions, io: CliIo): Promise<number> {
  const { path, settings, only, font } = plot;
  const say = options.quiet === true ? () => undefined : (text: string) => io.err(text);
  const opening = new AbortController();
  let isOpen = false;
  let isInterrupted = false;
  const forget = io.onInterrupt(() => {
    isInterrupted = true;
    if (!isOpen) opening.abort();
  });
  try {
    const planner = await openPlanner(
      { path, settings, machine: machineOf(settings), only, font, limits: OWN_PLANNING_LIMITS },
      opening.signal,
    );
    try {
      if (!io.hasKeyboard) mustNotWaitForPen(planner, plot);
      planner.warnings.forEach((warning) => say(printed`note: ${warning}\n`));
      return await withPlotter(options, settings, (plotter) => {
        // Ctrl-C while the board was being connected.
        if (isInterrupted) throw new PlotwrightError("cancelled", "The plot was cancelled.");
        isOpen = true;
        const advice = firmwareAdvice(machineOf(settings), plotter.snapshot());
        if (advice !== null) say(printed`note: ${advice}\n`);
        say(printed`${plot.name}: ${sizeInWords(planner.size)}\n`);
        return onPlotter(plotter, planner, plot, course, () => isInterrupted, options, io);
      });
    } finally {
      await planner.close();
    }
  } catch (error) {
    if (error instanceof PlotwrightError && error.code === "cancelled" && opening.signal.aborted) {
      return course.end.aborted ? interrupted(course.record, io) : cancelled(io);
    }
    throw error;
  } finally {
    forget();
  }
}

/** Refuses a plot that would wait for another pen. Without a keyboard it would wait endlessly. */
function mustNotWaitForPen({ strokes }: OpenPlanner, { settings, from }: Plot): void {
  const stops = new PenStops(strokes, settings, from);
  const next = stops.nextAfter(from);
  const wait = stops.due(from) ?? (next === null ? null : stops.due({ stroke: next, alongMm: 0 }));
  if (wait === null) return;
  const how =
    from === null
      ? 'plot its layers one by one with --only, or switch the stops off with "penStops": "never" in a file for --config, or plotwright settings set penStops never'
      : "the plot can't be resumed: run it in a terminal";
  throw new PlotwrightError(
    "bad-setting",
    `Before "${wait.layerName}" the plot waits for Enter, so that the pen can be changed. Without a keyboard, ${how}.`,
  );
}

async function onPlotter(
  plotter: PlotterPort,
  planner: OpenPlanner,
  { name, settings, from, stopped, progress: before }: Plot,
  { begin, record, end, over }: Course,
  isInterrupted: () => boolean,
  options: PlotCommandOptions,
  io: CliIo,
): Promise<number> {
  const found = plotter.snapshot();
  const isOther = stopped.board !== undefined && isOtherBoard(stopped.board, found);
  const position = isOther ? "other" : found.xMm === null ? "lost" : "known";
  if (from !== null && found.heightUnsure && !io.hasKeyboard) throw unsureHeight();
  let progress = before;
  begin();
  const journal = journalIn(record, () => progress, io);
  // A resumed plot waits for the user, unless there is no keyboard to start it with.
  const held = from !== null && io.hasKeyboard;
  const noted = (message: string): void => io.err(printed`${message}\n`);
  const start: PlotStart = { from, ...stopped, journal, noted, held };
  const run = await plotter.plot(planner, settings, start);
  run.onProgress((now) => (progress = now.progress));
  const homes = findsHome(machineOf(settings));
  const resumed =
    from === null ? null : ({ position, findsHome: homes, heightUnsure: found.heightUnsure } as const);
  const report = plotReport(name, options, io);
  const endWords = "Interrupted: the pen lifts.";
  const watched = { report, resumed, isInterrupted: isInterrupted(), end, endWords };
  const ended = await watch(run, watched, io);
  over?.();
  // The motors stay on, so that the carriage stays where the plot is to be resumed.
  if (ended === "interrupted") return interrupted(record, io);
  try {
    await plotter.motorsOff();
  } finally {
    record.end();
  }
  return ended === "done" ? 0 : cancelled(io);
}

/** Nobody can say that the pen is at its height. */
const unsureHeight = (): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `The plotter does not know the height of its pen, so the plot can't be resumed without a keyboard. Run it in a terminal, and ${HEIGHT_AGAIN}.`,
  );

/** The process must end. Says whether the plot can be resumed. */
function interrupted(record: PlotRecord, io: CliIo): number {
  const found = record.find();
  if (found === null) return cancelled(io);
  io.err(printed`plotwright: ${wasInterrupted(found)} Use plotwright plot --resume to resume it.\n`);
  return CANCELLED;
}

const wasInterrupted = ({ name, progress }: InterruptedPlot): string =>
  `The plot of ${name} was interrupted at ${Math.round(100 * progress)} %.`;

/** A full disk must not stop the pen in mid-stroke: each entry is tried, as the disk may soon have room again. */
export function journalIn(
  record: PlotRecord,
  progress: () => number,
  io: CliIo,
): NonNullable<PlotStart["journal"]> {
  let isReported = false;
  return {
    record: (entry: JournalEntry) => {
      try {
        record.save(entry, progress());
      } catch (error) {
        if (!isReported) io.err(printed`${notStored(error)}\n`);
        isReported = true;
      }
    },
  };
}

const notStored = (cause: unknown): string =>
  `The progress can't be stored: ${fileFault(cause)}. The plot continues, but if it is interrupted, it resumes from an earlier place or not at all.`;

export const declarePlot: Declare = (command, { io, setExitCode }) => {
  addData(
    addDevice(
      addFont(
        addLayerOptions(
          addSettingOptions(command.argument("[files...]", "drawings, one after the other; - for stdin")),
        ),
      ),
    ),
  )
    .option("--copies <number>", "number of times to plot each; 0: endless, in turn", copiesOrEndless, 1)
    .option(
      "--paper-s <seconds>",
      "time to wait for new paper between two plots, instead of waiting for Enter",
      seconds,
    )
    .option("--resume", "resume a plot that was interrupted")
    .option("--restart", "discard an interrupted plot and start from the beginning")
    .option("--quiet", "print nothing but errors")
    .option("--json", "print progress and stops as JSON, one line for each")
    .action(async (files: string[], given: PlotCommandOptions & OptionValues) => {
      if (given.resume === true) {
        mustFitResume(command);
        setExitCode(await resumePlot(files, await withPortByName(given), io));
        return;
      }
      const served = await servedPlotter(given);
      if (served !== null && given.font !== undefined) throw fontUnknownTo(served.access.url);
      const options = served === null ? await withPortByName(given) : given;
      const { settings, note } = served?.settings ?? (await settingsOfOwnPlotter(options));
      if (note !== null && options.quiet !== true) io.err(printed`note: ${note}\n`);
      setExitCode(
        served === null
          ? await runPlot(files, settings, options, io)
          : await plotInTurn(files, settings, options, io, (sheet, end) =>
              plotOnServer(sheet, served, end, options, io),
            ),
      );
    });
};

/** The other options belong to a new plot, and would have no effect. */
const WITH_RESUME = ["--resume", "--device", "--virtual-speed", "--data", "--quiet", "--json"];

function mustFitResume(command: Command): void {
  const other = command.options.find(
    (option) => isGiven(command, option) && !WITH_RESUME.includes(option.long ?? ""),
  );
  if (other === undefined) return;
  throw new PlotwrightError(
    "bad-setting",
    `--resume continues with the settings of the plot that was begun, so leave out ${other.long ?? other.flags}.`,
  );
}

/** `--fit` and `--no-fit` set the same value: only the value tells which of them was given. */
function isGiven(command: Command, option: Option): boolean {
  const name = option.attributeName();
  const isNegated = command.getOptionValue(name) === false;
  return command.getOptionValueSource(name) === "cli" && option.negate === isNegated;
}
