/**
 * Compares what a virtual board has drawn with the drawing: what is missing, what is drawn more than once,
 * what lies beside it. For drawings whose strokes stay a few mm apart from one another and from themselves,
 * so that the nearest place of the drawing is the intended one.
 */
import type { StrokeSet } from "../../../src/index.js";

/** Tolerance: steps of the motors, rounded corners. */
const SAME_MM = 1e-9;

export interface DrawnTruth {
  /** The longest piece of the drawing that is not drawn. */
  readonly gapMm: number;
  /** Everything that is drawn more than once. */
  readonly overlapMm: number;
  /** Max distance of the drawn line from the drawing. */
  readonly awayMm: number;
}

interface Drawn {
  readonly penDown: boolean;
  readonly xy: ArrayLike<number>;
}

type Interval = readonly [from: number, to: number];

/**
 * @param besideMm a line that leaves the drawing by more than this is no part of it from there on, even where it crosses
 *   the drawing again; `awayMm` reports it
 */
export function compareDrawn(strokes: StrokeSet, drawn: readonly Drawn[], besideMm = Infinity): DrawnTruth {
  const rail = railOf(strokes);
  const intervals: Interval[] = [];
  let awayMm = 0;
  for (const { penDown, xy } of drawn) {
    if (!penDown || xy.length < 4) continue;
    const passed: Interval[] = [];
    let before: Nearest | null = null;
    let isBeside = false;
    for (let i = 0; i < xy.length; i += 2) {
      const now = nearest(rail, xy[i], xy[i + 1]);
      awayMm = Math.max(awayMm, now.awayMm);
      // A line between two strokes belongs to neither; `awayMm` reports it.
      isBeside ||= now.awayMm > besideMm;
      if (before?.stroke === now.stroke && !isBeside) {
        passed.push([Math.min(before.alongMm, now.alongMm), Math.max(before.alongMm, now.alongMm)]);
      }
      before = now;
    }
    intervals.push(...united(passed));
  }
  const covered = united(intervals);
  const sum = (list: readonly Interval[]): number => list.reduce((mm, [from, to]) => mm + to - from, 0);
  return { gapMm: longestGap(rail, covered), overlapMm: sum(intervals) - sum(covered), awayMm };
}

/** The largest distance of a point from the strokes, mm; `xy`: x, y, x, y … */
export function farthestFrom(strokes: StrokeSet, xy: ArrayLike<number>): number {
  const rail = railOf(strokes);
  let awayMm = 0;
  for (let i = 0; i < xy.length; i += 2) awayMm = Math.max(awayMm, nearest(rail, xy[i], xy[i + 1]).awayMm);
  return awayMm;
}

/** All strokes one after the other, along one axis. */
interface Piece {
  readonly stroke: number;
  readonly startMm: number;
  readonly lengthMm: number;
  readonly x: number;
  readonly y: number;
  readonly dx: number;
  readonly dy: number;
}

function railOf({ xy, offsets }: StrokeSet): readonly Piece[] {
  const pieces: Piece[] = [];
  let startMm = 0;
  for (let stroke = 0; stroke + 1 < offsets.length; stroke++) {
    for (let i = offsets[stroke]; i + 1 < offsets[stroke + 1]; i++) {
      const [x, y] = [xy[2 * i], xy[2 * i + 1]];
      const [dx, dy] = [xy[2 * i + 2] - x, xy[2 * i + 3] - y];
      const lengthMm = Math.hypot(dx, dy);
      pieces.push({ stroke, startMm, lengthMm, x, y, dx, dy });
      startMm += lengthMm;
    }
  }
  return pieces;
}

interface Nearest {
  readonly stroke: number;
  readonly alongMm: number;
  readonly awayMm: number;
}

function nearest(rail: readonly Piece[], px: number, py: number): Nearest {
  let found: Piece | null = null;
  let foundShare = 0;
  // Squares: this runs for every point that a board has drawn, and Math.hypot is slow.
  let away2 = Infinity;
  for (const piece of rail) {
    const { lengthMm, x, y, dx, dy } = piece;
    const along = lengthMm > 0 ? ((px - x) * dx + (py - y) * dy) / (lengthMm * lengthMm) : 0;
    const share = Math.min(1, Math.max(0, along));
    const awayX = x + share * dx - px;
    const awayY = y + share * dy - py;
    const piece2 = awayX * awayX + awayY * awayY;
    if (piece2 >= away2) continue;
    away2 = piece2;
    found = piece;
    foundShare = share;
  }
  const awayMm = Math.sqrt(away2);
  if (!found) return { stroke: -1, alongMm: 0, awayMm };
  return { stroke: found.stroke, alongMm: found.startMm + foundShare * found.lengthMm, awayMm };
}

function united(intervals: readonly Interval[]): Interval[] {
  const result: [number, number][] = [];
  for (const [from, to] of [...intervals].sort((a, b) => a[0] - b[0])) {
    const last = result[result.length - 1];
    if (last && from <= last[1] + SAME_MM) last[1] = Math.max(last[1], to);
    else result.push([from, to]);
  }
  return result;
}

function longestGap(rail: readonly Piece[], covered: readonly Interval[]): number {
  const end = rail.reduce((mm, { startMm, lengthMm }) => Math.max(mm, startMm + lengthMm), 0);
  let [gapMm, reached] = [0, 0];
  for (const [from, to] of [...covered, [end, end] as const]) {
    gapMm = Math.max(gapMm, from - reached);
    reached = Math.max(reached, to);
  }
  return gapMm;
}
