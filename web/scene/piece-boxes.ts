/**
 * Finds the pieces that are visible, by boxes around every few hundred pieces, in order. So the cost of a view depends
 * on what is in it.
 */
import { boxOfPieces, type Pieces } from "./pieces.js";
import type { Frame } from "./renderer.js";

const PIECES_A_BOX = 512;
/** Limits the number of boxes, because each may cost a draw call. More pieces make larger boxes. */
const MAX_BOXES = 2_048;

export interface PieceBoxes {
  readonly piecesABox: number;
  /** mm x0 y0 x1 y1 of each box. */
  readonly mm: Float32Array;
}

/** Indices of pieces; `to` is not included. */
export type PieceRange = readonly [from: number, to: number];

/** Linear in the pieces. */
export const boxPieces = ({ count, bytes }: Pieces): PieceBoxes => {
  const floats = new Float32Array(bytes);
  const piecesABox = Math.max(PIECES_A_BOX, Math.ceil(count / MAX_BOXES));
  const mm = new Float32Array(4 * Math.ceil(count / piecesABox));
  for (let at = 0, from = 0; from < count; at += 4, from += piecesABox) {
    const { x0, y0, x1, y1 } = boxOfPieces(floats, from, Math.min(count, from + piecesABox));
    mm.set([x0, y0, x1, y1], at);
  }
  return { piecesABox, mm };
};

/** The ranges of pieces within `from` … `to` − 1 whose box, enlarged by `reachPx`, is in the frame. In order, none empty. */
export const rangesInSight = (
  { piecesABox, mm }: PieceBoxes,
  [from, to]: PieceRange,
  { view, width, height }: Pick<Frame, "view" | "width" | "height">,
  reachPx: number,
): PieceRange[] => {
  const x0 = (-reachPx - view.offsetX) / view.scale;
  const y0 = (-reachPx - view.offsetY) / view.scale;
  const x1 = (width + reachPx - view.offsetX) / view.scale;
  const y1 = (height + reachPx - view.offsetY) / view.scale;
  const ranges: [number, number][] = [];
  if (from >= to) return ranges;
  for (let at = Math.floor(from / piecesABox); at * piecesABox < to; at++) {
    const k = at * 4;
    if (mm[k] > x1 || mm[k + 2] < x0 || mm[k + 1] > y1 || mm[k + 3] < y0) continue;
    const begin = Math.max(from, at * piecesABox);
    const end = Math.min(to, (at + 1) * piecesABox);
    const last = ranges.at(-1);
    if (last?.[1] === begin) last[1] = end;
    else ranges.push([begin, end]);
  }
  return ranges;
};
