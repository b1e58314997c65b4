/**
 * What the pen shall draw, in drawing order: polylines in mm in the machine frame.
 *
 * Frame "machine": mm from home, x along the machine's long axis, y away from home.
 * The paper lies with its top left corner at home.
 */
export interface StrokeSet {
  /** 2 × points: x, y, x, y … mm. */
  readonly xy: Float64Array;
  /** strokes + 1; stroke i has points [offsets[i], offsets[i+1]). Every stroke has at least one point (a dot). */
  readonly offsets: Uint32Array;
  /** Index into `layers` of each stroke. Strokes of one layer stand together, layers in order. */
  readonly layer: Uint16Array;
  readonly layers: readonly StrokeLayer[];
}

/** A layer as the user sees and switches it: from a group, a stroke colour, or all in one. */
export interface StrokeLayer {
  readonly id: string;
  readonly name: string;
  /** "#rrggbb" that most of its strokes' length has in the file; null where they have none. */
  readonly color: string | null;
  /** Id of the layer that this is a further part of, where stops to take up ink split one; its settings hold. */
  readonly partOf?: string | undefined;
  /** By how much its strokes are moved for a pen that sits askew, mm; left out: not at all. */
  readonly shiftMm?: { readonly x: number; readonly y: number } | undefined;
}

/** The id under which settings know a layer, or the layer that it is a part of. */
export const settingsIdOf = (layer: StrokeLayer): string => layer.partOf ?? layer.id;

export const strokeCount = (set: StrokeSet): number => set.offsets.length - 1;
export const pointCount = (set: StrokeSet): number => set.xy.length / 2;
