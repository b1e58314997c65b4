/**
 * The pen's moves on their way from the worker to the page: columns that are handed over, not a million objects that
 * are copied one by one while the page stands still. On the page's side a move is made when it is asked for.
 */
import type { PenMove } from "../../src/index.js";

export interface PenColumns {
  readonly beforeRun: Uint32Array;
  readonly up: Uint8Array;
  readonly startS: Float64Array;
  readonly waitS: Float32Array;
  readonly heightPct: Float32Array;
}

export const penColumnsOf = (moves: readonly PenMove[]): PenColumns => ({
  beforeRun: Uint32Array.from(moves, (move) => move.beforeRun),
  up: Uint8Array.from(moves, (move) => Number(move.up)),
  startS: Float64Array.from(moves, (move) => move.startS),
  waitS: Float32Array.from(moves, (move) => move.waitS),
  heightPct: Float32Array.from(moves, (move) => move.heightPct),
});

/** Reads like the array that the columns were made from. */
export const penMovesOf = (columns: PenColumns): readonly PenMove[] => {
  const { beforeRun, up, startS, waitS, heightPct } = columns;
  const moveAt = (i: number): PenMove => ({
    beforeRun: beforeRun[i]!,
    up: up[i] === 1,
    startS: startS[i]!,
    waitS: waitS[i]!,
    heightPct: heightPct[i]!,
  });
  const count = startS.length;
  const isIndex = (key: string | symbol): key is string =>
    typeof key === "string" && /^\d+$/.test(key) && Number(key) < count;
  return new Proxy<readonly PenMove[]>([], {
    get: (target, key) => {
      if (key === "length") return count;
      return isIndex(key) ? moveAt(Number(key)) : (Reflect.get(target, key) as unknown);
    },
    has: (target, key) => isIndex(key) || Reflect.has(target, key),
  });
};
