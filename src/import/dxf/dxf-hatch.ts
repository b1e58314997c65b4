/**
 * The boundaries of a HATCH: polylines, or chains of lines, arcs and splines in either direction (AutoCAD DXF
 * reference, HATCH and its boundary path data). Each becomes a closed ring.
 */
import { PAIRS_OF_VERB, VERB_CLOSE, VERB_CUBIC } from "../../drawing/drawing.js";
import { IDENTITY } from "../../geometry/affine.js";
import {
  bulgedVertices,
  numberIn,
  numberOf,
  numbersIn,
  pointsIn,
  requiredPoint,
  splitAt,
  type DxfGroup,
  type DxfPoint,
  distance,
} from "./dxf-groups.js";
import { arc, polyline, turnBetween, type Outline } from "./dxf-shapes.js";
import { bSpline } from "./dxf-spline.js";
import { ShapeBuffer } from "../shape-buffer.js";
import { RAD_PER_DEG } from "../../units.js";

/** The outlines of a ring's edges. A polyline is one outline. */
export type HatchLoop = readonly Outline[];

const LOOP = 92;
const IS_POLYLINE = 2;
const EDGE = 72;
/** The paths are between their count and the style of the hatch. */
const PATH_COUNT = 91;
const STYLE = 75;
const TURN = 2 * Math.PI;

export function readHatchLoops(groups: readonly DxfGroup[]): HatchLoop[] {
  const from = groups.findIndex(({ code }) => code === PATH_COUNT) + 1;
  const style = groups.findIndex(({ code }, i) => i >= from && code === STYLE);
  const paths = splitAt(groups.slice(from, style < 0 ? undefined : style), LOOP);
  return ofStyle(paths, Number(groups[style]?.value ?? 0)).map(([flags, ...path]) =>
    (Number(flags.value) & IS_POLYLINE) !== 0
      ? [polyline(bulgedVertices(path), true)]
      : splitAt(path, EDGE)
          .map(edgeOf)
          .filter((edge) => edge !== null),
  );
}

/**
 * Style 1 ignores everything inside islands, style 2 all islands: flag 1 marks an outer loop, 16 an outermost
 * island.
 */
function ofStyle(paths: readonly DxfGroup[][], style: number): readonly DxfGroup[][] {
  const marks = style === 1 ? 1 | 16 : style === 2 ? 1 : 0;
  const kept = paths.filter(([flags]) => marks === 0 || (Number(flags.value) & marks) !== 0);
  // Some programs do not mark their loops.
  return kept.length > 0 ? kept : paths;
}

function edgeOf([kind, ...groups]: readonly DxfGroup[]): Outline | null {
  if (!groups.some(({ code }) => code === 10)) return null;
  const at = requiredPoint(groups, 10);
  const size = numberIn(groups, 40) ?? 0;
  switch (numberOf(kind)) {
    case 1:
      return polyline([at, requiredPoint(groups, 11)], false);
    case 2: {
      const { start, end } = anglesOf(groups, 1);
      return arc(at, size, size, 0, start, turnBetween(start, end));
    }
    case 3: {
      const axis = requiredPoint(groups, 11);
      const rx = Math.hypot(axis.x, axis.y);
      const { start, end } = anglesOf(groups, size);
      return arc(at, rx, rx * size, Math.atan2(axis.y, axis.x), start, turnBetween(start, end));
    }
    case 4:
      return bSpline(
        numberIn(groups, 94) ?? 3,
        pointsIn(groups, 10),
        numbersIn(groups, 40),
        numbersIn(groups, 42),
      );
    default:
      return null;
  }
}

/** Anticlockwise, rad, as the ellipse's parameter. The file measures the angles of clockwise arcs clockwise. */
function anglesOf(groups: readonly DxfGroup[], axisRatio: number): { start: number; end: number } {
  const start = numberIn(groups, 50) ?? 0;
  const end = numberIn(groups, 51) ?? 360;
  if (Math.abs(end - start) > 360 - 1e-9) return { start: 0, end: TURN };
  const parameter = (deg: number): number => {
    const angle = deg * RAD_PER_DEG;
    return axisRatio === 1 ? angle : Math.atan2(Math.sin(angle), axisRatio * Math.cos(angle));
  };
  const isClockwise = numberIn(groups, 73) === 0;
  return isClockwise
    ? { start: parameter(-end), end: parameter(-start) }
    : { start: parameter(start), end: parameter(end) };
}

/** Draws each loop as a closed ring, in the file's units, y up. */
export function drawHatch(loops: readonly HatchLoop[], shape: ShapeBuffer, arcTolerance: number): void {
  for (const loop of loops) {
    const chain: Piece[] = [];
    for (const edge of loop) {
      const drawn = new ShapeBuffer();
      edge(drawn, arcTolerance);
      drawn.finish();
      // A polyline or full circle is a ring by itself.
      if (drawn.verbs.data[drawn.verbs.length - 1] === VERB_CLOSE) shape.append(drawn, IDENTITY);
      else if (!drawn.isEmpty) chain.push(pieceOf(drawn));
    }
    drawRing(chain, shape);
  }
}

/** A chain of lines and curves, which can be reversed. */
interface Piece {
  readonly verbs: readonly number[];
  readonly points: readonly DxfPoint[];
}

function pieceOf({ verbs, coords }: ShapeBuffer): Piece {
  const xy = coords.data;
  return {
    verbs: Array.from(verbs.data.subarray(1, verbs.length)),
    points: Array.from({ length: coords.length / 2 }, (_, i) => ({ x: xy[2 * i], y: xy[2 * i + 1] })),
  };
}

const reversed = ({ verbs, points }: Piece): Piece => ({
  verbs: [...verbs].reverse(),
  points: [...points].reverse(),
});

const first = ({ points }: Piece): DxfPoint => points[0];
const last = ({ points }: Piece): DxfPoint => points[points.length - 1];

/** Draws each piece in the direction that continues from the previous one. */
function drawRing(chain: readonly Piece[], shape: ShapeBuffer): void {
  if (chain.length === 0) return;
  let [piece, next] = chain;
  if (next !== undefined && gapTo(next, first(piece)) < gapTo(next, last(piece))) piece = reversed(piece);
  shape.moveTo(first(piece).x, first(piece).y);
  addPiece(piece, shape);
  for (next of chain.slice(1)) {
    const end = last(piece);
    piece = distance(end, last(next)) < distance(end, first(next)) ? reversed(next) : next;
    if (distance(end, first(piece)) > 0) shape.lineTo(first(piece).x, first(piece).y);
    addPiece(piece, shape);
  }
  shape.close();
}

const gapTo = (piece: Piece, point: DxfPoint): number =>
  Math.min(distance(first(piece), point), distance(last(piece), point));

/** The pen is at the piece's first point. */
function addPiece({ verbs, points }: Piece, shape: ShapeBuffer): void {
  let at = 1;
  for (const verb of verbs) {
    const [a, b, c] = points.slice(at, at + PAIRS_OF_VERB[verb]);
    if (verb === VERB_CUBIC) shape.cubicTo(a.x, a.y, b.x, b.y, c.x, c.y);
    else shape.lineTo(a.x, a.y);
    at += PAIRS_OF_VERB[verb];
  }
}
