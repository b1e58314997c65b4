/**
 * Arcs, circles, wedges and rectangles of HPGL, given in user units and drawn in plotter units on the paper. If the scales
 * in x and y differ, arcs are parts of ellipses on the paper.
 */
import { drawCentreArc } from "../arc.js";
import type { ShapeBuffer } from "../shape-buffer.js";
import { RAD_PER_DEG } from "../../units.js";
import type { HpglFrame } from "./hpgl-frame.js";
import { clamp } from "../../geometry/polyline.js";

export const TURN = 2 * Math.PI;
/** mm on the paper: 0.02 µm. */
const TOLERANCE_MM = 2e-5;
const MM_PER_UNIT = 0.025;
const TOLERANCE = TOLERANCE_MM / MM_PER_UNIT;
/** Plotters draw arcs as chords, each 5° unless the file tells otherwise. From this angle on, a polygon is meant. */
const POLYGON_ANGLE = 20 * RAD_PER_DEG;

/** An arc about a centre, in user units; angles in rad. */
export interface HpglArc {
  readonly x: number;
  readonly y: number;
  readonly radius: number;
  readonly start: number;
  readonly sweep: number;
}

/**
 * The angle of an arc's chords, rad. `chord`: the command's parameter, in degrees, or with `isDeviation` (CT1) the
 * distance between arc and chord.
 */
export function chordAngle(chord: number | undefined, radius: number, isDeviation: boolean): number {
  if (chord === undefined) return 0;
  if (!isDeviation) return Math.abs(chord) * RAD_PER_DEG;
  return 2 * Math.acos(Math.max(-1, 1 - Math.abs(chord / radius)));
}

/** At most a full turn, rad. */
export const sweepOf = (deg: number): number => clamp(deg * RAD_PER_DEG, -TURN, TURN);

/** The arc from (x, y) about a centre through `sweepDeg`. */
export function arcAbout(cx: number, cy: number, x: number, y: number, sweepDeg: number): HpglArc {
  const [dx, dy] = [x - cx, y - cy];
  return { x: cx, y: cy, radius: Math.hypot(dx, dy), start: Math.atan2(dy, dx), sweep: sweepOf(sweepDeg) };
}

/**
 * The arc from (x0, y0) through (x1, y1) to (x2, y2): a full circle if it ends where it begins. Null if the points are
 * on a line.
 */
export function arcThrough(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  x2: number,
  y2: number,
): HpglArc | null {
  if (x0 === x2 && y0 === y2) return arcAbout((x0 + x1) / 2, (y0 + y1) / 2, x0, y0, 360);
  // The centre has the same distance from all three points: two linear equations, relative to the first point.
  const [ax, ay, bx, by] = [x1 - x0, y1 - y0, x2 - x0, y2 - y0];
  const det = 2 * (ax * by - ay * bx);
  const [a2, b2] = [ax * ax + ay * ay, bx * bx + by * by];
  const cx = (by * a2 - ay * b2) / det;
  const cy = (ax * b2 - bx * a2) / det;
  if (!Number.isFinite(cx + cy)) return null;
  const start = Math.atan2(-cy, -cx);
  const angle = Math.atan2(by - cy, bx - cx) - start;
  // Anticlockwise if the middle point is to the right of the line from start to end.
  const sweep = det > 0 ? (angle + TURN) % TURN : -((TURN - angle) % TURN);
  return { x: x0 + cx, y: y0 + cy, radius: Math.hypot(cx, cy), start, sweep };
}

/** A point of the arc's circle on the paper. */
const pointOfArc = ({ x, y, radius }: HpglArc, angle: number, frame: HpglFrame): [number, number] =>
  frame.onPaper(x + radius * Math.cos(angle), y + radius * Math.sin(angle));

/** Draws the arc from the shape's position, which is its start. */
export function drawArc(shape: ShapeBuffer, arc: HpglArc, chord: number, frame: HpglFrame): void {
  const { x, y, radius, start, sweep } = arc;
  const end = pointOfArc(arc, start + sweep, frame);
  if (chord >= POLYGON_ANGLE) {
    const sides = Math.max(1, Math.ceil(Math.abs(sweep) / chord - 1e-9));
    for (let i = 1; i < sides; i++) shape.lineTo(...pointOfArc(arc, start + (sweep * i) / sides, frame));
    shape.lineTo(...end);
    return;
  }
  const [cx, cy] = frame.onPaper(x, y);
  const [rx, ry] = frame.scales.map((scale) => radius * scale);
  drawCentreArc(shape, cx, cy, rx, ry, frame.angle, start, sweep, ...end, TOLERANCE);
}

export function drawCircle(shape: ShapeBuffer, circle: HpglArc, chord: number, frame: HpglFrame): void {
  shape.moveTo(...pointOfArc(circle, circle.start, frame));
  drawArc(shape, circle, chord, frame);
  shape.close();
}

/** The sector between an arc and its centre. A full turn is a circle without a radius in it. */
export function drawWedge(shape: ShapeBuffer, arc: HpglArc, chord: number, frame: HpglFrame): void {
  if (Math.abs(arc.sweep) === TURN) return drawCircle(shape, arc, chord, frame);
  shape.moveTo(...frame.onPaper(arc.x, arc.y));
  shape.lineTo(...pointOfArc(arc, arc.start, frame));
  drawArc(shape, arc, chord, frame);
  shape.close();
}

/** The rectangle with these opposite corners. */
export function drawRectangle(
  shape: ShapeBuffer,
  [x0, y0]: readonly [number, number],
  [x1, y1]: readonly [number, number],
  frame: HpglFrame,
): void {
  shape.moveTo(...frame.onPaper(x0, y0));
  shape.lineTo(...frame.onPaper(x1, y0));
  shape.lineTo(...frame.onPaper(x1, y1));
  shape.lineTo(...frame.onPaper(x0, y1));
  shape.close();
}

/** A tick across an axis. `lengths`: to both sides, in percent of the distance between P1 and P2 across the axis. */
export function drawTick(
  shape: ShapeBuffer,
  { x, y }: { readonly x: number; readonly y: number },
  isOnX: boolean,
  lengths: readonly [up: number, down: number],
  frame: HpglFrame,
): void {
  const [spanX, spanY] = frame.spans;
  const [up, down] = lengths.map((percent) => (percent / 100) * Math.abs(isOnX ? spanY : spanX));
  const angle = frame.angle + (isOnX ? Math.PI / 2 : 0);
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  shape.moveTo(x - down * cos, y - down * sin);
  shape.lineTo(x + up * cos, y + up * sin);
}
