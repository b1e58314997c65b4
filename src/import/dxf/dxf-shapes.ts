/** Lines, arcs, ellipses, faces and meshes of a DXF as outlines in the file's units, y up. */
import { drawCentreArc, drawSvgArc } from "../arc.js";
import { ShapeBuffer } from "../shape-buffer.js";
import {
  bulgedVertices,
  hasFlag,
  numberIn,
  OddValue,
  pointIn,
  pointsIn,
  requiredIn,
  requiredPoint,
  splitAt,
  type DxfGroup,
  type DxfPoint,
  distance,
} from "./dxf-groups.js";
import { cross, normalOf, vectorIn } from "./dxf-plane.js";

/** Draws lines into the shape. `tolerance` is the max error of its curves. */
export type Outline = (shape: ShapeBuffer, tolerance: number) => void;

const TURN = 2 * Math.PI;

/**
 * Vertices with bulges: bulge = tan(θ/4) for an arc of angle θ, positive if anticlockwise.
 * Radius = chord (1 + b²) / (4 |b|).
 */
export function polyline(vertices: readonly DxfPoint[], isClosed: boolean): Outline {
  return (shape, tolerance) => {
    if (vertices.length === 0) return;
    shape.moveTo(vertices[0].x, vertices[0].y);
    const to = (from: DxfPoint, next: DxfPoint): void => {
      const bulge = from.bulge ?? 0;
      const chord = distance(from, next);
      if (Math.abs(bulge) < 1e-9 || chord === 0) {
        shape.lineTo(next.x, next.y);
        return;
      }
      const radius = (chord * (1 + bulge * bulge)) / (4 * Math.abs(bulge));
      drawSvgArc(shape, radius, radius, 0, Math.abs(bulge) > 1, bulge > 0, next.x, next.y, tolerance);
    };
    for (let i = 1; i < vertices.length; i++) to(vertices[i - 1], vertices[i]);
    if (!isClosed || vertices.length < 2) return;
    const last = vertices[vertices.length - 1];
    if ((last.bulge ?? 0) !== 0) to(last, vertices[0]);
    shape.close();
  };
}

/** An arc of an ellipse, all angles rad; `start` and `sweep` as the ellipse's parameter, anticlockwise. */
export function arc(
  center: DxfPoint,
  rx: number,
  ry: number,
  tilt: number,
  start: number,
  sweep: number,
): Outline {
  if (!(rx > 0)) throw new OddValue("its radius is not above 0");
  const pointAt = (angle: number): [number, number] => {
    const x = rx * Math.cos(angle);
    const y = ry * Math.sin(angle);
    return [
      center.x + x * Math.cos(tilt) - y * Math.sin(tilt),
      center.y + x * Math.sin(tilt) + y * Math.cos(tilt),
    ];
  };
  const isWhole = sweep > TURN - 1e-9;
  const [x0, y0] = pointAt(start);
  const [x1, y1] = isWhole ? [x0, y0] : pointAt(start + sweep);
  return (shape, tolerance) => {
    shape.moveTo(x0, y0);
    drawCentreArc(shape, center.x, center.y, rx, ry, tilt, start, sweep, x1, y1, tolerance);
    if (isWhole) shape.close();
  };
}

/** Anticlockwise angle from start to end; a full turn if they coincide. */
export function turnBetween(start: number, end: number): number {
  const turn = (end - start) % TURN;
  return turn > 1e-9 ? turn : turn + TURN;
}

/** From a unit circle: its x axis becomes the long axis, its y axis the short one, in the plane of the ellipse. */
export function readEllipse(groups: readonly DxfGroup[]): Outline {
  const centre = requiredPoint(groups, 10);
  requiredPoint(groups, 11);
  const long = vectorIn(groups, 11);
  const ratio = numberIn(groups, 40) ?? 1;
  const short = cross(normalOf(groups), long).map((length) => length * ratio);
  if (!(Math.hypot(...long) > 0 && ratio !== 0)) throw new OddValue("its radius is not above 0");
  const [start, end] = [numberIn(groups, 41) ?? 0, numberIn(groups, 42) ?? TURN];
  const unitArc = arc({ x: 0, y: 0 }, 1, 1, 0, start, turnBetween(start, end));
  const map = { a: long[0], b: long[1], c: short[0], d: short[1], e: centre.x, f: centre.y };
  return (shape, tolerance) => {
    const drawn = new ShapeBuffer();
    unitArc(drawn, tolerance / Math.max(Math.hypot(...long), Math.hypot(...short)));
    shape.append(drawn, map);
  };
}

/** SOLID and TRACE: the third and fourth corners are swapped. */
export function readSolid(groups: readonly DxfGroup[]): Outline {
  const [a, b, c] = [10, 11, 12].map((code) => requiredPoint(groups, code));
  const d = pointIn(groups, 13);
  return polyline(d === undefined ? [a, b, c] : [a, b, d, c], true);
}

/** Group 70 names the edges that are not seen. */
export function readFace(groups: readonly DxfGroup[]): Outline {
  const [a, b, c] = [10, 11, 12].map((code) => requiredPoint(groups, code));
  const corners = [a, b, c, pointIn(groups, 13) ?? c];
  if ((numberIn(groups, 70) ?? 0) === 0) return polyline(corners, true);
  const edges = new EdgeSet(4);
  corners.forEach((_, i) => {
    if (!hasFlag(groups, 70, 1 << i)) edges.add(i, (i + 1) % 4);
  });
  return edges.outline(corners);
}

/** Edges of a mesh by the numbers of their ends. Edges that two faces share are drawn once. */
class EdgeSet {
  private readonly seen = new Set<number>();
  private readonly ends: (readonly [number, number])[] = [];

  constructor(private readonly pointCount: number) {}

  add(from: number, to: number): void {
    const [low, high] = [Math.min(from, to), Math.max(from, to)];
    if (!(Number.isInteger(low) && Number.isInteger(high) && low >= 0 && high < this.pointCount))
      throw new OddValue("a face refers to a vertex that it does not have");
    const key = low * this.pointCount + high;
    if (low === high || this.seen.has(key)) return;
    this.seen.add(key);
    this.ends.push([from, to]);
  }

  /** Edges that follow each other become one line. */
  outline(points: readonly DxfPoint[]): Outline {
    return (shape) => {
      let at = -1;
      for (const [from, to] of this.ends) {
        if (from !== at) shape.moveTo(points[from].x, points[from].y);
        shape.lineTo(points[to].x, points[to].y);
        at = to;
      }
    };
  }
}

/** Flags of a POLYLINE and of its vertices. */
const IS_CLOSED = 1;
const IS_CLOSED_ACROSS = 32;
export const IS_3D = 8;
const IS_GRID = 16;
const IS_POLYFACE = 64;
export const IS_MESH = IS_GRID | IS_POLYFACE;
/** Of a vertex: control points of a fitted curve or surface are not on it. */
const IS_CONTROL_POINT = 16;
const HAS_PLACE = 64;
const IS_OF_POLYFACE = 128;

export function readPolyline(
  groups: readonly DxfGroup[],
  records: readonly (readonly DxfGroup[])[],
): Outline {
  if (hasFlag(groups, 70, IS_POLYFACE)) return readPolyface(records);
  const vertices = records.filter((vertex) => !hasFlag(vertex, 70, IS_CONTROL_POINT)).flatMap(bulgedVertices);
  if (hasFlag(groups, 70, IS_GRID)) return readGrid(groups, vertices);
  return polyline(vertices, hasFlag(groups, 70, IS_CLOSED));
}

/** A grid of m rows of n vertices. A smoothed surface has its own numbers of rows and columns. */
function readGrid(groups: readonly DxfGroup[], vertices: readonly DxfPoint[]): Outline {
  const isSmooth = (numberIn(groups, 75) ?? 0) !== 0;
  const [m, n] = isSmooth
    ? [requiredIn(groups, 73), requiredIn(groups, 74)]
    : [requiredIn(groups, 71), requiredIn(groups, 72)];
  if (!(m >= 1 && n >= 1 && m * n === vertices.length))
    throw new OddValue(`a mesh of ${m} × ${n} has ${vertices.length} vertices`);
  const rows = Array.from({ length: m }, (_, i) => vertices.slice(i * n, (i + 1) * n));
  const columns = Array.from({ length: n }, (_, j) => rows.map((row) => row[j]));
  const plain = ({ x, y }: DxfPoint): DxfPoint => ({ x, y });
  const lines = [
    ...rows.map((row) => polyline(row.map(plain), hasFlag(groups, 70, IS_CLOSED_ACROSS))),
    ...columns.map((column) => polyline(column.map(plain), hasFlag(groups, 70, IS_CLOSED))),
  ];
  return (shape, tolerance) => {
    for (const line of lines) line(shape, tolerance);
  };
}

/** Vertices, then faces that name up to four of them from 1; a negative number begins an unseen edge. */
function readPolyface(records: readonly (readonly DxfGroup[])[]): Outline {
  const isFace = (vertex: readonly DxfGroup[]): boolean =>
    hasFlag(vertex, 70, IS_OF_POLYFACE) && !hasFlag(vertex, 70, HAS_PLACE);
  const points = records.filter((vertex) => !isFace(vertex)).map((vertex) => requiredPoint(vertex, 10));
  const edges = new EdgeSet(points.length);
  for (const face of records.filter(isFace)) {
    const corners = [71, 72, 73, 74]
      .map((code) => numberIn(face, code) ?? 0)
      .filter((corner) => corner !== 0);
    corners.forEach((corner, i) => {
      if (corner > 0) edges.add(corner - 1, Math.abs(corners[(i + 1) % corners.length]) - 1);
    });
  }
  return edges.outline(points);
}

/** The first level of a MESH: its vertices, then a list of faces, each a count and that many vertices. */
export function readMesh(groups: readonly DxfGroup[]): Outline {
  const [vertices = []] = splitAt(groups, 92);
  const listAt = vertices.findIndex(({ code }) => code === 93);
  if (listAt < 0) throw new OddValue("group 93 is missing");
  const points = pointsIn(vertices.slice(0, listAt), 10);
  const size = requiredIn(vertices.slice(listAt), 93);
  const list = vertices
    .slice(listAt + 1)
    .filter(({ code }) => code === 90)
    .slice(0, size)
    .map(({ value }) => Number(value));
  const edges = new EdgeSet(points.length);
  for (let at = 0; at < list.length; at += list[at] + 1) {
    if (!(list[at] >= 1)) throw new OddValue("a face has no corners");
    const corners = list.slice(at + 1, at + 1 + list[at]);
    corners.forEach((corner, i) => edges.add(corner, corners[(i + 1) % corners.length]));
  }
  return edges.outline(points);
}

/** Flag of an MLINE. */
const IS_MLINE_CLOSED = 2;

/**
 * Parallel lines: at each vertex the lines lie on a common direction (13), each at its own distance, the first
 * number (41) after its count (74).
 */
export function readMultiLine(groups: readonly DxfGroup[]): Outline {
  const vertices = splitAt(groups, 11).map((vertex) => {
    const [at, across] = [requiredPoint(vertex, 11), requiredPoint(vertex, 13)];
    return splitAt(vertex, 74)
      .filter((element) => requiredIn(element, 74) > 0)
      .map((element) => {
        const distance = requiredIn(element, 41);
        return { x: at.x + distance * across.x, y: at.y + distance * across.y };
      });
  });
  const count = Math.min(...vertices.map(({ length }) => length));
  if (vertices.length < 2 || count === 0) throw new OddValue("it has no lines");
  const lines = Array.from({ length: count }, (_, line) =>
    polyline(
      vertices.map((elements) => elements[line]),
      hasFlag(groups, 71, IS_MLINE_CLOSED),
    ),
  );
  return (shape, tolerance) => {
    for (const line of lines) line(shape, tolerance);
  };
}
