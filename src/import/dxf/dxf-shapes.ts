/** DXF entities to verbs and coordinates in the file's units, y up. */
import type { DxfEntity, DxfPoint } from "dxf-parser/dist/dxf-parser.js";
import { drawCentreArc, drawSvgArc } from "../arc.js";
import type { ShapeBuffer } from "../shape-buffer.js";

/** Steps per span of a spline whose degree cannot be drawn as a Bézier. */
const STEPS_PER_SPAN = 32;

/** Draws the entity; returns false for a type that has no lines. */
export function drawDxfEntity(entity: DxfEntity, shape: ShapeBuffer, arcTolerance: number): boolean {
  switch (entity.type) {
    case "LINE":
      drawVertices(entity.vertices ?? [], false, shape, arcTolerance);
      return true;
    case "LWPOLYLINE":
    case "POLYLINE": {
      // Control points of a fitted curve are not on it.
      const vertices = (entity.vertices ?? []).filter((vertex) => vertex.splineControlPoint !== true);
      drawVertices(vertices, entity.shape === true, shape, arcTolerance);
      return true;
    }
    case "SOLID":
    case "3DFACE": {
      const [a, b, c, d] = entity.points ?? entity.vertices ?? [];
      // A SOLID's third and fourth corners are swapped.
      const corners = entity.type === "SOLID" && d !== undefined ? [a, b, d, c] : [a, b, c, d];
      drawVertices(
        corners.filter((corner) => corner !== undefined),
        true,
        shape,
        arcTolerance,
      );
      return true;
    }
    case "POINT":
      if (entity.position !== undefined)
        drawVertices([entity.position, entity.position], false, shape, arcTolerance);
      return true;
    case "CIRCLE":
    case "ARC":
      drawArc(entity, shape, arcTolerance);
      return true;
    case "ELLIPSE":
      drawDxfEllipse(entity, shape, arcTolerance);
      return true;
    case "SPLINE":
      drawSpline(entity, shape);
      return true;
    default:
      return false;
  }
}

/**
 * Vertices with bulges: bulge = tan(θ/4) for an arc of angle θ, positive if anticlockwise.
 * Radius = chord (1 + b²) / (4 |b|).
 */
function drawVertices(
  vertices: readonly DxfPoint[],
  isClosed: boolean,
  shape: ShapeBuffer,
  arcTolerance: number,
): void {
  if (vertices.length === 0) return;
  shape.moveTo(vertices[0].x, vertices[0].y);
  const to = (from: DxfPoint, next: DxfPoint): void => {
    const bulge = from.bulge ?? 0;
    const chord = Math.hypot(next.x - from.x, next.y - from.y);
    if (Math.abs(bulge) < 1e-9 || chord === 0) {
      shape.lineTo(next.x, next.y);
      return;
    }
    const radius = (chord * (1 + bulge * bulge)) / (4 * Math.abs(bulge));
    drawSvgArc(shape, radius, radius, 0, Math.abs(bulge) > 1, bulge > 0, next.x, next.y, arcTolerance);
  };
  for (let i = 1; i < vertices.length; i++) to(vertices[i - 1], vertices[i]);
  if (!isClosed || vertices.length < 2) return;
  const last = vertices[vertices.length - 1];
  if ((last.bulge ?? 0) !== 0) to(last, vertices[0]);
  shape.close();
}

function drawArc(entity: DxfEntity, shape: ShapeBuffer, arcTolerance: number): void {
  const { center, radius = 0 } = entity;
  if (center === undefined || !(radius > 0)) return;
  const isCircle = entity.type === "CIRCLE";
  const start = isCircle ? 0 : (entity.startAngle ?? 0);
  const sweep = isCircle ? 2 * Math.PI : turnBetween(start, entity.endAngle ?? 2 * Math.PI);
  drawArcOf(shape, center, radius, radius, 0, start, sweep, arcTolerance);
}

function drawDxfEllipse(entity: DxfEntity, shape: ShapeBuffer, arcTolerance: number): void {
  const { center, majorAxisEndPoint: axis, axisRatio = 1 } = entity;
  if (center === undefined || axis === undefined) return;
  const rx = Math.hypot(axis.x, axis.y);
  const from = entity.startAngle ?? 0;
  const to = entity.endAngle ?? 2 * Math.PI;
  // With a normal that points down the ellipse runs clockwise: from a to b is anticlockwise from -b to -a.
  const [start, end] = (entity.extrusionDirectionZ ?? 1) < 0 ? [-to, -from] : [from, to];
  const sweep = turnBetween(start, end);
  if (rx > 0)
    drawArcOf(shape, center, rx, rx * axisRatio, Math.atan2(axis.y, axis.x), start, sweep, arcTolerance);
}

/** Anticlockwise angle from start to end; a full turn if they coincide. */
function turnBetween(start: number, end: number): number {
  const turn = (end - start) % (2 * Math.PI);
  return turn > 1e-9 ? turn : turn + 2 * Math.PI;
}

function drawArcOf(
  shape: ShapeBuffer,
  center: DxfPoint,
  rx: number,
  ry: number,
  tilt: number,
  start: number,
  sweep: number,
  arcTolerance: number,
): void {
  const pointAt = (angle: number): [number, number] => {
    const x = rx * Math.cos(angle);
    const y = ry * Math.sin(angle);
    return [
      center.x + x * Math.cos(tilt) - y * Math.sin(tilt),
      center.y + x * Math.sin(tilt) + y * Math.cos(tilt),
    ];
  };
  const isWhole = sweep > 2 * Math.PI - 1e-9;
  const [x0, y0] = pointAt(start);
  const [x1, y1] = isWhole ? [x0, y0] : pointAt(start + sweep);
  shape.moveTo(x0, y0);
  drawCentreArc(shape, center.x, center.y, rx, ry, tilt, start, sweep, x1, y1, arcTolerance);
  if (isWhole) shape.close();
}

function drawSpline(entity: DxfEntity, shape: ShapeBuffer): void {
  const degree = entity.degreeOfSplineCurve ?? 3;
  const points = entity.controlPoints ?? [];
  const knots = entity.knotValues ?? [];
  if (points.length > degree && knots.length === points.length + degree + 1 && degree >= 1) {
    drawBSpline(points, knots, degree, shape);
  } else {
    drawThrough(entity.fitPoints ?? points, entity.closed === true, shape);
  }
}

/**
 * Each span of a B-spline is a Bézier curve whose control points are its blossom at u_i … u_i, u_{i+1} …
 * u_{i+1} (Ramshaw 1987): exact for degrees 1 to 3.
 */
function drawBSpline(
  points: readonly DxfPoint[],
  knots: readonly number[],
  degree: number,
  shape: ShapeBuffer,
): void {
  let isFirst = true;
  for (let span = degree; span < points.length; span++) {
    const u0 = knots[span];
    const u1 = knots[span + 1];
    if (!(u1 > u0)) continue;
    const control = (ends: number): [number, number] =>
      blossom(points, knots, degree, span, (r) => (r < ends ? u1 : u0));
    if (isFirst) shape.moveTo(...control(0));
    isFirst = false;
    if (degree === 1) shape.lineTo(...control(1));
    else if (degree === 2) shape.quadraticTo(...control(1), ...control(2));
    else if (degree === 3) shape.cubicTo(...control(1), ...control(2), ...control(3));
    else {
      for (let i = 1; i <= STEPS_PER_SPAN; i++) {
        const u = u0 + ((u1 - u0) * i) / STEPS_PER_SPAN;
        shape.lineTo(...blossom(points, knots, degree, span, () => u));
      }
    }
  }
}

/** de Boor's algorithm with a separate argument on each level. */
function blossom(
  points: readonly DxfPoint[],
  knots: readonly number[],
  degree: number,
  span: number,
  argument: (level: number) => number,
): [number, number] {
  const x: number[] = [];
  const y: number[] = [];
  for (let j = 0; j <= degree; j++) {
    x.push(points[span - degree + j].x);
    y.push(points[span - degree + j].y);
  }
  for (let level = 1; level <= degree; level++) {
    const u = argument(level - 1);
    for (let j = degree; j >= level; j--) {
      const low = knots[span - degree + j];
      const high = knots[span + j - level + 1];
      const t = high > low ? (u - low) / (high - low) : 0;
      x[j] = (1 - t) * x[j - 1] + t * x[j];
      y[j] = (1 - t) * y[j - 1] + t * y[j];
    }
  }
  return [x[degree], y[degree]];
}

/** A smooth curve through points, for files without control points (Catmull–Rom). */
function drawThrough(points: readonly DxfPoint[], isClosed: boolean, shape: ShapeBuffer): void {
  const n = points.length;
  if (n === 0) return;
  const at = (i: number): DxfPoint =>
    isClosed ? points[(i + n) % n] : points[Math.min(n - 1, Math.max(0, i))];
  shape.moveTo(points[0].x, points[0].y);
  for (let i = 0; i < (isClosed ? n : n - 1); i++) {
    const [a, b, c, d] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    shape.cubicTo(
      b.x + (c.x - a.x) / 6,
      b.y + (c.y - a.y) / 6,
      c.x - (d.x - b.x) / 6,
      c.y - (d.y - b.y) / 6,
      c.x,
      c.y,
    );
  }
  if (isClosed) shape.close();
}
