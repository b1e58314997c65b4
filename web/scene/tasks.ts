/** Which pieces of a scene are drawn in a picture, from bottom to top. The same for both renderers. */
import { coarsePieces } from "./coarse.js";
import { lineWidthPx, type Detail, type Frame, type Picture } from "./renderer.js";
import { type Pieces, boxOfPieces } from "./pieces.js";
import { piecesBefore } from "./scene.js";
import { mmFromScreen } from "./view.js";

export interface Boxed {
  readonly pieces: Pieces;
  readonly boxes: PieceBoxes;
}

/** Strokes, moves with the pen up, and the planned strokes if the pen is simulated. */
export interface Sheet<B extends Boxed> {
  readonly draw: B;
  readonly travel: B;
  readonly asked: B | null;
}

/** "ghost": not drawn yet at the shown moment. */
export type PieceStyle = "asked" | "ghost" | "drawn" | "travel";

/** A range of pieces that are still to be drawn. */
export interface Task<B extends Boxed> {
  readonly of: B;
  readonly style: PieceStyle;
  readonly to: number;
  from: number;
}

/** Added to the line's width for its smooth edge. */
const EDGE_PX = 2;

/** A scene in both details. `load` may add a renderer's data for each list of pieces. */
export const sheetsOf = <B extends Boxed>(
  { draw, travel, asked }: Picture,
  load: (boxed: Boxed) => B,
): Record<Detail, Sheet<B>> => {
  const loaded = (pieces: Pieces): B => load({ pieces, boxes: boxPieces(pieces) });
  return {
    coarse: {
      draw: loaded(coarsePieces(draw)),
      travel: loaded(coarsePieces(travel)),
      asked: asked ? loaded(coarsePieces(asked)) : null,
    },
    whole: { draw: loaded(draw), travel: loaded(travel), asked: asked ? loaded(asked) : null },
  };
};

/** The visible pieces: strokes that are not drawn yet, strokes that are, and moves with the pen up. */
export const tasksOf = <B extends Boxed>(frame: Frame, { draw, travel, asked }: Sheet<B>): Task<B>[] => {
  const until = ({ pieces }: Boxed): number =>
    frame.untilS === null ? pieces.count : piecesBefore(pieces, frame.untilS);
  const widestMm = Math.max(0, ...frame.layerWidthsMm);
  const reachPx = lineWidthPx(frame, widestMm) / 2 + EDGE_PX;
  const done = until(draw);
  // The piece under the pen is drawn up to the pen's position, and pale from there.
  const pale = frame.untilS === null ? done : Math.max(0, done - 1);
  const inSight = (of: B, range: PieceRange, style: PieceStyle): Task<B>[] =>
    rangesInSight(of.boxes, range, frame, reachPx).map(([from, to]) => ({ of, style, from, to }));
  return [
    ...(asked ? inSight(asked, [0, asked.pieces.count], "asked") : []),
    ...inSight(draw, [pale, draw.pieces.count], "ghost"),
    ...inSight(draw, [0, done], "drawn"),
    ...(frame.showTravel ? inSight(travel, [0, until(travel)], "travel") : []),
  ];
};

/** The moment, s, at which pieces of this style are cut off; Infinity: they are drawn to their ends. */
export const cutOffS = ({ untilS }: Frame, style: PieceStyle): number =>
  style === "drawn" || style === "travel" ? (untilS ?? Infinity) : Infinity;

/**
 * Draws up to `pieceCount` pieces, removes them from `tasks` and returns their number. `draw` returns false if it can't
 * draw now.
 */
export const drawSome = <B extends Boxed>(
  tasks: Task<B>[],
  pieceCount: number,
  draw: (task: Task<B>, to: number) => boolean,
): number => {
  let drawn = 0;
  while (drawn < pieceCount && tasks.length > 0) {
    const task = tasks[0];
    const to = Math.min(task.to, task.from + pieceCount - drawn);
    if (!draw(task, to)) break;
    drawn += to - task.from;
    task.from = to;
    if (to === task.to) tasks.shift();
  }
  return drawn;
};

/** The number of pieces in the tasks. */
export const piecesOf = (tasks: readonly Task<Boxed>[]): number =>
  tasks.reduce((sum, { from, to }) => sum + to - from, 0);

const PIECES_A_BOX = 512;
/** Limits the number of boxes, because each may cost a draw call. More pieces make larger boxes. */
const MAX_BOXES = 2_048;

/**
 * Boxes around every few hundred pieces, in order, which find the visible pieces. So the cost of a view depends on what is
 * in it.
 */
interface PieceBoxes {
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
  const [ax, ay] = mmFromScreen(view, -reachPx, -reachPx);
  const [bx, by] = mmFromScreen(view, width + reachPx, height + reachPx);
  const [x0, y0, x1, y1] = [Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)];
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
