/**
 * Markers on a shape (SVG 2, §11.6): their positions and directions, and the context inside each.
 *
 *        in ↗   bisector of the incoming and outgoing directions; at the ends of an open path, the only one
 *     ──────•
 *            ↘ out
 */
import {
  compose,
  determinant,
  IDENTITY,
  isFiniteAffine,
  rotation,
  scaling,
  translation,
} from "../../../geometry/affine.js";
import type { Declared } from "../css/properties.js";
import { lengthPx, type LengthBasis, type Side } from "../css/length.js";
import { MAX_COPY_DEPTH, type Context, type UseChain, withViewport, contextPaints } from "../svg-context.js";
import type { SvgFile } from "../svg-file.js";
import { attribute } from "../svg-tree.js";
import { declaredValue, type Style } from "../css/style.js";
import { parseTransform } from "../css/transform.js";
import { isEmptyViewBox, parseViewBox, viewBoxMap } from "../svg-viewport.js";
import { VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../../drawing/drawing.js";
import type { ShapeBuffer } from "../../shape-buffer.js";
import { rectangleClip } from "../../clip-node.js";

interface MarkerPosition {
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

export function markerPlaces(shape: ShapeBuffer): MarkerPosition[] {
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

function orientRad(text: string): number {
  const turn = parseTransform(`rotate(${text})`);
  return turn === null ? 0 : Math.atan2(turn.b, turn.a);
}

/** A length, or left/center/right and top/center/bottom of the box. Percentages refer to the enclosing viewport. */
function refPosition(text: string, start: number, length: number, basis: LengthBasis, side: Side): number {
  const share = { left: 0, top: 0, center: 0.5, right: 1, bottom: 1 }[text];
  return share === undefined ? (lengthPx(text, basis, side) ?? 0) : start + share * length;
}

/** The context for the content of `marker` at `place` on a shape drawn in `context`; null if nothing is visible. */
export function insideMarker(
  file: SvgFile,
  marker: number,
  place: MarkerPosition,
  context: Context,
): Context | null {
  const { tree } = file;
  const text = (name: string): string | undefined => attribute(tree, marker, name);
  const length = (name: string, side: Side, normal: number): number =>
    lengthPx(text(name) ?? "", context.basis, side) ?? normal;
  const width = length("markerWidth", "width", 3);
  const height = length("markerHeight", "height", 3);
  if (!(width > 0 && height > 0) || isEmptyViewBox(text("viewBox"))) return null;
  const box = parseViewBox(text("viewBox"));
  const fit = box === null ? IDENTITY : viewBoxMap(box, width, height, text("preserveAspectRatio"));
  const orient = text("orient") ?? "0";
  const isReversed = orient === "auto-start-reverse" && place.kind === "start";
  const angle = orient.startsWith("auto") ? place.angle + (isReversed ? Math.PI : 0) : orientRad(orient);
  const size = text("markerUnits") === "userSpaceOnUse" ? 1 : context.style.strokeWidth;
  const refX = refPosition(text("refX") ?? "0", box?.x ?? 0, box?.width ?? width, context.basis, "width");
  const refY = refPosition(text("refY") ?? "0", box?.y ?? 0, box?.height ?? height, context.basis, "height");
  const turned = compose(translation(place.x, place.y), compose(rotation(angle), scaling(size)));
  // The reference point lies on the vertex, not the viewBox's corner.
  const map = compose(turned, { ...fit, e: fit.a * -refX, f: fit.d * -refY });
  if (determinant(map) === 0 || !isFiniteAffine(map)) return null;
  const depth = (context.uses?.depth ?? 0) + 1;
  if (depth > MAX_COPY_DEPTH) return null;
  const uses: UseChain = {
    element: marker,
    target: marker,
    size: { width: null, height: null },
    outer: context.uses,
    depth,
  };
  const declared = file.cascade.declaredOf(marker);
  const outside = file.styleAround(marker, context.basis);
  const style = file.computeStyle(outside, declared, { ...context.basis, fontSize: outside.fontSize });
  const inside = {
    ...withViewport(context, map, box?.width ?? width, box?.height ?? height),
    style,
    uses,
    ...contextPaints(context),
  };
  const overflow = overflowOf(file, marker, declared, style);
  if (overflow === "visible" || overflow === "auto") return inside;
  // The marker's viewport, in its content's units.
  const x = -fit.e / fit.a;
  const y = -fit.f / fit.d;
  const viewport = { x0: x, y0: y, x1: x + width / fit.a, y1: y + height / fit.d };
  return { ...inside, clip: rectangleClip(inside.clip, inside.map, viewport) };
}

/** `inherit` takes the value of the element around the marker. */
function overflowOf(file: SvgFile, marker: number, declared: Declared, style: Style): string | undefined {
  if (declared.get("overflow") !== "inherit") return declaredValue(style, declared, "overflow");
  const around = file.cascade.declaredOf(file.tree.parents[marker]);
  return declaredValue(style, around, "overflow") ?? "visible";
}
