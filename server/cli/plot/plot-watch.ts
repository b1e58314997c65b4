/** Progress of a running plot, and the keys that control it. */
import { OTHER_BOARD } from "../../../host/plotter/board-id.js";
import { heightWords } from "../../../host/queue/job-words.js";
import { homeAgain } from "../../../src/internal.js";
import type { PlotControl } from "../../../host/plotter/plotter-port.js";
import type { PlotWait } from "../../../src/schema/index.js";
import { printed, type CliIo } from "../io.js";
import type { PlotAmounts, PlotReport } from "./plot-report.js";

/** A plot of this process, or a job of a server. */
export interface WatchedPlot extends Omit<PlotControl, "onProgress"> {
  onProgress(listener: (progress: PlotAmounts) => void): void;
}

interface Watched {
  readonly report: PlotReport;
  /** Resumed after an interruption: whether the board still knows the position, or is another board, and the height. */
  readonly resumed: {
    readonly position: keyof typeof POSITIONS;
    readonly findsHome: boolean;
    readonly heightUnsure: boolean;
  } | null;
  /** Ctrl-C was pressed while the plot was being started. */
  readonly isInterrupted: boolean;
  /** Aborted when the process must end: the plot is then interrupted. */
  readonly end: AbortSignal;
  /** What happens to the plot when the process must end. */
  readonly endWords: string;
}

/** Runs until the plot ends. */
export async function watch(
  run: WatchedPlot,
  { report, resumed, isInterrupted, end, endWords }: Watched,
  io: CliIo,
): Promise<"done" | "cancelled" | "interrupted"> {
  const isHeld = resumed !== null && io.hasKeyboard;
  const control = new Control(run, io, isHeld);
  const mustEnd = (): void => control.mustEnd(endWords);
  end.addEventListener("abort", mustEnd);
  if (end.aborted) mustEnd();
  const forget = [
    io.onInterrupt((isFinal) => isFinal || control.interrupt()),
    io.onLine(() => control.resume()),
    () => end.removeEventListener("abort", mustEnd),
  ];
  run.onProgress((progress) => report.progress(progress));
  run.onHeld((held, wait = null) => {
    report.held(held, wait);
    if (wait !== null) control.waitsFor(wait);
    else if (held) control.paused();
    else control.continued();
  });
  report.begins(resumed === null ? "Plotting" : "Resuming");
  if (isHeld) {
    const words = POSITIONS[resumed.position](homeAgain(resumed.findsHome)) + heightWords(resumed);
    io.err(`${words} Enter resumes, Ctrl-C cancels.\n`);
  } else if (isInterrupted) control.interrupt();
  try {
    const outcome = await Promise.race([run.finished, control.failed]);
    const ended =
      outcome.kind === "done"
        ? "done"
        : control.isInterrupted
          ? ("interrupted" as const)
          : ("cancelled" as const);
    report.ends(ended);
    return ended;
  } finally {
    io.status("");
    forget.forEach((stop) => stop());
  }
}

const POSITIONS = {
  known: () => "The board still knows its position.",
  lost: (what: string) => `The board has lost its position: ${what}.`,
  other: (what: string) => `${OTHER_BOARD}: ${what}.`,
} as const;

/** False if it was cancelled meanwhile. */
export async function waitForPaper(
  name: string,
  { paperS: waitS, quiet }: { readonly paperS?: number; readonly quiet?: boolean },
  io: CliIo,
): Promise<boolean> {
  // The request for Enter is printed even if quiet: without it, the command would seem to hang.
  if (quiet !== true || waitS === undefined)
    io.err(printed`Next: ${name}. Change the paper${waitS === undefined ? ", then press Enter" : ""}.\n`);
  const forget: (() => void)[] = [];
  try {
    return await new Promise<boolean>((resolve) => {
      forget.push(io.onInterrupt(() => resolve(false)));
      if (waitS === undefined) forget.push(io.onLine(() => resolve(true)));
      else {
        const timer = setTimeout(() => resolve(true), 1_000 * waitS);
        forget.push(() => clearTimeout(timer));
      }
    });
  } finally {
    forget.forEach((stop) => stop());
  }
}

/** Exit code of a plot that was cancelled or interrupted. */
export const CANCELLED = 5;

export function cancelled(io: CliIo): number {
  io.err("plotwright: the plot was cancelled.\n");
  return CANCELLED;
}

/** The meaning of the user's keys, which depends on the state. */
class Control {
  private held: boolean;
  private cancelling = false;
  /** A pause was asked for, and the plot is not held yet. */
  private isPausing = false;
  isInterrupted = false;
  /** Rejects if a request fails. */
  readonly failed: Promise<never>;
  private fail: (error: unknown) => void = () => undefined;

  constructor(
    private readonly run: WatchedPlot,
    private readonly io: CliIo,
    isHeld: boolean,
  ) {
    this.held = isHeld;
    this.failed = new Promise((_resolve, reject) => (this.fail = reject));
    this.failed.catch(() => undefined);
  }

  interrupt(): void {
    if (this.isEnding) return;
    if (this.held || !this.io.hasKeyboard) {
      this.cancelling = true;
      this.io.err("Cancelling: the pen lifts and goes home.\n");
      this.run.cancel().catch(this.fail);
    } else {
      this.held = true;
      this.isPausing = true;
      this.io.err("Paused. Enter resumes, Ctrl-C again cancels.\n");
      this.run.pause().catch(this.fail);
    }
  }

  mustEnd(words: string): void {
    if (this.isEnding) return;
    this.isInterrupted = true;
    this.io.err(printed`${words}\n`);
    this.run.interrupt().catch(this.fail);
  }

  private get isEnding(): boolean {
    return this.cancelling || this.isInterrupted;
  }

  /** The plot is held: by the user's key, or by the button on the machine. */
  paused(): void {
    this.isPausing = false;
    if (this.held || this.isEnding) return;
    this.held = true;
    this.io.err(`Paused. ${this.io.hasKeyboard ? "Enter resumes, " : ""}Ctrl-C cancels.\n`);
  }

  /** A planned stop, for another pen. */
  waitsFor({ penName, layerName }: PlotWait): void {
    this.isPausing = false;
    if (this.isEnding) return;
    this.held = true;
    const what = penName === null ? `the pen for "${layerName}"` : `"${penName}" for "${layerName}"`;
    this.io.err(printed`Put in ${what}. ${this.io.hasKeyboard ? "Enter resumes, " : ""}Ctrl-C cancels.\n`);
  }

  /** The plot goes on, perhaps because somebody resumed it on the server's page: then Ctrl-C must pause again. */
  continued(): void {
    if (!this.held || this.isPausing || this.isEnding) return;
    this.held = false;
    this.io.err("Resumed.\n");
  }

  resume(): void {
    if (!this.held || this.isEnding) return;
    this.held = false;
    this.run.resume().catch(this.fail);
  }
}
