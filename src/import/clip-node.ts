/**
 * Clip regions during import: a chain of nodes from the innermost outwards, shared by all shapes they clip.
 *
 * Most clips in exported files are the artboard's rectangle around everything. A node that is an axis-aligned
 * rectangle is skipped for every shape inside it, so such files need no clipping later. A region gets an
 * index only when a shape needs it.
 */
import {
  RULE_NONZERO,
  VERB_CLOSE,
  VERB_CUBIC,
  VERB_LINE,
  VERB_MOVE,
  type ClipRegion,
} from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { boxContains, boxOfPoints, grownBox, mappedCorners, type Box } from "../geometry/box.js";
import { getOrAdd } from "../get-or-add.js";

export type ClipShapes = Required<Omit<ClipRegion, "parent">>;

/** mm: a shape on the rectangle's edge counts as inside. */
const GRACE = 1e-6;

export class ClipNode {
  /** Index in `Drawing.clips`, by the index of the remaining chain outside. */
  private readonly indexByParent = new Map<number, number>();
  /** The region itself if it is an axis-aligned rectangle, in page mm; otherwise null. */
  readonly rectangle: Box | null;

  constructor(
    readonly parent: ClipNode | null,
    readonly shapes: ClipShapes,
  ) {
    this.rectangle = rectangleOf(shapes);
  }

  indexUnder(parentIndex: number, clips: ClipRegion[]): number {
    return getOrAdd(
      this.indexByParent,
      parentIndex,
      () => clips.push({ ...this.shapes, parent: parentIndex }) - 1,
    );
  }
}

const RECTANGLE_VERBS = Uint8Array.of(VERB_MOVE, VERB_LINE, VERB_LINE, VERB_LINE, VERB_CLOSE);

/** A clip to a box, which `map` takes to page mm. */
export const rectangleClip = (parent: ClipNode | null, map: Affine, box: Box): ClipNode =>
  new ClipNode(parent, {
    verbs: RECTANGLE_VERBS,
    coords: Float64Array.from(mappedCorners(map, box)),
    rule: Uint8Array.of(RULE_NONZERO),
    shape: Uint32Array.of(0),
  });

/** The clip index for a shape with box `box`; −1 if nothing cuts it. */
export function clipIndexFor(node: ClipNode | null, box: Box, clips: ClipRegion[]): number {
  const cutting: ClipNode[] = [];
  for (let at = node; at !== null; at = at.parent) {
    if (at.rectangle === null || !boxContains(grownBox(at.rectangle, GRACE), box)) cutting.push(at);
  }
  let index = -1;
  for (let i = cutting.length - 1; i >= 0; i--) index = cutting[i].indexUnder(index, clips);
  return index;
}

/** The region's box if it is one axis-aligned rectangle, otherwise null. */
function rectangleOf({ verbs, coords, rule }: ClipShapes): Box | null {
  if (rule.length !== 1) return null;
  const points = coords.length / 2;
  const isClosedAgain = points === 5 && coords[0] === coords[8] && coords[1] === coords[9];
  if (points !== 4 && !isClosedAgain) return null;
  if (verbs.includes(VERB_CUBIC)) return null;
  for (let i = 0; i < 4; i++) {
    const next = ((i + 1) % 4) * 2;
    const sameX = coords[2 * i] === coords[next];
    const sameY = coords[2 * i + 1] === coords[next + 1];
    // Sides alternate. A degenerate side is both horizontal and vertical: not a rectangle.
    if (sameX === sameY) return null;
    if (i % 2 === 0 && sameX !== (coords[4] === coords[6])) return null;
  }
  return boxOfPoints(coords);
}
