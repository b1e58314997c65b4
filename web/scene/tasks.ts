/** What of a scene goes into a picture, in order from below to above; the same for every renderer. */
import { coarsePieces } from "./coarse.js";
import { boxPieces, rangesInSight, type PieceBoxes, type PieceRange } from "./piece-boxes.js";
import { lineWidthPx, type Detail, type Frame, type Picture } from "./renderer.js";
import type { Pieces } from "./pieces.js";
import { piecesBefore } from "./scene.js";

export interface Boxed {
  readonly pieces: Pieces;
  readonly boxes: PieceBoxes;
}

/** What is drawn with the pen down, moves with the pen up, and what should have been drawn where that is shown. */
export interface Sheet<B extends Boxed> {
  readonly draw: B;
  readonly travel: B;
  readonly asked: B | null;
}

/** "ghost": not drawn yet at the moment that is looked at. */
export type Style = "asked" | "ghost" | "drawn" | "travel";

/** Pieces still to be drawn of a picture. */
export interface Task<B extends Boxed> {
  readonly of: B;
  readonly style: Style;
  readonly to: number;
  from: number;
}

/** Beyond the line, for its smooth edge. */
const EDGE_PX = 2;

/** A scene in both details; `load` may add what a renderer keeps of each list of pieces. */
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

/** What is in sight: what is not drawn yet, what is, the moves of the pen that is up. */
export const tasksOf = <B extends Boxed>(frame: Frame, { draw, travel, asked }: Sheet<B>): Task<B>[] => {
  const until = ({ pieces }: Boxed): number =>
    frame.untilS === null ? pieces.count : piecesBefore(pieces, frame.untilS);
  const widestMm = Math.max(frame.lineMm, ...(frame.layerWidthsMm ?? []));
  const reachPx = lineWidthPx(frame, widestMm) / 2 + EDGE_PX;
  const done = until(draw);
  // The piece that the pen is on is drawn up to the pen only, and pale behind it.
  const pale = frame.untilS === null ? done : Math.max(0, done - 1);
  const inSight = (of: B, range: PieceRange, style: Style): Task<B>[] =>
    rangesInSight(of.boxes, range, frame, reachPx).map(([from, to]) => ({ of, style, from, to }));
  return [
    ...(asked ? inSight(asked, [0, asked.pieces.count], "asked") : []),
    ...inSight(draw, [pale, draw.pieces.count], "ghost"),
    ...inSight(draw, [0, done], "drawn"),
    ...(frame.showTravel ? inSight(travel, [0, until(travel)], "travel") : []),
  ];
};

/** The moment, s, at which pieces of this style are cut off; Infinity: they are drawn to their ends. */
export const cutOffS = ({ untilS }: Frame, style: Style): number =>
  style === "drawn" || style === "travel" ? (untilS ?? Infinity) : Infinity;

/** Draws about so many more of the pieces and takes off what is done; returns how many. `draw` says false while it can't. */
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

/** How many pieces that is. */
export const piecesOf = (tasks: readonly Task<Boxed>[]): number =>
  tasks.reduce((sum, { from, to }) => sum + to - from, 0);
