/** Reorders and splits strokes for wet ink: neighbours are drawn at different times, with stops to take up ink. */
import {
  LineBuilder,
  distance,
  lineCount,
  lineLength,
  pickLines,
  tagRanges,
  type Lines,
} from "../../geometry/polyline.js";
import { randomFrom } from "../work.js";
import type { SpreadMode } from "../../settings/prepare.js";

/** Number of passes of "interleave": pass k draws every fourth line, starting with line k. */
const PASSES = 4;

/** Lines of one tag stay together. */
export function spreadLines(lines: Lines, mode: SpreadMode): Lines {
  if (mode === "none") return lines;
  const order: number[] = [];
  const random = randomFrom(2);
  for (const [first, end] of tagRanges(lines)) {
    order.push(...(mode === "shuffle" ? shuffled(first, end, random) : interleaved(first, end)));
  }
  return pickLines(lines, order);
}

function interleaved(first: number, end: number): number[] {
  const order: number[] = [];
  for (let pass = 0; pass < PASSES; pass++) {
    for (let i = first + pass; i < end; i += PASSES) order.push(i);
  }
  return order;
}

/** Fisher–Yates shuffle. */
function shuffled(first: number, end: number, random: () => number): number[] {
  const order = Array.from({ length: end - first }, (_, k) => first + k);
  for (let k = order.length - 1; k > 0; k--) {
    const other = Math.floor(random() * (k + 1));
    [order[k], order[other]] = [order[other], order[k]];
  }
  return order;
}

interface InkPortions {
  readonly lines: Lines;
  /** Index of each line's portion within its tag: 0, 1, 2 … */
  readonly portion: Uint32Array;
}

/**
 * Splits the lines of each tag into portions of at most `reach` mm. A line that does not fit starts a new portion, and a
 * line longer than a portion is cut.
 */
export function inkPortions(lines: Lines, reach: number): InkPortions {
  const builder = new LineBuilder();
  const portions: number[] = [];
  let portion = 0;
  let used = 0;
  for (let i = 0; i < lineCount(lines); i++) {
    if (i === 0 || lines.tag[i] !== lines.tag[i - 1]) portion = used = 0;
    const length = lineLength(lines, i);
    if (used > 0 && used + length > reach) {
      portion++;
      used = 0;
    }
    if (length <= reach) {
      builder.copy(lines, i, lines.tag[i]);
      portions.push(portion);
      used += length;
      continue;
    }
    used = cutByLength(lines, i, reach, builder, () => portions.push(portion++));
    portions.push(portion);
  }
  return { lines: builder.finish(), portion: Uint32Array.from(portions) };
}

/**
 * Cuts line `i` every `reach` mm, calling `onCut` after each piece except the last; returns the last piece's
 * length.
 */
function cutByLength(
  lines: Lines,
  i: number,
  reach: number,
  builder: LineBuilder,
  onCut: () => void,
): number {
  const { xy, offsets } = lines;
  let used = 0;
  builder.point(xy[2 * offsets[i]], xy[2 * offsets[i] + 1]);
  for (let p = offsets[i]; p < offsets[i + 1] - 1; p++) {
    const [x0, y0, x1, y1] = [xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]];
    const length = distance(x0, y0, x1, y1);
    let along = 0;
    while (used + length - along > reach) {
      along += reach - used;
      const x = x0 + ((x1 - x0) * along) / length;
      const y = y0 + ((y1 - y0) * along) / length;
      builder.point(x, y);
      builder.end(lines.tag[i]);
      onCut();
      builder.point(x, y);
      used = 0;
    }
    builder.point(x1, y1);
    used += length - along;
  }
  builder.end(lines.tag[i]);
  return used;
}
