import { checkObject } from "../check-arguments.js";
import { RULE_NONZERO, VERB_LINE, VERB_MOVE, type Drawing, type DrawingPaths } from "./drawing.js";
import type { PaperSize } from "./paper.js";

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

/** The value of a layer in a record by layer id. Ids come from files, so an id may be "constructor". */
export const setFor = <T>(record: Readonly<Record<string, T>>, id: string): T | undefined =>
  Object.hasOwn(record, id) ? record[id] : undefined;

/** A copy of `strokes.xy` in which the strokes of each layer are moved; `strokes.xy` itself if no layer has an offset. */
export function shiftedXy(
  { xy, offsets, layer, layers }: StrokeSet,
  offsetOf: (layer: StrokeLayer) => StrokeLayer["shiftMm"],
): Float64Array {
  const shifts = layers.map(offsetOf);
  if (shifts.every((shift) => shift === undefined)) return xy;
  const shifted = xy.slice();
  layer.forEach((k, i) => {
    const { x, y } = shifts[k] ?? { x: 0, y: 0 };
    for (let p = offsets[i]; p < offsets[i + 1]; p++) {
      shifted[2 * p] += x;
      shifted[2 * p + 1] += y;
    }
  });
  return shifted;
}

/** Where the ink lies: without the corrections for off-centre pens, which only concern the plotter. */
export const inkXy = (strokes: StrokeSet): Float64Array =>
  shiftedXy(strokes, ({ shiftMm }) => shiftMm && { x: -shiftMm.x, y: -shiftMm.y });

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
  checkLines("strokesOf", lines);
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

/**
 * A drawing of these lines on a page of the paper's size, so that their points are mm on the paper.
 *
 * @throws as strokesOf
 */
export function drawingOfLines(lines: readonly Line[], { widthMm, heightMm }: PaperSize): Drawing {
  checkLines("prepare", lines);
  const { xy, offsets, layer } = strokesOf(lines.map(dotAsLine));
  const count = lines.length;
  const verbs = new Uint8Array(xy.length / 2).fill(VERB_LINE);
  for (let line = 0; line < count; line++) verbs[offsets[line]] = VERB_MOVE;
  const none = new Int32Array(count).fill(-1);
  const paths: DrawingPaths = {
    ...{ count, verbs, coords: xy, verbOffsets: offsets, coordOffsets: offsets.map((point) => 2 * point) },
    ...{ group: Uint32Array.from(layer), stroke: new Int32Array(count), fill: none, dash: none, clip: none },
    ...{ fillRule: new Uint8Array(count).fill(RULE_NONZERO), strokeWidth: new Float32Array(count) },
  };
  const groups = [{ id: ONE_LAYER.id, name: ONE_LAYER.name, hidden: false }];
  return { widthMm, heightMm, groups, colors: ["#000000"], dashes: [], clips: [], paths, warnings: [] };
}

/** A path of one point draws nothing: a dot is a line to the same point. */
const dotAsLine = (line: Line): Line => (line.length === 1 ? [line[0], line[0]] : line);

function checkLines(call: string, lines: unknown): void {
  const isLine = (line: unknown): boolean => Array.isArray(line) && line.every(Array.isArray);
  if (Array.isArray(lines) && lines.every(isLine)) return;
  throw new TypeError(
    `${call} takes a list of lines, each a list of points [x, y] in mm: ${call}([[[0, 0], [10, 10]]]).`,
  );
}
