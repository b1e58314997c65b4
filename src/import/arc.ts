/**
 * Elliptical arcs to cubic Béziers.
 *
 * A cubic with control arms of (4/3) tan(θ/4) follows a unit arc of angle θ to within 2.7253e-4 (θ / (π/2))⁶
 * (max radial gap; the sixth power is exact to leading order, and the constant is that of a quarter circle,
 * where it is largest). The number of pieces follows from the allowed gap, so a 300 mm circle is as accurate
 * as a 1 mm one.
 *
 * SVG's endpoint form is converted to centre form as in SVG 1.1, appendix F.6.5 and F.6.6.
 */
import type { ShapeBuffer } from "./shape-buffer.js";
import { RAD_PER_DEG } from "../units.js";

const QUARTER_GAP = 2.7253e-4;
const QUARTER = Math.PI / 2;
const MAX_PIECES = 4096;

/** The number of pieces that keep an arc of `sweep` radians and max radius `radius` within `tolerance`. */
function arcPieceCount(radius: number, sweep: number, tolerance: number): number {
  const maxAngle = QUARTER * Math.min(1, Math.pow(tolerance / (QUARTER_GAP * radius), 1 / 6));
  const pieces = Math.ceil(Math.abs(sweep) / maxAngle - 1e-9);
  return pieces >= 1 ? Math.min(pieces, MAX_PIECES) : 1;
}

/**
 * Draws an arc from the pen's position: centre (cx, cy), radii rx, ry, the ellipse rotated by `tilt`, from
 * angle `start` through `sweep` (all rad, as the ellipse's parameter). A negative radius mirrors the arc. The
 * last point is exactly (endX, endY).
 */
export function drawCentreArc(
  shape: ShapeBuffer,
  cx: number,
  cy: number,
  rx: number,
  ry: number,
  tilt: number,
  start: number,
  sweep: number,
  endX: number,
  endY: number,
  tolerance: number,
): void {
  const pieces = arcPieceCount(Math.max(Math.abs(rx), Math.abs(ry)), sweep, tolerance);
  const step = sweep / pieces;
  const arm = (4 / 3) * Math.tan(step / 4);
  const cosT = Math.cos(tilt);
  const sinT = Math.sin(tilt);
  let cos = Math.cos(start);
  let sin = Math.sin(start);
  let x = shape.x;
  let y = shape.y;
  for (let i = 1; i <= pieces; i++) {
    const angle = start + step * i;
    const cosNext = Math.cos(angle);
    const sinNext = Math.sin(angle);
    const last = i === pieces;
    const nx = last ? endX : cx + rx * cosNext * cosT - ry * sinNext * sinT;
    const ny = last ? endY : cy + rx * cosNext * sinT + ry * sinNext * cosT;
    // Tangents d/dangle of the ellipse at both ends, times the arm.
    const tx0 = arm * (-rx * sin * cosT - ry * cos * sinT);
    const ty0 = arm * (-rx * sin * sinT + ry * cos * cosT);
    const tx1 = arm * (-rx * sinNext * cosT - ry * cosNext * sinT);
    const ty1 = arm * (-rx * sinNext * sinT + ry * cosNext * cosT);
    shape.cubicTo(x + tx0, y + ty0, nx - tx1, ny - ty1, nx, ny);
    if (!last) shape.innerVerbs.push(shape.verbs.length - 1);
    x = nx;
    y = ny;
    cos = cosNext;
    sin = sinNext;
  }
}

/** SVG's A command from the pen's position to (x, y). Radii that are too small are enlarged; zero radii give a line. */
export function drawSvgArc(
  shape: ShapeBuffer,
  rx: number,
  ry: number,
  tiltDeg: number,
  large: boolean,
  clockwise: boolean,
  x: number,
  y: number,
  tolerance: number,
): void {
  const x0 = shape.x;
  const y0 = shape.y;
  if (x0 === x && y0 === y) return;
  rx = Math.abs(rx);
  ry = Math.abs(ry);
  if (!(rx > 0 && ry > 0)) {
    shape.lineTo(x, y);
    return;
  }
  const tilt = (tiltDeg % 360) * RAD_PER_DEG;
  const cosT = Math.cos(tilt);
  const sinT = Math.sin(tilt);
  // Half the chord along the ellipse's axes, in units of its radii: a unit circle from here on.
  const hx = (x0 - x) / 2;
  const hy = (y0 - y) / 2;
  let ux = (cosT * hx + sinT * hy) / rx;
  let uy = (-sinT * hx + cosT * hy) / ry;
  const half2 = ux * ux + uy * uy;
  if (!(half2 > 1e-300) || !Number.isFinite(half2)) {
    shape.lineTo(x, y);
    return;
  }
  if (half2 > 1) {
    const grow = Math.sqrt(half2);
    rx *= grow;
    ry *= grow;
    ux /= grow;
    uy /= grow;
  }
  // Centre: offset from the chord's midpoint, perpendicular to it, on the side chosen by the flags.
  const away = Math.sqrt(Math.max(0, 1 / Math.min(1, half2) - 1)) * (large === clockwise ? -1 : 1);
  const cux = away * uy;
  const cuy = -away * ux;
  const start = Math.atan2(uy - cuy, ux - cux);
  const end = Math.atan2(-uy - cuy, -ux - cux);
  let sweep = end - start;
  if (clockwise && sweep < 0) sweep += 2 * Math.PI;
  if (!clockwise && sweep > 0) sweep -= 2 * Math.PI;
  const cx = (x0 + x) / 2 + cosT * rx * cux - sinT * ry * cuy;
  const cy = (y0 + y) / 2 + sinT * rx * cux + cosT * ry * cuy;
  drawCentreArc(shape, cx, cy, rx, ry, tilt, start, sweep, x, y, tolerance);
}

/** A full, closed ellipse, clockwise from its rightmost point on a page with y down (SVG 2, §10.3). */
export function drawEllipse(
  shape: ShapeBuffer,
  cx: number,
  cy: number,
  rx: number,
  ry: number,
  tolerance: number,
): void {
  shape.moveTo(cx + rx, cy);
  const quarters = [
    [cx, cy + ry],
    [cx - rx, cy],
    [cx, cy - ry],
    [cx + rx, cy],
  ];
  const pieces = arcPieceCount(Math.max(rx, ry), 2 * Math.PI, tolerance);
  if (pieces % 4 === 0) {
    quarters.forEach(([x, y], i) =>
      drawCentreArc(shape, cx, cy, rx, ry, 0, i * QUARTER, QUARTER, x, y, tolerance),
    );
  } else {
    drawCentreArc(shape, cx, cy, rx, ry, 0, 0, 2 * Math.PI, cx + rx, cy, tolerance);
  }
  shape.close();
}
