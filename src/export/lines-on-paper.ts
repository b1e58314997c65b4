/** Where the strokes lie on paper, which is what is saved of them. */
import { strokeCount, type StrokeSet } from "../drawing/stroke-set.js";

/** Coordinates as `strokes.xy`, without the corrections for pens that sit askew: those belong to the plotter. */
export function linesOnPaper(strokes: StrokeSet): Float64Array {
  const { layers, layer, offsets } = strokes;
  if (layers.every(({ shiftMm }) => shiftMm === undefined)) return strokes.xy;
  const xy = strokes.xy.slice();
  for (let i = 0; i < strokeCount(strokes); i++) {
    const { x, y } = layers[layer[i]].shiftMm ?? { x: 0, y: 0 };
    for (let p = offsets[i]; p < offsets[i + 1]; p++) {
      xy[2 * p] -= x;
      xy[2 * p + 1] -= y;
    }
  }
  return xy;
}
