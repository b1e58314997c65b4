/** Converts lines that a program has computed to strokes. */
import type { StrokeLayer, StrokeSet } from "./stroke-set.js";

/** Points of one line in drawing order, mm from home. */
export type Line = readonly (readonly [x: number, y: number])[];

const ONE_LAYER: StrokeLayer = { id: "lines", name: "Lines", color: null };

/**
 * Strokes of one layer from lines of points, in their order. A line of one point is a dot.
 *
 * @throws TypeError for anything but lines of points
 * @throws RangeError for a line without points, and for a coordinate that is not a finite number.
 */
export function strokesOf(lines: readonly Line[], layer: StrokeLayer = ONE_LAYER): StrokeSet {
  checkLines(lines);
  const offsets = new Uint32Array(lines.length + 1);
  lines.forEach((line, index) => {
    if (line.length === 0) throw new RangeError(`line ${index} has no points: leave it out`);
    offsets[index + 1] = offsets[index] + line.length;
  });
  const xy = new Float64Array(2 * offsets[lines.length]);
  let at = 0;
  lines.forEach((line, index) => {
    for (const [x, y] of line) {
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        throw new RangeError(`line ${index} has the point ${x}, ${y}: both must be finite numbers of mm`);
      }
      xy[at++] = x;
      xy[at++] = y;
    }
  });
  return { xy, offsets, layer: new Uint16Array(lines.length), layers: [layer] };
}

function checkLines(lines: unknown): void {
  const isLine = (line: unknown): boolean => Array.isArray(line) && line.every(Array.isArray);
  if (Array.isArray(lines) && lines.every(isLine)) return;
  throw new TypeError(
    "strokesOf takes a list of lines, each a list of points [x, y] in mm: strokesOf([[[0, 0], [10, 10]]]).",
  );
}
