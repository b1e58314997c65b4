/** A plan's pen moves: stored in columns, read as objects. */
import { firstWhere } from "../../geometry/binary-search.js";
import { SAME_TIME_S, type PenMove, type PenMoveColumns } from "../trajectory.js";

export class PenMoveWriter implements PenMoveColumns {
  count = 0;
  readonly beforeRun: Uint32Array;
  readonly up: Uint8Array;
  readonly startS: Float64Array;
  readonly waitS: Float64Array;
  readonly moveS: Float64Array;
  readonly heightPct: Float64Array;

  /** @param max the maximum number of moves */
  constructor(max: number) {
    this.beforeRun = new Uint32Array(max);
    this.up = new Uint8Array(max);
    this.startS = new Float64Array(max);
    this.waitS = new Float64Array(max);
    this.moveS = new Float64Array(max);
    this.heightPct = new Float64Array(max);
  }

  push(move: PenMove): void {
    const i = this.count++;
    this.beforeRun[i] = move.beforeRun;
    this.up[i] = move.up ? 1 : 0;
    this.startS[i] = move.startS;
    this.waitS[i] = move.waitS;
    this.moveS[i] = move.moveS;
    this.heightPct[i] = move.heightPct;
  }

  /** Plain columns, which can be posted to a worker. */
  finish(): PenMoveColumns {
    const { count, beforeRun, up, startS, waitS, moveS, heightPct } = this;
    return { count, beforeRun, up, startS, waitS, moveS, heightPct };
  }
}

export const penMoveAt = (moves: PenMoveColumns, i: number): PenMove => ({
  beforeRun: moves.beforeRun[i],
  up: moves.up[i] === 1,
  startS: moves.startS[i],
  waitS: moves.waitS[i],
  moveS: moves.moveS[i],
  heightPct: moves.heightPct[i],
});

/** The drop of a plan that begins with the pen down: it was made before the plan's time 0. */
export const loweredBefore = (heightPct: number): PenMove => ({
  ...{ beforeRun: 0, up: false, startS: -1, waitS: 0, moveS: 0 },
  heightPct,
});

interface WithPenMoves {
  readonly penMoves: PenMoveColumns;
}

export const penMovesOf = ({ penMoves }: WithPenMoves): PenMove[] =>
  Array.from({ length: penMoves.count }, (_, i) => penMoveAt(penMoves, i));

export function penMoveColumns(moves: readonly PenMove[]): PenMoveColumns {
  const writer = new PenMoveWriter(moves.length);
  for (const move of moves) writer.push(move);
  return writer.finish();
}

/** The last pen move that begins before `tS`; null if there is none. */
export function penMoveBefore({ penMoves }: WithPenMoves, tS: number): PenMove | null {
  const next = firstWhere(0, penMoves.count, (i) => penMoves.startS[i] >= tS - SAME_TIME_S);
  return next > 0 ? penMoveAt(penMoves, next - 1) : null;
}

/** True if the last pen move before `tS` lifts the pen, or there is none. */
export const isPenUpBefore = (plan: WithPenMoves, tS: number): boolean => penMoveBefore(plan, tS)?.up ?? true;
