/**
 * The pattern of a HATCH as lines: families of parallel lines, each with its own dashes, cut to the boundary
 * (AutoCAD DXF reference, hatch pattern data). The file stores angles, offsets and dashes already rotated and
 * scaled.
 *
 *        ╱     ╱         o     base point of line 0
 *       ╱  ↗  ╱          ↗     offset to the next line: spacing across, and shift of the dashes along it
 *      o     ╱           u, v  along the lines and across them; line k is v = v(base) + k · spacing
 *
 * Method: the edges of the boundary, with curves as chords, are intersected with the lines; the crossings of
 * each line are sorted; inside and outside alternate (even-odd, as for islands). Dashes start at the line's
 * own base point.
 */
import { numberIn, numbersIn, splitAt, type DxfGroup, type DxfPoint } from "./dxf-groups.js";
import { getOrAdd } from "../../get-or-add.js";
import type { ShapeBuffer } from "../shape-buffer.js";
import { RAD_PER_DEG } from "../../units.js";
import { subpathsOf } from "../../drawing/flatten.js";

/** Parallel lines. */
export interface PatternLine {
  readonly angleDeg: number;
  readonly base: DxfPoint;
  readonly offset: DxfPoint;
  /** Dash lengths: positive is drawn, negative is a gap, 0 a dot. Empty: a solid line. */
  readonly dashes: readonly number[];
}

const LINE_COUNT = 78;
const LINE = 53;
const SEED_COUNT = 98;
/** Max lines and dashes of one hatch: more is a wrong scale, or as dense as a filled area. */
const MAX_PIECES = 200_000;

export function readPattern(groups: readonly DxfGroup[]): PatternLine[] {
  const from = groups.findIndex(({ code }) => code === LINE_COUNT);
  if (from < 0) return [];
  // The seed points follow the pattern.
  const seeds = groups.findIndex(({ code }, i) => i > from && code === SEED_COUNT);
  const at = (line: readonly DxfGroup[], code: number): number => numberIn(line, code) ?? 0;
  return splitAt(groups.slice(from + 1, seeds < 0 ? undefined : seeds), LINE).map((line) => ({
    angleDeg: at(line, LINE),
    base: { x: at(line, 43), y: at(line, 44) },
    offset: { x: at(line, 45), y: at(line, 46) },
    dashes: numbersIn(line, 49),
  }));
}

/** Draws the pattern within the rings; returns false, and draws nothing, if it has no lines or too many. */
export function drawPattern(
  rings: ShapeBuffer,
  pattern: readonly PatternLine[],
  shape: ShapeBuffer,
  tolerance: number,
): boolean {
  const polygons = subpathsOf({ verbs: rings.verbs.view(), coords: rings.coords.data }, tolerance)
    .map(({ xy }) => xy)
    .filter((xy) => xy.length > 4);
  const cuts = pattern.map((line) => cutsOf(polygons, line));
  let pieces = 0;
  for (const cut of cuts) pieces += cut === null ? Infinity : cut.pieces;
  if (pattern.length === 0 || polygons.length === 0 || !(pieces <= MAX_PIECES)) return false;
  for (const cut of cuts) if (cut !== null) drawCuts(cut, shape);
  return true;
}

/** Crossings of one family's lines with the boundary: u values by line number. */
interface Cuts {
  readonly line: PatternLine;
  readonly cos: number;
  readonly sin: number;
  readonly spacing: number;
  /** Length after which the dashes repeat; 0 for solid lines. */
  readonly period: number;
  readonly byLine: ReadonlyMap<number, readonly number[]>;
  /** Max number of lines and dashes it produces. */
  readonly pieces: number;
}

/** Null if the lines coincide, or would be too many to count. */
function cutsOf(polygons: readonly Float64Array[], line: PatternLine): Cuts | null {
  const { base, offset, angleDeg, dashes } = line;
  const [cos, sin] = [Math.cos(angleDeg * RAD_PER_DEG), Math.sin(angleDeg * RAD_PER_DEG)];
  const spacing = offset.y * cos - offset.x * sin;
  const period = dashes.reduce((sum, dash) => sum + Math.abs(dash), 0);
  const byLine = new Map<number, number[]>();
  let count = 0;
  for (const xy of polygons) {
    for (let p = 0, q = xy.length - 2; p < xy.length; q = p, p += 2) {
      const [u0, k0] = [xy[q] - base.x, xy[q + 1] - base.y];
      const [u1, k1] = [xy[p] - base.x, xy[p + 1] - base.y];
      const [n0, n1] = [(k0 * cos - u0 * sin) / spacing, (k1 * cos - u1 * sin) / spacing];
      // A vertex on a line counts for only one of its two edges.
      const [first, end] = [Math.ceil(Math.min(n0, n1)), Math.ceil(Math.max(n0, n1))];
      count += end - first;
      if (!(count <= 2 * MAX_PIECES)) return null;
      const [along0, along1] = [u0 * cos + k0 * sin, u1 * cos + k1 * sin];
      for (let k = first; k < end; k++) {
        const u = along0 + ((k - n0) / (n1 - n0)) * (along1 - along0);
        getOrAdd(byLine, k, () => []).push(u);
      }
    }
  }
  let pieces = 0;
  for (const cuts of byLine.values()) {
    cuts.sort((a, b) => a - b);
    for (let i = 0; i + 1 < cuts.length; i += 2)
      pieces += period > 0 ? dashes.length * ((cuts[i + 1] - cuts[i]) / period + 1) : 1;
  }
  return { line, cos, sin, spacing, period, byLine, pieces };
}

function drawCuts({ line, cos, sin, spacing, period, byLine }: Cuts, shape: ShapeBuffer): void {
  const { base, offset, dashes } = line;
  const shift = offset.x * cos + offset.y * sin;
  for (const [k, cuts] of [...byLine].sort(([a], [b]) => a - b)) {
    const v = k * spacing;
    const piece = (from: number, to: number): void => {
      shape.moveTo(base.x + from * cos - v * sin, base.y + from * sin + v * cos);
      shape.lineTo(base.x + to * cos - v * sin, base.y + to * sin + v * cos);
    };
    for (let i = 0; i + 1 < cuts.length; i += 2) {
      if (!(cuts[i + 1] > cuts[i])) continue;
      if (period > 0) drawDashes(dashes, period, k * shift, cuts[i], cuts[i + 1], piece);
      else piece(cuts[i], cuts[i + 1]);
    }
  }
}

/** Draws the dashes, which start at `origin`, between two crossings. */
function drawDashes(
  dashes: readonly number[],
  period: number,
  origin: number,
  from: number,
  to: number,
  piece: (from: number, to: number) => void,
): void {
  const turns = [Math.floor((from - origin) / period), Math.ceil((to - origin) / period)] as const;
  for (let turn = turns[0]; turn < turns[1]; turn++) {
    let at = origin + turn * period;
    for (const dash of dashes) {
      const [start, end] = [Math.max(at, from), Math.min(at + Math.abs(dash), to)];
      if (dash >= 0 && (end > start || (dash === 0 && end === start && start < to))) piece(start, end);
      at += Math.abs(dash);
    }
  }
}
