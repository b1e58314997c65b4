/**
 * One plotter, for programs that just want to draw: what `openPlotter` of the entry `plotwright/plotter` returns. It is
 * the same for a plotter of this program (own-plotter.ts) and for one of a running server (served-plotter.ts).
 */
import { PAPER_SIZES, PlotwrightError, type Line } from "../../src/index.js";
import { orientedPaper, withGiven, type PaperName, type PaperSize } from "../../src/internal.js";
import {
  givenSettingsSchema,
  MAX_LIFT_AFTER_MS,
  type GivenSettings,
  type LiveUndone,
  type Plotter,
  type PlotSettings,
  type PlotWait,
} from "../../src/schema/index.js";
import { LIFT_AFTER_MS, type LivePoints } from "../plotter/live-strokes.js";
import { parseWith } from "../parse-with.js";

/** How far a plot is. */
export interface PlotAmount {
  /** Share of the plot's time, 0 … 1. */
  readonly progress: number;
  readonly elapsedS: number;
  readonly remainingS: number;
}

/** The state of a plotter: as the page shows it, and the plot that this program started. */
export interface HandleState extends Pick<
  Plotter,
  "kind" | "connection" | "activity" | "firmware" | "message" | "penUp" | "xMm" | "yMm"
> {
  /** Null: this program has started no plot, or it has ended. */
  readonly plot: PlotAmount | null;
  /** The pen that the plot waits for; null: it does not wait for one. */
  readonly wait: PlotWait | null;
}

/** Settings of a plot, all optional: those that are left out are the plotter's. */
export interface PlotOptions extends GivenSettings {
  /** "A4", or a size in mm in portrait. `prepare.landscape` turns it. */
  readonly paper?: PaperName | PaperSize;
  /** How fast the pen draws, mm/s. */
  readonly speed?: number;
  /** The name of a job on a server. Default "drawing". */
  readonly name?: string;
  /** Called several times a second. What it throws stops the plot, which then rejects with it; so does `onPenChange`. */
  readonly onProgress?: (amount: PlotAmount) => void;
  /**
   * Called when the plot waits for another pen, with the pen up at home. The plot resumes when the returned promise
   * resolves, and ends if it rejects. Default: it waits for `resume`.
   */
  readonly onPenChange?: (wait: PlotWait) => void | Promise<void>;
  /** Stops the plot when aborted, also before it moves: the pen lifts, and the carriage goes home. */
  readonly signal?: AbortSignal;
}

/** A plot that has ended. */
export interface PlotResult {
  /** Without the time in which it was paused. */
  readonly plottedS: number;
  /** Parts of the file that are not drawn, and settings that the machine does not use. Plain text. */
  readonly warnings: readonly string[];
}

/** Settings of a live drawing, all optional. */
export interface LiveOptions extends Omit<PlotOptions, "onPenChange" | "onProgress" | "prepare"> {
  /** When points are late, the pen rests on the line for this time, ms, before it is lifted. Default 300. */
  readonly liftAfterMs?: number;
}

/**
 * A drawing that is drawn while it is made. Points are in mm from home, which is the corner of the paper. What is added is
 * drawn as soon as possible; the promises of `stroke` and `lineTo` resolve when there is room for more. When the drawing is
 * stopped or fails, all methods reject with the reason.
 */
export interface LiveDrawing {
  /** Adds a whole stroke: [[x, y], …], or x, y, x, y … in a typed array. A stroke that grows is complete. */
  stroke(points: LivePoints): Promise<void>;
  /** Adds a point to the stroke that grows, or begins one. The pen stays on the paper until `penUp` or the next stroke. */
  lineTo(x: number, y: number): Promise<void>;
  /** The stroke that grows is complete. */
  penUp(): void;
  /** Takes back the last stroke, as far as it is not yet sent to the motors. What is left of it is complete. */
  undo(): Promise<LiveUndone>;
  /** Resolves when everything so far is drawn. */
  idle(): Promise<void>;
  /** The drawing is complete: draws the rest and goes home. Resolves when the carriage is there. */
  end(): Promise<PlotResult>;
}

/** A plotter that this program has opened. All methods reject with a PlotwrightError. */
export interface PlotterHandle {
  readonly state: HandleState;
  /** Calls `listener` after each change of `state`. The returned function ends that. What it throws stops the plot. */
  onChange(listener: (state: HandleState) => void): () => void;
  /**
   * Plots a drawing: the text of an SVG, DXF, HPGL or JSON file, or lines of points in mm on the paper. Resolves when
   * the pen is up and the carriage is home again.
   *
   * @throws PlotwrightError "cancelled" after `stop` or the signal; "bad-file", "bad-setting" and "out-of-bounds" before
   * anything moves; "no-board", "busy"; "board-error", "board-timeout" or "disconnected" if the plot fails
   */
  plot(drawing: string | readonly Line[], options?: PlotOptions): Promise<PlotResult>;
  /**
   * Draws while the strokes are still being made. Resolves when the plotter waits for them. `pause`, `resume` and `stop`
   * apply to it as to a plot. Only for plotters with an EiBotBoard.
   *
   * @throws PlotwrightError as `plot`
   */
  live(options?: LiveOptions): Promise<LiveDrawing>;
  /** Slows down along the line and lifts the pen. Resolves when it is up. */
  pause(): Promise<void>;
  resume(): Promise<void>;
  /** Ends the plot: the pen lifts, and the carriage goes home. Resolves when the plot has ended. */
  stop(): Promise<void>;
  /** Lifts or lowers the pen, or moves it to a height in percent of its range. */
  pen(where: "up" | "down" | number): Promise<void>;
  /** Moves to a position in mm from home, with the pen up. */
  moveTo(xMm: number, yMm: number): Promise<void>;
  /** Moves home with the pen up; a machine with limit switches finds home with them. */
  home(): Promise<void>;
  /**
   * Closes the connection. A plot of this program is stopped at once, with the pen up. One of a server continues; a live
   * one is paused there, with the pen up.
   */
  close(): Promise<void>;
}

/** Which plotter to open: exactly one of the first four. */
export interface PlotterChoice {
  /** The path of a serial port, or "auto": the first board of the machine's controller. Only outside browsers. */
  readonly device?: string;
  /** A port of `navigator.serial`, or true: the user chooses one, which needs a click. Only in browsers. */
  readonly webSerial?: unknown;
  /** The built-in virtual plotter; `speed`: how many times faster than real time it is. */
  readonly virtual?: boolean | { readonly speed?: number };
  /** The address of a running server, such as http://127.0.0.1:9080. */
  readonly url?: string;
  /** With `url`: an access key. Needed from another computer. */
  readonly key?: string;
  /** With `url`: id or name of one of its plotters. Default: the first. */
  readonly plotter?: string;
  /** Model, pen heights, speeds and so on, from which every plot and move starts. A server has its own. */
  readonly settings?: GivenSettings;
}

/** The settings that a plot's options give, checked. */
export function givenOf({
  paper,
  speed,
  name: _name,
  onProgress: _onProgress,
  onPenChange: _onPenChange,
  signal: _signal,
  liftAfterMs: _liftAfterMs,
  ...given
}: PlotOptions & LiveOptions): GivenSettings {
  const short: GivenSettings = {
    ...(paper === undefined ? {} : { prepare: { paper: sizeOf(paper) } }),
    ...(speed === undefined ? {} : { motion: { draw: { speedMmPerS: speed } } }),
  };
  return parseWith(givenSettingsSchema, withGiven(short, given));
}

/** How long the pen rests on the line, checked, ms. */
export function liftAfterMsOf({ liftAfterMs = LIFT_AFTER_MS }: Pick<LiveOptions, "liftAfterMs">): number {
  if (liftAfterMs >= 0 && liftAfterMs <= MAX_LIFT_AFTER_MS) return liftAfterMs;
  throw new PlotwrightError(
    "bad-setting",
    `liftAfterMs is ${liftAfterMs}: give the time that the pen rests on the line, 0 to ${MAX_LIFT_AFTER_MS} ms.`,
  );
}

function sizeOf(paper: PaperName | PaperSize): PaperSize {
  if (typeof paper !== "string") return paper;
  if (Object.hasOwn(PAPER_SIZES, paper)) return PAPER_SIZES[paper];
  const names = Object.keys(PAPER_SIZES).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `paper: there is no ${String(paper)}. There is ${names}, or a size in mm.`,
  );
}

/** The file of a drawing: its own text, or lines as JSON, on a page as large as the paper, so that they stay where they are. */
export function fileOf(
  drawing: string | readonly Line[],
  { prepare }: Pick<PlotSettings, "prepare">,
): string {
  if (typeof drawing === "string") return drawing;
  if (!Array.isArray(drawing)) {
    throw new PlotwrightError(
      "bad-file",
      "plot: give the text of a drawing, or lines: [[[x, y], [x, y], …], …].",
    );
  }
  const strokes = (drawing as readonly Line[]).map((line, i) => checkedLine(line, i + 1));
  const { widthMm, heightMm } = orientedPaper(prepare.paper, prepare.landscape);
  return JSON.stringify({ widthMm, heightMm, layers: [{ name: "Lines", strokes }] });
}

/** The coordinates of a line, one after the other. */
function checkedLine(line: unknown, number: number): number[] {
  if (!Array.isArray(line)) {
    throw new PlotwrightError("bad-file", `Line ${number} is not a list of points: [[x, y], [x, y], …].`);
  }
  return (line as readonly (ArrayLike<unknown> | null)[]).flatMap((point, i) => {
    const [x, y] = [point?.[0], point?.[1]];
    if (point?.length === 2 && Number.isFinite(x) && Number.isFinite(y)) return [x as number, y as number];
    throw new PlotwrightError(
      "bad-file",
      `Point ${i + 1} of line ${number} is not [x, y] with two finite numbers, in mm. Lines are [[[x, y], [x, y], …], …].`,
    );
  });
}

/** A height in percent counts as down: the next move lifts the pen first. */
export function penTarget(where: "up" | "down" | number): { up: boolean; heightPct?: number } {
  if (where === "up" || where === "down") return { up: where === "up" };
  if (where >= 0 && where <= 100) return { up: false, heightPct: where };
  throw new PlotwrightError(
    "bad-setting",
    `pen: give "up", "down" or a height from 0 to 100 %, not ${String(where)}.`,
  );
}

export function positionOf(xMm: number, yMm: number): { xMm: number; yMm: number } {
  if (Number.isFinite(xMm) && Number.isFinite(yMm)) return { xMm, yMm };
  throw new PlotwrightError(
    "bad-setting",
    `moveTo: give two numbers, in mm from home, not ${String(xMm)} and ${String(yMm)}.`,
  );
}
