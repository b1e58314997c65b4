/** Faults that any controller can tell of, in words for the user. */
import { PlotwrightError } from "../errors.js";

export const powerLow = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The motors have no power, or too little: check the plotter's power supply, its plug and its switch. " +
      "The carriage may have been moved meanwhile, so put it to home before the next plot.",
  );

/** Said of a plot whose place was found by the last good reading: some of what follows it may be drawn already. */
const MAY_OVERLAP = "Its line may overlap a little where it goes on.";

export const powerLost = (): PlotwrightError =>
  new PlotwrightError("board-error", `${powerLow().message} ${MAY_OVERLAP}`);

export const boardRestarted = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board has started anew in the middle of its motion and has lost its place: its reset button was pressed, or its " +
      "supply failed for a moment. Its motors are off now: put the carriage to home before you go on. " +
      MAY_OVERLAP,
  );
