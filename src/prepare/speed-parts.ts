/**
 * Splits layers into parts that are drawn at different speeds. After lines are sorted by layer, the tag of a line is its
 * part, so lines are joined and ordered only within a part. The parts of a layer are consecutive.
 *
 *   layers   outline          fill
 *   parts    0 full  1 half   2 full
 */
import type { Drawing } from "../drawing/drawing.js";
import type { LayerTable } from "./layers.js";

export interface SpeedParts {
  readonly count: number;
  /** By shape. */
  readonly ofShape: Uint16Array | Uint32Array;
  /** By part: its layer, and its share of the layer's speed. */
  readonly layer: readonly number[];
  readonly factor: readonly number[];
}

export function speedPartsOf(drawing: Drawing, { layers, ofShape }: LayerTable): SpeedParts {
  const { speedFactor } = drawing.paths;
  const all = layers.map((_, k) => k);
  if (!speedFactor) return { count: layers.length, ofShape, layer: all, factor: all.map(() => 1) };
  const factorsOf = layers.map(() => new Set<number>());
  speedFactor.forEach((factor, shape) => factorsOf[ofShape[shape]].add(factor));
  const layer: number[] = [];
  const factor: number[] = [];
  /** By layer: the part of each factor. */
  const partOf = factorsOf.map((factors, k) => {
    const parts = new Map<number, number>();
    // The fastest first.
    for (const one of [...factors].sort((a, b) => b - a)) {
      parts.set(one, layer.length);
      layer.push(k);
      factor.push(one);
    }
    return parts;
  });
  const ofPart = Uint32Array.from(ofShape, (k, shape) => partOf[k].get(speedFactor[shape]) ?? 0);
  return { count: layer.length, ofShape: ofPart, layer, factor };
}

/** Each line's share of its layer's speed, by its part; undefined if all are 1. */
export function speedFactorsOf(tag: Uint32Array, { factor }: SpeedParts): Float64Array | undefined {
  return factor.every((one) => one === 1) ? undefined : Float64Array.from(tag, (part) => factor[part]);
}
