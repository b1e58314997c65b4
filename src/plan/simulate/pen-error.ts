/** The deviation of the drawn line from the drawing on a machine that swings (model: spring-pen.ts). */
import type { StrokeSet } from "../../drawing/stroke-set.js";
import { distance, nearestShare } from "../../geometry/polyline.js";
import type { Springs } from "../../machines/profile.js";
import { swingPen, type PenPoint } from "./spring-pen.js";
import type { Trajectory } from "../trajectory.js";

export interface PenError {
  readonly maxMm: number;
  /** The 99th percentile over the drawing time. */
  readonly p99Mm: number;
  readonly rmsMm: number;
}

const STEP_S = 0.001;
/** The line is searched this far before and after the pen's nominal position, mm. */
const NEAR_MM = 2;
/** Width and number of the histogram bins for the percentile. */
const BIN_MM = 0.001;
const BINS = 5_000;

/** Calls `onPoint` about every ms with the pen's position and its distance from the drawing, mm (0 with the pen up). */
export function penError(
  strokes: StrokeSet,
  trajectory: Trajectory,
  springs: Springs,
  onPoint: (pen: PenPoint, mm: number) => void = () => undefined,
): PenError {
  const line = new NearLine(strokes);
  const secondsIn = new Float64Array(BINS);
  let maxMm = 0;
  let squares = 0;
  let seconds = 0;
  let lastS = 0;
  swingPen(trajectory, springs, STEP_S, (pen) => {
    const { tS, x, y, stroke, alongMm } = pen;
    const dt = tS - lastS;
    lastS = tS;
    if (stroke < 0) return onPoint(pen, 0);
    const mm = line.distance(stroke, alongMm, x, y);
    onPoint(pen, mm);
    maxMm = Math.max(maxMm, mm);
    squares += dt * mm * mm;
    seconds += dt;
    secondsIn[Math.min(BINS - 1, Math.floor(mm / BIN_MM))] += dt;
  });
  if (seconds === 0) return { maxMm: 0, p99Mm: 0, rmsMm: 0 };
  let left = seconds / 100;
  let top = BINS - 1;
  while (top > 0 && left >= secondsIn[top]) left -= secondsIn[top--];
  return { maxMm, p99Mm: (top + 1) * BIN_MM, rmsMm: Math.sqrt(squares / seconds) };
}

/** Distances of points from the part of a stroke around a given place. Places must be queried in drawing order. */
class NearLine {
  private stroke = -1;
  private point = 0;
  private startMm = 0;

  constructor(private readonly strokes: StrokeSet) {}

  distance(stroke: number, alongMm: number, x: number, y: number): number {
    const { xy, offsets } = this.strokes;
    const [first, last] = [offsets[stroke], offsets[stroke + 1] - 1];
    if (stroke !== this.stroke) {
      this.stroke = stroke;
      this.point = first;
      this.startMm = 0;
    }
    // Skip to the segment in which the search begins.
    while (this.point + 1 < last) {
      const i = 2 * this.point;
      const lengthMm = distance(xy[i], xy[i + 1], xy[i + 2], xy[i + 3]);
      if (this.startMm + lengthMm >= alongMm - NEAR_MM) break;
      this.startMm += lengthMm;
      this.point++;
    }
    let nearestMm = Infinity;
    let fromMm = this.startMm;
    for (let i = this.point; i <= Math.max(first, last - 1) && fromMm <= alongMm + NEAR_MM; i++) {
      const j = Math.min(i + 1, last);
      const [x0, y0, x1, y1] = [xy[2 * i], xy[2 * i + 1], xy[2 * j], xy[2 * j + 1]];
      const share = nearestShare(x0, y0, x1, y1, x, y);
      nearestMm = Math.min(nearestMm, distance(x, y, x0 + share * (x1 - x0), y0 + share * (y1 - y0)));
      fromMm += distance(x0, y0, x1, y1);
    }
    return nearestMm;
  }
}
