/** SPLINE of a DXF: B-splines, also rational, and smooth curves through points. Units of the file, y up. */
import type { ShapeBuffer } from "../shape-buffer.js";
import {
  hasFlag,
  numberIn,
  numbersIn,
  OddValue,
  pointIn,
  pointsIn,
  type DxfGroup,
  type DxfPoint,
  distance,
} from "./dxf-groups.js";
import type { Outline } from "./dxf-shapes.js";
import { cubicAt } from "../../drawing/curve-box.js";
import { clamp } from "../../geometry/polyline.js";

interface BSpline {
  readonly degree: number;
  readonly points: readonly DxfPoint[];
  readonly knots: readonly number[];
  /** One for each point; empty if all are equal. */
  readonly weights: readonly number[];
}

const IS_CLOSED = 1;
/** Degrees above this one occur only in damaged files. */
const MAX_DEGREE = 25;
/** Each halving makes the gap to the curve 16 times smaller. */
const MAX_HALVINGS = 10;
/** Where the gap between the curve and its cubic is measured, as shares of the piece. */
const MEASURED_AT = [0.25, 0.5, 0.75];
/** Points beyond the ends of a closed curve. The influence of a point falls by 3.7 with each further one. */
const OVERLAP = 24;

/** By its control points, or else through its fit points. */
export function readSpline(groups: readonly DxfGroup[]): Outline {
  const points = pointsIn(groups, 10);
  const fit = pointsIn(groups, 11);
  const knots = numbersIn(groups, 40);
  const degree = numberIn(groups, 71) ?? 3;
  const isClosed = hasFlag(groups, 70, IS_CLOSED);
  if (points.length > 0 && (knots.length > 0 || fit.length === 0))
    return bSpline(
      degree,
      points,
      knots.length > 0 ? knots : clampedKnots(points.length, degree),
      numbersIn(groups, 41),
    );
  if (fit.length < 2) throw new OddValue("it has no points");
  const [startTangent, endTangent] = [pointIn(groups, 12) ?? null, pointIn(groups, 13) ?? null];
  return (shape) => drawThrough({ points: fit, isClosed, startTangent, endTangent }, shape);
}

/** A smooth curve without given directions at its ends. */
export const throughPoints =
  (points: readonly DxfPoint[]): Outline =>
  (shape) =>
    drawThrough({ points, isClosed: false, startTangent: null, endTangent: null }, shape);

/** The usual knots of a curve that begins and ends at its control points, for files without knots. */
const clampedKnots = (points: number, degree: number): number[] =>
  Array.from({ length: points + degree + 1 }, (_, i) => clamp(i - degree, 0, points - degree));

/** Weights that are all equal, whatever their value, mean a spline without weights. Throws OddValue. */
export function bSpline(
  degree: number,
  points: readonly DxfPoint[],
  knots: readonly number[],
  allWeights: readonly number[],
): Outline {
  if (!(Number.isInteger(degree) && degree >= 1 && degree <= MAX_DEGREE))
    throw new OddValue(`its degree is ${degree}`);
  if (points.length <= degree || knots.length !== points.length + degree + 1)
    throw new OddValue(`${points.length} points and ${knots.length} knots do not match degree ${degree}`);
  const weights = allWeights.every((weight) => weight === allWeights[0]) ? [] : allWeights;
  if (weights.length > 0 && weights.length !== points.length)
    throw new OddValue(`it has ${points.length} points, but ${weights.length} weights`);
  if (weights.some((weight) => !(weight > 0))) throw new OddValue("a weight is not above 0");
  return (shape, tolerance) => drawBSpline({ degree, points, knots, weights }, shape, tolerance);
}

/**
 * Each span of a B-spline is a Bézier curve whose control points are its blossom at u_i … u_i, u_{i+1} …
 * u_{i+1} (Ramshaw 1987): exact for degrees 1 to 3. Rational spans, and those of a higher degree, become
 * cubic curves within the tolerance.
 */
function drawBSpline(spline: BSpline, shape: ShapeBuffer, tolerance: number): void {
  const { degree, points, knots, weights } = spline;
  let isFirst = true;
  for (let span = degree; span < points.length; span++) {
    const u0 = knots[span];
    const u1 = knots[span + 1];
    if (!(u1 > u0)) continue;
    const control = (ends: number): [number, number] => {
      const [x, y, w] = blossom(spline, span, (level) => (level < ends ? u1 : u0));
      return [x / w, y / w];
    };
    if (isFirst) shape.moveTo(...control(0));
    isFirst = false;
    if (weights.length > 0 || degree > 3) {
      drawFitted((u) => at(spline, span, u), u0, u1, shape, tolerance, MAX_HALVINGS);
    } else if (degree === 1) shape.lineTo(...control(1));
    else if (degree === 2) shape.quadraticTo(...control(1), ...control(2));
    else shape.cubicTo(...control(1), ...control(2), ...control(3));
  }
}

/** A point of a curve, and its derivative by the parameter. */
interface Sample {
  readonly x: number;
  readonly y: number;
  readonly dx: number;
  readonly dy: number;
}

/** Draws the curve from the pen's position at u0 to u1 as cubics with its points and tangents. */
function drawFitted(
  curve: (u: number) => Sample,
  u0: number,
  u1: number,
  shape: ShapeBuffer,
  tolerance: number,
  halvings: number,
): void {
  const [a, b] = [curve(u0), curve(u1)];
  const third = (u1 - u0) / 3;
  const [x1, y1] = [a.x + a.dx * third, a.y + a.dy * third];
  const [x2, y2] = [b.x - b.dx * third, b.y - b.dy * third];
  const isClose = MEASURED_AT.every((t) => {
    const exact = curve(u0 + t * (u1 - u0));
    const dx = cubicAt(a.x, x1, x2, b.x, t) - exact.x;
    const dy = cubicAt(a.y, y1, y2, b.y, t) - exact.y;
    return Math.hypot(dx, dy) <= tolerance;
  });
  if (isClose || halvings === 0) {
    shape.cubicTo(x1, y1, x2, y2, b.x, b.y);
    return;
  }
  const middle = (u0 + u1) / 2;
  drawFitted(curve, u0, middle, shape, tolerance, halvings - 1);
  drawFitted(curve, middle, u1, shape, tolerance, halvings - 1);
}

/** The derivative of a blossom of degree p: p (b(u … u, u1) − b(u … u, u0)) / (u1 − u0). */
function at(spline: BSpline, span: number, u: number): Sample {
  const { degree, knots } = spline;
  const [x, y, w] = blossom(spline, span, () => u);
  const [u0, u1] = [knots[span], knots[span + 1]];
  const [xa, ya, wa] = blossom(spline, span, (level) => (level === 0 ? u0 : u));
  const [xb, yb, wb] = blossom(spline, span, (level) => (level === 0 ? u1 : u));
  const speed = degree / (u1 - u0);
  const dw = speed * (wb - wa);
  return {
    x: x / w,
    y: y / w,
    dx: (speed * (xb - xa) - (dw * x) / w) / w,
    dy: (speed * (yb - ya) - (dw * y) / w) / w,
  };
}

/** De Boor's algorithm with a separate argument on each level, in homogeneous coordinates. */
function blossom(
  { degree, points, knots, weights }: BSpline,
  span: number,
  argument: (level: number) => number,
): [number, number, number] {
  const x: number[] = [];
  const y: number[] = [];
  const w: number[] = [];
  for (let j = 0; j <= degree; j++) {
    const point = points[span - degree + j];
    const weight = weights.length === 0 ? 1 : weights[span - degree + j];
    x.push(point.x * weight);
    y.push(point.y * weight);
    w.push(weight);
  }
  for (let level = 1; level <= degree; level++) {
    const u = argument(level - 1);
    for (let j = degree; j >= level; j--) {
      const low = knots[span - degree + j];
      const high = knots[span + j - level + 1];
      const t = high > low ? (u - low) / (high - low) : 0;
      x[j] = (1 - t) * x[j - 1] + t * x[j];
      y[j] = (1 - t) * y[j - 1] + t * y[j];
      w[j] = (1 - t) * w[j - 1] + t * w[j];
    }
  }
  return [x[degree], y[degree], w[degree]];
}

interface FitPoints {
  readonly points: readonly DxfPoint[];
  readonly isClosed: boolean;
  /** Directions at the ends; null where the curve just runs out. */
  readonly startTangent: DxfPoint | null;
  readonly endTangent: DxfPoint | null;
}

/**
 * The cubic spline through the points, with their chords as parameter, as CAD programs draw it: curvature
 * does not jump. An end without tangent has no curvature.
 */
function drawThrough({ points, isClosed, startTangent, endTangent }: FitPoints, shape: ShapeBuffer): void {
  const distinct = points.filter(
    (point, i) => i === 0 || point.x !== points[i - 1].x || point.y !== points[i - 1].y,
  );
  const n = distinct.length;
  if (n < 2) return;
  const [first, last] = [distinct[0], distinct[n - 1]];
  const isRing = isClosed && n > 2;
  if (isRing && first.x === last.x && first.y === last.y) distinct.pop();
  // A ring is drawn from the middle of a longer curve that goes around several times.
  const around = distinct.length;
  const before = isRing ? OVERLAP : 0;
  const run = isRing
    ? Array.from(
        { length: around + 1 + 2 * OVERLAP },
        (_, i) => distinct[(i + OVERLAP * (around - 1)) % around],
      )
    : distinct;
  const chords = run.slice(1).map((point, i) => distance(run[i], point));
  const [start, end] = isRing ? [null, null] : [startTangent, endTangent];
  const dx = slopes(
    run.map(({ x }) => x),
    chords,
    unitOf(start)?.x,
    unitOf(end)?.x,
  );
  const dy = slopes(
    run.map(({ y }) => y),
    chords,
    unitOf(start)?.y,
    unitOf(end)?.y,
  );
  shape.moveTo(run[before].x, run[before].y);
  for (let i = before; i + 1 < run.length - before; i++) {
    const [a, b, third] = [run[i], run[i + 1], chords[i] / 3];
    shape.cubicTo(
      a.x + dx[i] * third,
      a.y + dy[i] * third,
      b.x - dx[i + 1] * third,
      b.y - dy[i + 1] * third,
      b.x,
      b.y,
    );
  }
  if (isRing) shape.close();
}

function unitOf(vector: DxfPoint | null): DxfPoint | null {
  const length = vector === null ? 0 : Math.hypot(vector.x, vector.y);
  return vector === null || length === 0 ? null : { x: vector.x / length, y: vector.y / length };
}

/** Derivatives at the points of a cubic spline through the values: a tridiagonal system, by elimination. */
function slopes(
  values: readonly number[],
  steps: readonly number[],
  start: number | undefined,
  end: number | undefined,
): number[] {
  const n = values.length;
  const rise = (i: number): number => (values[i + 1] - values[i]) / steps[i];
  // Row i: low · d[i−1] + mid · d[i] + high · d[i+1] = right.
  const high: number[] = [];
  const right: number[] = [];
  for (let i = 0; i < n; i++) {
    const isEnd = i === 0 || i === n - 1;
    const known = i === 0 ? start : end;
    const [low, mid, up, value] = !isEnd
      ? [
          1 / steps[i - 1],
          2 / steps[i - 1] + 2 / steps[i],
          1 / steps[i],
          3 * (rise(i - 1) / steps[i - 1] + rise(i) / steps[i]),
        ]
      : known !== undefined
        ? [0, 1, 0, known]
        : i === 0
          ? [0, 2, 1, 3 * rise(0)]
          : [1, 2, 0, 3 * rise(n - 2)];
    const pivot = i === 0 ? mid : mid - low * high[i - 1];
    high.push(up / pivot);
    right.push((value - (i === 0 ? 0 : low * right[i - 1])) / pivot);
  }
  for (let i = n - 2; i >= 0; i--) right[i] -= high[i] * right[i + 1];
  return right;
}
