/** Converts shapes to polylines: curves become chords within a tolerance in mm, after mapping to the paper. */
import { VERB_CLOSE, VERB_CUBIC, VERB_MOVE, type DrawingPaths } from "../drawing/drawing.js";
import { applyX, applyY, type Affine } from "../geometry/affine.js";
import { flattenCubic } from "../geometry/cubic.js";
import { PointBuffer } from "../geometry/growable.js";
import { LineBuilder, type Lines } from "../geometry/polyline.js";
import { stopIfCancelled, type Work } from "./work.js";

/** The verbs and coordinates of one shape, or of a clip region. */
export interface VerbRange {
  readonly verbs: Uint8Array;
  readonly verbFrom: number;
  readonly verbTo: number;
  readonly coords: Float64Array;
  readonly coordFrom: number;
}

/**
 * Makes one line from each subpath of the shapes for which `wanted` is 1; its tag is the shape. A subpath of zero
 * length becomes a dot. A shape without a stroke is drawn as the outline of its fill: its subpaths are closed, and its
 * dots are dropped.
 */
export function flattenShapes(
  paths: DrawingPaths,
  map: Affine,
  toleranceMm: number,
  wanted: Uint8Array,
  work: Work,
): Lines {
  const builder = new LineBuilder();
  const { verbs, verbOffsets, coords, coordOffsets, stroke } = paths;
  for (let shape = 0; shape < paths.count; shape++) {
    stopIfCancelled(work);
    if (wanted[shape] === 0) continue;
    const range = {
      verbs,
      verbFrom: verbOffsets[shape],
      verbTo: verbOffsets[shape + 1],
      coords,
      coordFrom: coordOffsets[shape],
    };
    flattenVerbs(range, map, toleranceMm, stroke[shape] < 0, builder, () => shape);
  }
  return builder.finish();
}

/** Adds a line for each subpath; `tagOf` gets the number of the subpath, counted by VERB_MOVE. */
export function flattenVerbs(
  range: VerbRange,
  map: Affine,
  toleranceMm: number,
  asArea: boolean,
  builder: LineBuilder,
  tagOf: (subpath: number) => number,
): void {
  const { verbs, coords } = range;
  let at = range.coordFrom;
  let subpath = -1;
  let startX = 0;
  let startY = 0;
  let x = 0;
  let y = 0;
  for (let v = range.verbFrom; v < range.verbTo; v++) {
    const verb = verbs[v];
    if (verb === VERB_MOVE) {
      endSubpath(builder, asArea, startX, startY, tagOf(subpath));
      subpath++;
      startX = x = applyX(map, coords[at], coords[at + 1]);
      startY = y = applyY(map, coords[at], coords[at + 1]);
      at += 2;
      continue;
    }
    if (builder.openPoints === 0) builder.point(x, y);
    if (verb === VERB_CLOSE) {
      x = startX;
      y = startY;
      builder.point(x, y);
      endSubpath(builder, asArea, startX, startY, tagOf(subpath));
      continue;
    }
    if (verb === VERB_CUBIC) {
      addCubic(builder, coords, at, map, x, y, toleranceMm);
      at += 4;
    }
    x = applyX(map, coords[at], coords[at + 1]);
    y = applyY(map, coords[at], coords[at + 1]);
    at += 2;
    builder.point(x, y);
  }
  endSubpath(builder, asArea, startX, startY, tagOf(subpath));
}

function endSubpath(
  builder: LineBuilder,
  asArea: boolean,
  startX: number,
  startY: number,
  tag: number,
): void {
  if (asArea && builder.openPoints > 2) builder.point(startX, startY);
  if (asArea && builder.openPoints < 3) builder.drop();
  else builder.end(tag);
}

const chords = new PointBuffer(1024);

function addCubic(
  builder: LineBuilder,
  coords: Float64Array,
  at: number,
  map: Affine,
  x0: number,
  y0: number,
  toleranceMm: number,
): void {
  chords.clear();
  flattenCubic(
    chords,
    x0,
    y0,
    applyX(map, coords[at], coords[at + 1]),
    applyY(map, coords[at], coords[at + 1]),
    applyX(map, coords[at + 2], coords[at + 3]),
    applyY(map, coords[at + 2], coords[at + 3]),
    applyX(map, coords[at + 4], coords[at + 5]),
    applyY(map, coords[at + 4], coords[at + 5]),
    toleranceMm,
  );
  for (let k = 0; k < chords.length - 2; k += 2) builder.point(chords.data[k], chords.data[k + 1]);
}
