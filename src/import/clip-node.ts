/**
 * Clip regions during import: a chain of nodes from the innermost outwards, shared by all shapes they clip.
 *
 * Most clips in exported files are the artboard's rectangle around everything. A node that is an axis-aligned
 * rectangle is skipped for every shape inside it, so such files need no clipping later. A region gets an
 * index only when a shape needs it.
 */
import type { ClipRegion } from "../drawing/drawing.js";
import { boxContains, type Box } from "../geometry/box.js";

export type ClipShapes = Required<Omit<ClipRegion, "parent">>;

/** mm: a shape on the rectangle's edge counts as inside. */
const GRACE = 1e-6;

export class ClipNode {
  /** Index in `Drawing.clips`, by the index of the remaining chain outside. */
  private readonly indexByParent = new Map<number, number>();

  constructor(
    readonly parent: ClipNode | null,
    readonly shapes: ClipShapes,
    /** The region itself if it is an axis-aligned rectangle, in page mm; otherwise null. */
    readonly rectangle: Box | null,
  ) {}

  indexUnder(parentIndex: number, clips: ClipRegion[]): number {
    let index = this.indexByParent.get(parentIndex);
    if (index === undefined) {
      index = clips.length;
      clips.push({ ...this.shapes, parent: parentIndex });
      this.indexByParent.set(parentIndex, index);
    }
    return index;
  }
}

/** The clip index for a shape with box `box`; −1 if nothing cuts it. */
export function clipIndexFor(node: ClipNode | null, box: Box, clips: ClipRegion[]): number {
  const cutting: ClipNode[] = [];
  for (let at = node; at !== null; at = at.parent) {
    if (at.rectangle === null || !boxContains(grown(at.rectangle), box)) cutting.push(at);
  }
  let index = -1;
  for (let i = cutting.length - 1; i >= 0; i--) index = cutting[i].indexUnder(index, clips);
  return index;
}

const grown = ({ x0, y0, x1, y1 }: Box): Box => ({
  x0: x0 - GRACE,
  y0: y0 - GRACE,
  x1: x1 + GRACE,
  y1: y1 + GRACE,
});
