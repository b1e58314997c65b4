/**
 * Positions and directions of markers on a shape (SVG 2, §11.6).
 *
 *        in ↗   bisector of the incoming and outgoing directions; at the ends of an open path, the only one
 *     ──────•
 *            ↘ out
 */
import { VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../drawing/drawing.js";
import type { ShapeBuffer } from "../shape-buffer.js";
import type { Context } from "./svg-context.js";

const MARKED = new Set(["path", "line", "polyline", "polygon"]);

/** Whether the shape may have markers. */
export const isMarked = (tag: string, { style }: Context): boolean =>
  MARKED.has(tag) && (style.markerStart !== null || style.markerMid !== null || style.markerEnd !== null);

export interface MarkerPlace {
  readonly kind: "start" | "mid" | "end";
  readonly x: number;
  readonly y: number;
  /** rad */
  readonly angle: number;
}

interface Vertex {
  readonly x: number;
  readonly y: number;
  /** Direction of the segment that ends here; null at the start of a subpath. */
  readonly arrive: readonly [number, number] | null;
  /** Direction of the segment that starts here. */
  leave: readonly [number, number] | null;
}

export function markerPlaces(shape: ShapeBuffer): MarkerPlace[] {
  const vertices = verticesOf(shape);
  // A path that only moves draws no line, but its markers are drawn.
  if (vertices.length === 0 && shape.lonePoints > 0) {
    return (["start", "end"] as const).map((kind) => ({ kind, x: shape.x, y: shape.y, angle: 0 }));
  }
  return vertices.map((vertex, i) => ({
    kind: i === 0 ? "start" : i === vertices.length - 1 ? "end" : "mid",
    x: vertex.x,
    y: vertex.y,
    angle: angleAt(vertex),
  }));
}

/** A turn counts as a reversal within this, rad. */
const REVERSAL = 1e-6;

/** Halfway between both directions. At a reversal the marker points to the left of the path, as in Chromium. */
function angleAt({ arrive, leave }: Vertex): number {
  const [ax, ay] = arrive ?? leave ?? [1, 0];
  const [lx, ly] = leave ?? arrive ?? [1, 0];
  const turn = Math.atan2(ax * ly - ay * lx, ax * lx + ay * ly);
  return Math.atan2(ay, ax) + (Math.PI - turn < REVERSAL ? -Math.PI / 2 : turn / 2);
}

function verticesOf(shape: ShapeBuffer): Vertex[] {
  const { data: c } = shape.coords;
  const inner = new Set(shape.innerVerbs);
  const vertices: Vertex[] = [];
  let x = 0;
  let y = 0;
  let first = 0;
  let repeated = 0;
  const leave = (direction: Vertex["leave"]): void => {
    const last = vertices[vertices.length - 1];
    if (last !== undefined && last.leave === null) last.leave = direction;
  };
  // The first piece of an arc gives the outgoing direction of its vertex; the vertices between its pieces are
  // skipped.
  let passing = false;
  for (let i = 0, at = 0; i < shape.verbs.length; i++) {
    const verb = shape.verbs.data[i];
    if (verb === VERB_MOVE) {
      x = c[at];
      y = c[at + 1];
      at += 2;
      first = vertices.length;
      vertices.push({ x, y, arrive: null, leave: null });
    } else if (verb === VERB_CLOSE) {
      const start = vertices[first];
      // If the path is back at its start, the close has no direction.
      const arrive = unit(start.x - x, start.y - y);
      const closing = arrive ?? start.leave;
      if (closing !== null) leave(closing);
      // The closing vertex coincides with the start: both have the last segment as incoming and the first as
      // outgoing one.
      const end = { ...start, arrive };
      vertices[first] = end;
      vertices.push(end);
      for (; shape.closedAgain[repeated] === i; repeated++) {
        vertices[first] = { ...end, arrive: null };
        vertices.push(vertices[first]);
      }
      x = start.x;
      y = start.y;
    } else {
      const pairs = verb === VERB_LINE ? 1 : 3;
      const points = [x, y, ...c.subarray(at, at + 2 * pairs)];
      at += 2 * pairs;
      if (!passing) leave(startDirection(points));
      passing = verb === VERB_CUBIC && inner.has(i);
      x = c[at - 2];
      y = c[at - 1];
      if (!passing) vertices.push({ x, y, arrive: endDirection(points), leave: null });
    }
  }
  return vertices;
}

function unit(x: number, y: number): readonly [number, number] | null {
  const length = Math.hypot(x, y);
  return length > 0 ? [x / length, y / length] : null;
}

/** Direction towards the first point that differs. */
function startDirection(points: readonly number[]): readonly [number, number] | null {
  for (let i = 2; i < points.length; i += 2) {
    const direction = unit(points[i] - points[0], points[i + 1] - points[1]);
    if (direction !== null) return direction;
  }
  return null;
}

function endDirection(points: readonly number[]): readonly [number, number] | null {
  const n = points.length;
  for (let i = n - 4; i >= 0; i -= 2) {
    const direction = unit(points[n - 2] - points[i], points[n - 1] - points[i + 1]);
    if (direction !== null) return direction;
  }
  return null;
}
