/** Checks that the drawing fits the machine, before anything moves. */
import { checkObject } from "../check-arguments.js";
import { checkStrokes, strokeCount, type StrokeSet } from "../drawing/stroke-set.js";
import { PlotwrightError } from "../errors.js";
import { boxOfPoints, type Box } from "../geometry/box.js";
import type { MachineProfile } from "../machines/profile.js";

/** Tolerance for rounding, mm. */
const SLACK = 0.01;

/** Whether a machine reaches all of a box, with a tolerance of 0.01 mm for rounding. */
export const isReached = (
  box: Box,
  { widthMm, heightMm }: Pick<MachineProfile, "widthMm" | "heightMm">,
): boolean => box.x0 >= -SLACK && box.y0 >= -SLACK && box.x1 <= widthMm + SLACK && box.y1 <= heightMm + SLACK;

/** How many strokes the machine does not reach, or reaches only in part. */
export function unreachedCount(
  strokes: StrokeSet,
  machine: Pick<MachineProfile, "widthMm" | "heightMm">,
): number {
  const { xy, offsets } = strokes;
  if (isReached(boxOfPoints(xy), machine)) return 0;
  let count = 0;
  for (let i = 0; i < strokeCount(strokes); i++) {
    if (!isReached(boxOfPoints(xy, 2 * offsets[i], 2 * offsets[i + 1]), machine)) count++;
  }
  return count;
}

/**
 * Checks that a machine reaches every stroke, with a tolerance of 0.01 mm for rounding. `planSvg` calls it; call it
 * yourself if you use the single steps.
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
