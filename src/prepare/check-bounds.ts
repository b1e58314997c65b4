/** Checks that the drawing fits the machine, before anything moves. */
import { checkObject } from "../check-arguments.js";
import { checkStrokes, type StrokeSet } from "../drawing/stroke-set.js";
import { PlotwrightError } from "../errors.js";
import { boxOfPoints, type Box } from "../geometry/box.js";
import type { MachineProfile } from "../machines/profile.js";

/** mm; rounding and the play of the carriage are no reason to refuse a plot. */
const SLACK = 0.01;

/** Whether a machine reaches all of a box, with 0.01 mm to spare for rounding. */
export const isReached = (
  box: Box,
  { widthMm, heightMm }: Pick<MachineProfile, "widthMm" | "heightMm">,
): boolean => box.x0 >= -SLACK && box.y0 >= -SLACK && box.x1 <= widthMm + SLACK && box.y1 <= heightMm + SLACK;

/**
 * Checks that a machine reaches every stroke, with 0.01 mm to spare for rounding. `planSvg` does it; call it yourself
 * when you use the steps.
 *
 * @throws PlotwrightError "out-of-bounds", with the figures
 */
export function checkBounds(
  strokes: StrokeSet,
  machine: Pick<MachineProfile, "name" | "widthMm" | "heightMm">,
): void {
  checkStrokes("checkBounds", strokes);
  const aMachine = 'a profile, for example machineById("axidraw-v3")';
  checkObject("checkBounds", "the machine", machine, ["widthMm", "heightMm"], aMachine);
  if (strokes.xy.length === 0) return;
  const box = boxOfPoints(strokes.xy);
  if (isReached(box, machine)) return;
  const mm = (value: number): string => String(Math.round(value * 10) / 10);
  throw new PlotwrightError(
    "out-of-bounds",
    `The drawing reaches from (${mm(box.x0)}, ${mm(box.y0)}) to (${mm(box.x1)}, ${mm(box.y1)}) mm, but the ${machine.name} ` +
      `can only go from (0, 0) to (${mm(machine.widthMm)}, ${mm(machine.heightMm)}) mm: choose a smaller paper, ` +
      `turn the paper, or fit the drawing to it.`,
  );
}
