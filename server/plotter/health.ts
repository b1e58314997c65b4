/** What the board's own answers say about its state, and the words for it. */
import { PlotwrightError, type StrokeSet } from "../../src/index.js";

/**
 * The second value of `QC` is the motor supply through a divider: about 300 for 9 V. Below this the supply is
 * absent or failing (the threshold that host programs use).
 */
const LOW_SUPPLY = 250;
const BUTTON_BIT = 1 << 5;

export function isPowerLow(line: string, reply: string): boolean {
  const reading = line === "QC" ? Number(reply.split(",")[1]) : Infinity;
  return reading < LOW_SUPPLY;
}

export function isButtonPressed(line: string, reply: string): boolean {
  if (line === "QG") return (Number.parseInt(reply, 16) & BUTTON_BIT) !== 0;
  return line === "QB" && Number(reply) === 1;
}

export const powerLow = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The motors have no power, or too little: check the plotter's power supply, its plug and its switch. " +
      "The carriage may have been moved meanwhile, so put it to home before the next plot.",
  );

/** Said of a plot whose place was found by the last good reading: some of what follows it may be drawn already. */
export const MAY_OVERLAP = "Its line may overlap a little where it goes on.";

export const powerLost = (): PlotwrightError =>
  new PlotwrightError("board-error", `${powerLow().message} ${MAY_OVERLAP}`);

export const boardRestarted = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board has started anew in the middle of its motion and has lost its place: its reset button was pressed, or its " +
      "supply failed for a moment. Its motors are off now: put the carriage to home before you go on. " +
      MAY_OVERLAP,
  );

/** A square, a circle and a zigzag, 12 mm wide: shows heights, corners and whether the lines meet. */
export function testPatch(): StrokeSet {
  const square = [0, 0, 12, 0, 12, 12, 0, 12, 0, 0];
  const circle = Array.from({ length: 61 }, (_, i) => {
    const angle = (i / 60) * 2 * Math.PI;
    return [6 + 4 * Math.cos(angle), 6 + 4 * Math.sin(angle)];
  }).flat();
  const zigzag = [2, 14, 4, 17, 6, 14, 8, 17, 10, 14];
  const lines = [square, circle, zigzag];
  const offsets = new Uint32Array(lines.length + 1);
  lines.forEach((line, i) => (offsets[i + 1] = offsets[i]! + line.length / 2));
  return {
    xy: Float64Array.from(lines.flat()),
    offsets,
    layer: new Uint16Array(lines.length),
    layers: [{ id: "test", name: "Test patch", color: null }],
  };
}
