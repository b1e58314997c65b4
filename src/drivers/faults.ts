/** Errors that any controller can report, in words for the user. `findsHome`: the machine finds home by itself. */
import { PlotwrightError } from "../errors.js";

/** Of a machine that finds home in its corner, if the user had set another home. */
const HOME_ELSEWHERE = "if home was set by hand elsewhere than in its corner, set it there again first";

export const powerLow = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The motors have no power, or too little: check the plotter's power supply, its plug and its switch. " +
      (findsHome
        ? `The carriage may have moved: the plotter finds home by itself before the next plot; ${HOME_ELSEWHERE}.`
        : "The carriage may have moved, so push it to home before the next plot."),
  );

/** What to do about a position that is lost in a plot. */
export const homeAgain = (findsHome: boolean): string =>
  findsHome
    ? `the plotter finds home by itself when you resume; ${HOME_ELSEWHERE}`
    : "push the carriage to home by hand before you resume";

/** What to do about a pen on a Z axis whose height is lost. */
export const HEIGHT_AGAIN =
  "before you resume, turn its Z axis by hand to the height at which you switch the machine on";

export const lineLost = (cause?: unknown): PlotwrightError =>
  new PlotwrightError(
    "disconnected",
    "The connection to the board is lost: check its USB cable and power, then connect again.",
    { cause },
  );

export const lineClosed = (): PlotwrightError =>
  new PlotwrightError("disconnected", "The connection to the board was closed.");

export const moveStopped = (): PlotwrightError =>
  new PlotwrightError("conflict", "The move was stopped at once.");

/** `waitingFor`: the line, or the name of the reply, that was not answered. */
export const silent = (waitingFor: string): PlotwrightError =>
  new PlotwrightError(
    "board-timeout",
    `The board has stopped answering (waiting on ${waitingFor}): check its USB cable and power, and that no other program uses the port.`,
  );

export const stuck = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board answers but does not finish its motion: press its reset button or unplug it, set home and plot again.",
  );

/**
 * Added to a message if the plot resumes from the last good reading: part of the line after it may already be drawn.
 */
const MAY_OVERLAP = "Its line may overlap a little where it resumes.";

export const powerLost = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError("board-error", `${powerLow(findsHome).message} ${MAY_OVERLAP}`);

export const powerFailed = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The motors had no power, or too little, for a moment: check the plotter's power supply, its plug and its switch. " +
      (findsHome
        ? `The carriage is no longer where the board counts it: ${homeAgain(true)}.`
        : "The carriage is no longer where the board counts it, so push it to home before you resume.") +
      ` ${MAY_OVERLAP}`,
  );

export const boardRestarted = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board restarted and has lost its position: its reset button was pressed, or its supply failed for a " +
      `moment. Its motors are off: ${homeAgain(findsHome)}. ${MAY_OVERLAP}`,
  );
