/**
 * Reduces a large drawing to few pieces, to be shown while the view moves and until the whole is drawn. Pieces that
 * follow each other are joined as long as the result is straight enough. If there are still too many, only every Nth
 * one is kept.
 */
import { LAYER_SHORT, PIECE_BYTES, PIECE_FLOATS, PIECE_SHORTS, VALUE_SHORT, type Pieces } from "./pieces.js";

/** Even a computer without a graphics card draws this many quickly. */
const COARSE_PIECES = 40_000;
/** Min. length of a joined piece, as a share of the path that it replaces. */
const STRAIGHT = 0.8;
const TOUCH_MM = 1e-3;

/** At most `maxCount` pieces, in the same order of time. Returns `pieces` if there are no more. Linear. */
export const coarsePieces = (pieces: Pieces, maxCount = COARSE_PIECES): Pieces => {
  if (pieces.count <= maxCount) return pieces;
  const longest = Math.ceil(pieces.count / maxCount);
  let joined = 0;
  forEachChain(pieces, longest, () => joined++);
  const nth = Math.ceil(joined / maxCount);
  const bytes = new ArrayBuffer(Math.floor(joined / nth) * PIECE_BYTES);
  const writer = { floats: new Float32Array(bytes), shorts: new Uint16Array(bytes) };
  const source = { floats: new Float32Array(pieces.bytes), shorts: new Uint16Array(pieces.bytes) };
  let k = 0;
  forEachChain(pieces, longest, (first, last) => {
    k++;
    if (k % nth === 0) writeJoined(source, first, last, writer, k / nth - 1);
  });
  return { count: Math.floor(joined / nth), bytes };
};

interface Columns {
  readonly floats: Float32Array;
  readonly shorts: Uint16Array;
}

/** Splits the pieces into chains of at most `longest` that touch, are in one layer and bend little. */
const forEachChain = (
  { count, bytes }: Pieces,
  longest: number,
  visit: (first: number, last: number) => void,
): void => {
  const floats = new Float32Array(bytes);
  const shorts = new Uint16Array(bytes);
  let first = 0;
  while (first < count) {
    const a = first * PIECE_FLOATS;
    const layer = shorts[first * PIECE_SHORTS + LAYER_SHORT];
    let last = first;
    let pathLength = 0;
    for (; last < count && last - first < longest; last++) {
      const f = last * PIECE_FLOATS;
      if (last > first && !touches(floats, f)) break;
      if (shorts[last * PIECE_SHORTS + LAYER_SHORT] !== layer) break;
      pathLength += distance(floats[f + 2] - floats[f], floats[f + 3] - floats[f + 1]);
      const chord = distance(floats[f + 2] - floats[a], floats[f + 3] - floats[a + 1]);
      if (chord < STRAIGHT * pathLength) break;
    }
    visit(first, Math.max(first, last - 1));
    first = Math.max(first + 1, last);
  }
};

/** Whether the piece whose floats begin at `f` starts where the one before it ends. */
const touches = (floats: Float32Array, f: number): boolean =>
  Math.abs(floats[f] - floats[f - PIECE_FLOATS + 2]) < TOUCH_MM &&
  Math.abs(floats[f + 1] - floats[f - PIECE_FLOATS + 3]) < TOUCH_MM;

/** Writes one piece from the start of `first` to the end of `last`. */
const writeJoined = (source: Columns, first: number, last: number, target: Columns, at: number): void => {
  const { floats, shorts } = source;
  const a = first * PIECE_FLOATS;
  const b = last * PIECE_FLOATS;
  target.floats.set(
    [floats[a], floats[a + 1], floats[b + 2], floats[b + 3], floats[a + 4], floats[b + 5]],
    at * PIECE_FLOATS,
  );
  const s = at * PIECE_SHORTS;
  target.shorts[s + VALUE_SHORT] = shorts[first * PIECE_SHORTS + VALUE_SHORT];
  target.shorts[s + VALUE_SHORT + 1] = shorts[last * PIECE_SHORTS + VALUE_SHORT + 1];
  target.shorts[s + LAYER_SHORT] = shorts[first * PIECE_SHORTS + LAYER_SHORT];
};

/** Several times faster than Math.hypot, which also handles overflow. */
const distance = (dx: number, dy: number): number => Math.sqrt(dx * dx + dy * dy);
