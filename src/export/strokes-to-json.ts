/** The prepared drawing as JSON: polylines in mm in drawing order, layer by layer, for other programs. */
import { strokeCount, type StrokeSet, inkXy } from "../drawing/stroke-set.js";

interface StrokesJson {
  readonly format: "plotwright-strokes";
  readonly version: 1;
  /** Paper size as placed, mm; its top left corner is at 0, 0. */
  readonly widthMm: number;
  readonly heightMm: number;
  readonly layers: readonly {
    readonly id: string;
    readonly name: string;
    readonly color: string | null;
    /** Each stroke as x, y, x, y … mm; two numbers are a dot. */
    readonly strokesMm: readonly (readonly number[])[];
    /** Each stroke is drawn at this share of the usual speed; left out: 1 for all. */
    readonly speedFactors?: readonly number[];
  }[];
}

/** Coordinates are rounded to 1 µm. */
export function toJson(strokes: StrokeSet, paper: { widthMm: number; heightMm: number }): StrokesJson {
  const xy = inkXy(strokes);
  const layers = strokes.layers.map(({ id, name, color }) => ({
    id,
    name,
    color,
    strokesMm: [] as number[][],
    ...(strokes.speedFactor ? { speedFactors: [] as number[] } : {}),
  }));
  for (let i = 0; i < strokeCount(strokes); i++) {
    const points = xy.subarray(2 * strokes.offsets[i], 2 * strokes.offsets[i + 1]);
    layers[strokes.layer[i]].strokesMm.push(Array.from(points, (v) => Math.round(v * 1000) / 1000));
    if (strokes.speedFactor) layers[strokes.layer[i]].speedFactors?.push(strokes.speedFactor[i]);
  }
  return {
    format: "plotwright-strokes",
    version: 1,
    widthMm: paper.widthMm,
    heightMm: paper.heightMm,
    layers,
  };
}
