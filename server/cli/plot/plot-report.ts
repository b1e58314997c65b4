/** What `plotwright plot` prints of its progress: a line that changes on a terminal, lines elsewhere, or JSON. */
import type { PlotProgress } from "../../../host/plotter/plotter-port.js";
import { printableJson } from "../../../src/internal.js";
import type { PlotWait } from "../../../src/schema/index.js";
import { minutes, printed, type CliIo } from "../io.js";

/** How far a plot is. */
export type PlotAmounts = Pick<PlotProgress, "progress" | "elapsedS" | "remainingS">;

export interface PlotReport {
  begins(verb: "Plotting" | "Resuming" | "Following"): void;
  progress(progress: PlotAmounts): void;
  /** `wait`: the pen that the plot waits for, if it stopped by itself. */
  held(held: boolean, wait: PlotWait | null): void;
  ends(how: "done" | "cancelled" | "interrupted"): void;
}

export function plotReport(
  name: string,
  { quiet, json }: { readonly quiet?: boolean; readonly json?: boolean },
  io: CliIo,
): PlotReport {
  if (json === true) return jsonReport(name, io);
  return textReport(name, quiet === true ? SILENT : io.isTerminal ? statusLine(io) : progressLines(io), io);
}

/** How progress is shown. */
interface Meter {
  readonly isSilent?: boolean;
  show(progress: PlotAmounts): void;
  hide(): void;
}

const SILENT: Meter = { isSilent: true, show: () => undefined, hide: () => undefined };

/** While the plot is held, the line makes room for the user's Enter. */
const statusLine = (io: CliIo): Meter => ({
  show: (progress) => io.status(`${bar(progress.progress)} ${inWords(progress)}`),
  hide: () => io.status(""),
});

const BAR_LENGTH = 30;
function bar(progress: number): string {
  const done = Math.floor(BAR_LENGTH * progress);
  return "█".repeat(done) + "░".repeat(BAR_LENGTH - done);
}

const progressLines = (io: CliIo): Meter => ({
  show: everyFewSeconds((progress) => io.err(`${inWords(progress)}\n`)),
  hide: () => undefined,
});

const inWords = ({ progress, elapsedS, remainingS }: PlotAmounts): string =>
  `${Math.floor(100 * progress)} %  ${minutes(elapsedS)} so far, ${minutes(remainingS)} left`;

function textReport(name: string, meter: Meter, io: CliIo): PlotReport {
  let elapsedS = 0;
  let isHeld = false;
  const say = (text: string): void => {
    if (meter.isSilent !== true) io.err(text);
  };
  return {
    begins: (verb) => say(printed`${verb} ${name}.\n`),
    progress: (progress) => {
      elapsedS = progress.elapsedS;
      if (!isHeld) meter.show(progress);
    },
    held: (held) => {
      isHeld = held;
      if (held) meter.hide();
    },
    ends: (how) => {
      meter.hide();
      if (how === "done") say(printed`Done: ${name}, after ${minutes(elapsedS)}.\n`);
    },
  };
}

const EVENTS = { Plotting: "started", Resuming: "resumed", Following: "followed" } as const;

/** One line of JSON on standard output for each event. */
function jsonReport(name: string, io: CliIo): PlotReport {
  let last: PlotAmounts | null = null;
  const print = (event: string, more: object = {}): void => io.out(`${printableJson({ event, ...more })}\n`);
  const amounts = (): object => (last === null ? {} : amountsOf(last));
  const shown = everyFewSeconds((progress) => print("progress", amountsOf(progress)));
  return {
    begins: (verb) => print(EVENTS[verb], { name }),
    progress: (progress) => {
      last = progress;
      shown(progress);
    },
    held: (held, wait) =>
      print(held ? "held" : "continued", { ...amounts(), ...(wait === null ? {} : { wait }) }),
    ends: (how) => print(how, { name, ...amounts() }),
  };
}

const amountsOf = ({ progress, elapsedS, remainingS }: PlotAmounts): object => ({
  progress: rounded(progress, 1e4),
  elapsedS: rounded(elapsedS, 10),
  remainingS: rounded(remainingS, 10),
});
const rounded = (value: number, steps: number): number => Math.round(steps * value) / steps;

const OFTEN_MS = 10_000;
const LEAST_MS = 1_000;
const PART = 0.05;

/** Passes on progress every 10 s, or after 5 % of the plot if that is sooner, but at most once a second. */
function everyFewSeconds(show: (progress: PlotAmounts) => void): (progress: PlotAmounts) => void {
  let lastMs = performance.now();
  let lastPart = 0;
  return (progress) => {
    const passedMs = performance.now() - lastMs;
    const isDue = passedMs >= OFTEN_MS || (passedMs >= LEAST_MS && progress.progress - lastPart >= PART);
    if (!isDue) return;
    lastMs += passedMs;
    lastPart = progress.progress;
    show(progress);
  };
}
