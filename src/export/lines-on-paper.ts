/** The strokes' coordinates on paper, as saved in exports. */
import { strokeCount, type StrokeSet } from "../drawing/stroke-set.js";

/** Like `strokes.xy`, but without the corrections for off-centre pens, which only concern the plotter. */
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
