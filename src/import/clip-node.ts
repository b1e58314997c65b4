/**
 * Clip regions while importing: a chain of nodes from the innermost out, shared by all they clip.
 *
 * Most clips in exported files are the artboard's rectangle around everything. A node that is a
 * rectangle along the page's axes is left out for every shape that lies inside it, so such files
 * cost the next stage nothing. An index is given to a region only when a shape needs it.
 */
import type { ClipRegion } from "../drawing/drawing.js";
import { boxContains, type Box } from "../geometry/box.js";

export interface ClipShapes {
  readonly verbs: Uint8Array;
  readonly coords: Float64Array;
  readonly rule: Uint8Array;
  readonly shape: Uint32Array;
}

/** mm: what lies on the rectangle's edge counts as inside. */
const GRACE = 1e-6;

export class ClipNode {
  /** Index in `Drawing.clips` by the index of what remained of the chain outside. */
  private readonly indexByParent = new Map<number, number>();

  constructor(
    readonly parent: ClipNode | null,
    readonly shapes: ClipShapes,
    /** The region itself where it is a rectangle along the axes, in page mm. */
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

/** The clip index for a shape that fills `box`: −1 where nothing cuts it. */
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
