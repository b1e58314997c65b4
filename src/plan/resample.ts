/**
 * Makes a plan independent of how its line is sampled. Segments shorter than a motor step have directions that mean
 * nothing, but each would get a corner speed: a point 1 µm beside a line would stop the pen.
 *
 *   1. thin      a point is dropped if the line without it stays within TOLERANCE of it
 *   2. sharpen   each remaining point moves to the point of the drawing that is farthest from the chord between its
 *                neighbours: to the very corner, or to the middle of an arc. It stays if the line would then miss it
 *   3. even out  the points of a smooth line move along it, until their distances change only gradually
 *   4. average   each of these then moves to the mean of the line around it, where the errors of single points cancel
 *
 * Thinning is the cone test of Imai and Iri (1988). From the last kept point, each point leaves a cone of directions that
 * pass it within TOLERANCE. A point outside the intersection of these cones ends the segment.
 *
 *                 ______------      Points beside the line decide which points are kept. Without sharpening, a corner
 *     kept ·  <  ·   ·    ·         would move by TOLERANCE over its turn. Without steps 3 and 4 the turns of a dense
 *                 ‾‾‾‾‾‾------      curve would vary by a fifth.
 *
 * A line is smooth at a point that the mean would move by less than TOLERANCE/2. From there to three times that, the point
 * moves less and less, since a strict limit would treat neighbours differently. Beyond that it is a corner and stays.
 * A drawing of segments that are long or turn clearly is not changed at all. Linear in the number of points.
 */
import { RunPath, SHORTEST_MM } from "./run-path.js";

/** A third of a motor step of an AxiDraw, mm. */
const TOLERANCE = 0.004;
/** The new line leaves the drawing by less than this, mm. */
export const MAX_MOVED_MM = 0.015;
const TOLERANCE2 = TOLERANCE * TOLERANCE;

/** Times that points are moved towards the middle of their neighbours. */
const EVENING_ROUNDS = 4;

/** How far a point moves at most, as a share of the shorter segment beside it. */
const MAX_MOVE = 1 / 2;

export class Resampler {
  /** The line as drawn: points, and mm along it. */
  private x = new Float64Array(0);
  private y = new Float64Array(0);
  private along = new Float64Array(0);
  /** The kept points: index in the line, mm along it, and how smooth the line is there: 0 (a corner) to 1. */
  private kept = new Uint32Array(0);
  private at = new Float64Array(0);
  private moved = new Float64Array(0);
  private smooth = new Float64Array(0);
  /** The segment in which the next mean begins. Means are computed in order. */
  private segment = 0;
  private meanX = 0;
  private meanY = 0;

  /** Replaces the points between the ends of a path. `path.drawn` still covers the whole line. */
  resample(path: RunPath): void {
    if (path.segmentCount < 2) return;
    this.load(path);
    const last = this.sharpen(this.thin(path.segmentCount));
    this.measureSmoothness(last);
    this.evenOut(last);
    this.write(path, last);
  }

  private load({ segmentCount, x, y, length }: RunPath): void {
    this.reserve(segmentCount + 1);
    this.x.set(x.subarray(0, segmentCount + 1));
    this.y.set(y.subarray(0, segmentCount + 1));
    let along = 0;
    for (let i = 0; i < segmentCount; i++) {
      this.along[i] = along;
      along += length[i];
    }
    this.along[segmentCount] = along;
  }

  /** Step 1. Returns the index of the last kept point. */
  private thin(segmentCount: number): number {
    const { x, y, along, kept, at } = this;
    let last = 0;
    let from = 0;
    // Both sides of the cone, and the largest distance of a point in it. There is none yet if `far` is 0.
    let leftX = 0;
    let leftY = 0;
    let rightX = 0;
    let rightY = 0;
    let far = 0;
    kept[0] = 0;
    at[0] = 0;
    let i = 1;
    while (i <= segmentCount) {
      const dx = x[i] - x[from];
      const dy = y[i] - y[from];
      const d2 = dx * dx + dy * dy;
      const d = Math.sqrt(d2);
      const isOutside = d > TOLERANCE && far > 0 && (leftX * dy > leftY * dx || rightX * dy < rightY * dx);
      if (isOutside || d < far - TOLERANCE) {
        from = i - 1;
        far = 0;
        kept[++last] = from;
        at[last] = along[from];
        continue;
      }
      if (d > TOLERANCE) {
        const t = Math.sqrt(d2 - TOLERANCE2);
        const lx = dx * t - dy * TOLERANCE;
        const ly = dy * t + dx * TOLERANCE;
        const rx = dx * t + dy * TOLERANCE;
        const ry = dy * t - dx * TOLERANCE;
        if (far === 0 || leftX * ly < leftY * lx) {
          leftX = lx;
          leftY = ly;
        }
        if (far === 0 || rightX * ry > rightY * rx) {
          rightX = rx;
          rightY = ry;
        }
        if (d > far) far = d;
      }
      i++;
    }
    kept[++last] = segmentCount;
    at[last] = along[segmentCount];
    return last;
  }

  /** Step 2. Leaves out points that are not needed any more. Returns the new index of the last point. */
  private sharpen(last: number): number {
    const { along, kept, at } = this;
    let count = 0;
    let isLeftOut = false;
    for (let i = 1; i < last; i++) {
      const farthest = this.farthest(kept[count], kept[i + 1]);
      // Never two in a row, so that the search is linear.
      isLeftOut = farthest === -1 && !isLeftOut;
      if (isLeftOut) continue;
      const own = kept[i];
      // The line must still pass the old point, or it would cut the corner.
      const [from, to] = farthest < own ? [farthest, kept[i + 1]] : [kept[count], farthest];
      const canMove = farthest !== -1 && this.offChord2(own, from, to) <= TOLERANCE2;
      kept[++count] = canMove ? farthest : own;
      at[count] = along[kept[count]];
    }
    kept[++count] = kept[last];
    at[count] = at[last];
    return count;
  }

  /** The point farthest from the chord between two points of the line; -1 if all are within TOLERANCE of it. */
  private farthest(first: number, end: number): number {
    let farthest = -1;
    let far2 = TOLERANCE2;
    for (let j = first + 1; j < end; j++) {
      const away2 = this.offChord2(j, first, end);
      if (away2 <= far2) continue;
      far2 = away2;
      farthest = j;
    }
    return farthest;
  }

  /** The distance² of a point of the line from the chord between two others. */
  private offChord2(point: number, first: number, end: number): number {
    const { x, y } = this;
    const cx = x[end] - x[first];
    const cy = y[end] - y[first];
    const dx = x[point] - x[first];
    const dy = y[point] - y[first];
    const c2 = cx * cx + cy * cy;
    const share = c2 === 0 ? 0 : Math.max(0, Math.min(1, (dx * cx + dy * cy) / c2));
    const awayX = dx - share * cx;
    const awayY = dy - share * cy;
    return awayX * awayX + awayY * awayY;
  }

  private measureSmoothness(last: number): void {
    const { x, y, kept, smooth } = this;
    smooth[0] = smooth[last] = 0;
    this.segment = 0;
    for (let i = 1; i < last; i++) {
      smooth[i] = 0;
      this.findMean(i);
      const movedMm = Math.hypot(this.meanX - x[kept[i]], this.meanY - y[kept[i]]);
      smooth[i] = Math.max(0, Math.min(1, 1.5 - movedMm / TOLERANCE));
    }
  }

  /** Step 3. A point moves so little that the line from it to its neighbours still follows the drawing. */
  private evenOut(last: number): void {
    const { along, kept, at, moved, smooth } = this;
    for (let round = 0; round < EVENING_ROUNDS; round++) {
      moved.set(at.subarray(0, last + 1));
      for (let i = 1; i < last; i++) {
        if (smooth[i] === 0) continue;
        const own = along[kept[i]];
        const most = Math.min(own - along[kept[i - 1]], along[kept[i + 1]] - own) * MAX_MOVE * smooth[i];
        const wanted = (at[i - 1] + 2 * at[i] + at[i + 1]) / 4;
        moved[i] = Math.max(own - most, Math.min(own + most, wanted));
      }
      at.set(moved.subarray(0, last + 1));
    }
  }

  /** Step 4, and the lengths of the new segments. */
  private write(path: RunPath, last: number): void {
    const { x, y, along, kept, at, smooth } = this;
    this.segment = 0;
    let count = 0;
    let begin = 0;
    for (let i = 1; i <= last; i++) {
      let px = x[kept[i]];
      let py = y[kept[i]];
      let place = along[kept[i]];
      if (smooth[i] > 0) {
        this.findMean(i);
        px += smooth[i] * (this.meanX - px);
        py += smooth[i] * (this.meanY - py);
        place += smooth[i] * (at[i] - place);
      }
      const isNew = Math.hypot(px - path.x[count], py - path.y[count]) >= 2 * SHORTEST_MM;
      if (isNew) {
        path.drawn[count++] = place - begin;
        begin = place;
      } else if (count > 0) {
        // At the place of the point before it, so both are one.
        path.drawn[count - 1] += place - begin;
        begin = place;
      }
      if (count > 0) {
        path.x[count] = px;
        path.y[count] = py;
      }
    }
    path.segmentCount = count;
    path.measure();
  }

  /** The mean of the line around kept point i, half way to the nearer of its neighbours on both sides. */
  private findMean(i: number): void {
    const { x, y, along, at } = this;
    const half = Math.min(at[i] - at[i - 1], at[i + 1] - at[i]) / 2;
    const end = at[i] + half;
    let mm = at[i] - half;
    let j = this.segment;
    while (along[j + 1] <= mm) j++;
    this.segment = j;
    let share = (mm - along[j]) / (along[j + 1] - along[j]);
    let px = x[j] + (x[j + 1] - x[j]) * share;
    let py = y[j] + (y[j + 1] - y[j]) * share;
    let sumX = 0;
    let sumY = 0;
    for (;;) {
      const isLast = along[j + 1] >= end;
      const next = isLast ? end : along[j + 1];
      share = isLast ? (end - along[j]) / (along[j + 1] - along[j]) : 1;
      const qx = x[j] + (x[j + 1] - x[j]) * share;
      const qy = y[j] + (y[j + 1] - y[j]) * share;
      sumX += (next - mm) * (px + qx);
      sumY += (next - mm) * (py + qy);
      if (isLast) break;
      mm = next;
      px = qx;
      py = qy;
      j++;
    }
    this.meanX = sumX / (4 * half);
    this.meanY = sumY / (4 * half);
  }

  private reserve(points: number): void {
    if (this.x.length >= points) return;
    const size = Math.max(points, 2 * this.x.length);
    this.x = new Float64Array(size);
    this.y = new Float64Array(size);
    this.along = new Float64Array(size);
    this.kept = new Uint32Array(size);
    this.at = new Float64Array(size);
    this.moved = new Float64Array(size);
    this.smooth = new Float64Array(size);
  }
}
