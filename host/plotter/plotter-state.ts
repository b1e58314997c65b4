/** Options and state of a plotter's connection, and its messages about them. */
import { PlotwrightError, type Clock } from "../../src/index.js";
import type { Springs } from "../../src/internal.js";
import type { Plotter, PlotSettings } from "../../src/schema/index.js";
import type { Devices } from "./devices.js";
import { OtherBoardError, type OtherBoards } from "./other-board.js";
import type { PlotProgress } from "./plotter-port.js";

export interface PlotterOptions {
  /**
   * "auto" (an EiBotBoard if one is plugged in, else the virtual board), "virtual", or a serial port's path.
   */
  readonly device: string;
  /** Whether "auto" uses the virtual board if no board is plugged in. Default true. */
  readonly virtualIfNone?: boolean | undefined;
  /** Whether "auto" must skip a port, because another plotter uses it. */
  readonly isTaken?: ((path: string) => boolean) | undefined;
  /** Finds what "auto" can't connect, for a program whose ports the user has chosen. Default: it is not looked for. */
  readonly otherBoards?: OtherBoards | undefined;
  /**
   * How many times faster than real time a virtual board runs, also one that `device` leads to. Default 1.
   */
  readonly virtualSpeed?: number | undefined;
  /** How the pen of the built-in virtual board swings. Default: not at all. */
  readonly virtualSprings?: Springs | undefined;
  /** Firmware version that the built-in virtual board reports. Default 2.8.1. */
  readonly firmware?: string | undefined;
  /** Settings for manual moves before the first job. */
  readonly settings?: PlotSettings | undefined;
  readonly clock: Clock;
  readonly devices: Devices;
}

export type PlotterState = Omit<Plotter, "id" | "name" | "machine">;

/** What is not known of a plotter that is not connected. */
export const UNKNOWN = {
  penUp: null,
  penMoving: false,
  heightUnsure: false,
  motorsOn: null,
  xMm: null,
  yMm: null,
} as const satisfies Partial<PlotterState>;

/** The state before the first attempt to connect. `device` is as in the options. */
export function initialState(device: string): PlotterState {
  const isPath = device !== "virtual" && device !== "auto";
  return {
    otherBoard: null,
    kind: isPath ? "serial" : "virtual",
    device: isPath ? device : null,
    connection: "connecting",
    boardName: null,
    boardSerialNumber: null,
    activity: "none",
    firmware: null,
    emergencyStopMs: null,
    message: null,
    ...UNKNOWN,
  };
}

/** What changes when there is no connection, because of the error. */
export function stateAfter(error: PlotwrightError): Partial<PlotterState> {
  const otherBoard = error instanceof OtherBoardError ? error.board : null;
  return {
    connection: error.code === "no-board" ? "absent" : "fault",
    message: error.message,
    otherBoard,
    ...(otherBoard ? { kind: "serial" } : {}),
    ...UNKNOWN,
  };
}

/** The message after a connection that found the pen on the paper. `restedS`: since the last connection was lost. */
export function penRested({ xMm, yMm }: PlotterState, restedS: number | null): string {
  const where =
    xMm === null || yMm === null ? "" : ` at x ${xMm.toFixed(1)} mm, y ${yMm.toFixed(1)} mm from home`;
  const rested =
    restedS === null
      ? `The pen was on the paper${where} when the board was connected`
      : `The pen rested on the paper for ${Math.round(restedS)} s${where}, while the board was not connected`;
  return `${rested}. It is lifted now: look for a blot there before you resume.`;
}

/** A pen that rests this long on the paper leaves a blot, real seconds. */
export const BLOT_S = 2;

/** The note of a plot whose computer stood still while the pen was down. */
export const restedWhileStalled = ({ xMm, yMm }: PlotProgress, stalledS: number): string =>
  `This computer stood still for ${Math.round(stalledS)} s, and the pen rested on the paper meanwhile, at x ${xMm.toFixed(1)} mm, y ${yMm.toFixed(1)} mm from home. Look for a blot there.`;

/** The message of a new connection; null for a real board. `device` is as in the options. */
export function welcome(kind: PlotterState["kind"], device: string): string | null {
  if (kind === "serial") return null;
  return device === "auto"
    ? "No plotter is plugged in, so this is the virtual plotter: nothing is drawn on paper."
    : "This is the virtual plotter: nothing is drawn on paper.";
}

export const notStarted = (): PlotwrightError =>
  new PlotwrightError("no-board", "The plotter is not connected yet: start it first.");

export const noConsole = (): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    "This machine takes no typed lines: use the buttons of the page instead.",
  );

export const closedError = (): PlotwrightError =>
  new PlotwrightError("disconnected", "The plotter was closed: start it again to continue.");
