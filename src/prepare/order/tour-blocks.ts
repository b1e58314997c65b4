/**
 * Searches a long tour block by block: a block of neighbouring strokes is extracted, searched as a separate small tour,
 * and written back. Reversing a section takes time in proportion to the ring, so a small ring is searched faster.
 *
 *   ring   h ooo [s s s] oooooo [s s] oo [s] oo      s in the block, o outside, h home
 *   small    A    s s s     B    s s   C  s  D       each run of o is one stroke of the small tour
 *
 * A run of outside strokes has two ends and the same length in both directions, just like a stroke. So the small tour is
 * the whole tour with the outside strokes fixed, and every mm saved in it is saved overall. (Tour-based partitioning,
 * after K. Helsgaun's LKH.)
 */
import { PointGrid } from "../../geometry/point-grid.js";
import { TourSearch } from "./tour-search.js";

const STROKES_IN_BLOCK = 1_000;
const CELLS_IN_BLOCK = 4;
/** Kicks per stroke of a block before the next block is searched. */
const KICKS = 8;
const KICKS_BETWEEN_CHECKS = 512;

/**
 * One pass over all strokes in blocks. Changes `ring` in place: the ends in drawing order; stroke k has ends 2k and
 * 2k + 1, with coordinates in `xy`. The stroke that represents home is first and in no block. `hasTime` is called
 * regularly with the number of kicks since the last call. Returns whether the pass was finished.
 */
export function improveBlocks(
  ring: Int32Array,
  xy: Float64Array,
  random: () => number,
  hasTime: (kicks: number) => boolean,
  strokesInBlock = STROKES_IN_BLOCK,
): boolean {
  const strokes = ring.length / 2;
  const home = ring[0] >> 1;
  const order = strokesInSpace(xy, strokes, strokesInBlock);
  // A random shift, so that a block border of one pass is inside a block in the next.
  const shift = Math.floor(random() * strokes);
  const blocks = Math.max(Math.round(strokes / strokesInBlock), 1);
  const isIn = new Uint8Array(strokes);
  for (let block = 0; block < blocks; block++) {
    const from = Math.floor((block * strokes) / blocks);
    const to = Math.floor(((block + 1) * strokes) / blocks);
    isIn.fill(0);
    for (let k = from; k < to; k++) isIn[order[(k + shift) % strokes]] = 1;
    isIn[home] = 0;
    if (!improveBlock(ring, xy, isIn, random, hasTime)) return false;
  }
  return true;
}

/** Strokes sorted by the position of their midpoint, so that each block covers a few adjacent cells. */
function strokesInSpace(xy: Float64Array, strokes: number, strokesInBlock: number): Uint32Array {
  const middles = new Float64Array(2 * strokes);
  for (let k = 0; k < strokes; k++) {
    middles[2 * k] = (xy[4 * k] + xy[4 * k + 2]) / 2;
    middles[2 * k + 1] = (xy[4 * k + 1] + xy[4 * k + 3]) / 2;
  }
  return new PointGrid(middles, strokesInBlock / CELLS_IN_BLOCK).inSpaceOrder();
}

function improveBlock(
  ring: Int32Array,
  xy: Float64Array,
  isIn: Uint8Array,
  random: () => number,
  hasTime: (kicks: number) => boolean,
): boolean {
  const starts = smallStrokes(ring, isIn);
  const count = starts.length - 1;
  const smallXy = new Float64Array(4 * count);
  const smallRing = new Int32Array(2 * count);
  for (let j = 0; j < count; j++) {
    const first = ring[starts[j]];
    const last = ring[starts[j + 1] - 1];
    smallXy[4 * j] = xy[2 * first];
    smallXy[4 * j + 1] = xy[2 * first + 1];
    smallXy[4 * j + 2] = xy[2 * last];
    smallXy[4 * j + 3] = xy[2 * last + 1];
    smallRing[2 * j] = 2 * j;
    smallRing[2 * j + 1] = 2 * j + 1;
  }
  const search = new TourSearch(smallXy, smallRing, random);
  search.improve();
  let more = true;
  for (let left = KICKS * count; left > 0 && more; left -= KICKS_BETWEEN_CHECKS) {
    const kicks = Math.min(left, KICKS_BETWEEN_CHECKS);
    for (let k = 0; k < kicks; k++) search.kick();
    more = hasTime(kicks);
  }
  putBack(ring, starts, search.ring);
  return more;
}

/**
 * Positions in the ring where each stroke of the small tour begins (one inside, or a run outside), and the
 * ring's end.
 */
function smallStrokes(ring: Int32Array, isIn: Uint8Array): number[] {
  const starts: number[] = [];
  let wasOutside = false;
  for (let p = 0; p < ring.length; p += 2) {
    const inside = isIn[ring[p] >> 1] === 1;
    if (inside || !wasOutside) starts.push(p);
    wasOutside = !inside;
  }
  starts.push(ring.length);
  return starts;
}

/** Writes the small tour back to the ring, beginning with the run that starts with home. */
function putBack(ring: Int32Array, starts: readonly number[], small: Int32Array): void {
  const old = ring.slice();
  const place = small.indexOf(0);
  const forward = (place & 1) === 0;
  let at = 0;
  for (let k = 0; k < small.length; k += 2) {
    const p = (forward ? place + k : place - k + small.length) % small.length;
    const entry = small[p];
    const from = starts[entry >> 1];
    const to = starts[(entry >> 1) + 1];
    if ((entry & 1) === 0) for (let q = from; q < to; q++) ring[at++] = old[q];
    else for (let q = to - 1; q >= from; q--) ring[at++] = old[q];
  }
}
