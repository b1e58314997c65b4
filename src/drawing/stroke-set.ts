import { checkObject } from "../check-arguments.js";

/**
 * The strokes of a plot, in drawing order: polylines in mm in the machine frame.
 *
 * Frame "machine": mm from home, x along the machine's long axis, y away from home.
 * The paper lies with its top left corner at home.
 */
export interface StrokeSet {
  /** 2 × points numbers: x, y, x, y … mm. */
  readonly xy: Float64Array;
  /**
   * strokes + 1 entries; stroke i has points [offsets[i], offsets[i+1]). Every stroke has at least
   * one point (a dot).
   */
  readonly offsets: Uint32Array;
  /** By stroke: index into `layers`. Strokes of a layer are contiguous, layers in order. */
  readonly layer: Uint16Array;
  /** Each stroke is drawn at this share of its layer's speed; left out: 1 for all. */
  readonly speedFactor?: Float64Array | undefined;
  /** The layers that `layer` refers to. */
  readonly layers: readonly StrokeLayer[];
}

/** A layer as the user sees and switches it: a group, a stroke colour, or everything together. */
export interface StrokeLayer {
  readonly id: string;
  readonly name: string;
  /** "#rrggbb": the colour of most of its stroke length in the file; null if its strokes have no colour. */
  readonly color: string | null;
  /** If the layer was split by stops to take up ink: id of the original layer, whose settings apply. */
  readonly partOf?: string | undefined;
  /** Offset of its strokes that corrects a pen mounted off-centre, mm; left out: none. */
  readonly shiftMm?: { readonly x: number; readonly y: number } | undefined;
}

/** The id under which settings store a layer: that of the original if the layer was split. */
export const settingsIdOf = (layer: StrokeLayer): string => layer.partOf ?? layer.id;

export const strokeCount = (set: StrokeSet): number => set.offsets.length - 1;
export const pointCount = (set: StrokeSet): number => set.xy.length / 2;

/** @throws TypeError for any other value, from a program without types */
export const checkStrokes = (call: string, strokes: StrokeSet): void =>
  checkObject(
    call,
    "the set of strokes",
    strokes,
    ["xy", "offsets", "layer", "layers"],
    "prepare(drawing).strokes or strokesOf(lines)",
  );
