/** Errors that any controller can report, in words for the user. */
import { PlotwrightError } from "../errors.js";

export const powerLow = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The motors have no power, or too little: check the plotter's power supply, its plug and its switch. " +
      "The carriage may have moved, so push it to home before the next plot.",
  );

/**
 * Added to a message if the plot resumes from the last good reading: part of the line after it may already be drawn.
 */
const MAY_OVERLAP = "Its line may overlap a little where it resumes.";

export const powerLost = (): PlotwrightError =>
  new PlotwrightError("board-error", `${powerLow().message} ${MAY_OVERLAP}`);

export const boardRestarted = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board restarted during its motion and has lost its position: its reset button was pressed, or its " +
      "supply failed for a moment. Its motors are off: push the carriage to home before you resume. " +
      MAY_OVERLAP,
  );
