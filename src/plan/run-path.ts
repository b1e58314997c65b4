/**
 * The polyline of one run, ready for planning: points, segment lengths, unit directions.
 *
 *   x, y     mm, n + 1 points          length   mm, n segments, at least 2 SHORTEST_MM
 *   ux, uy   unit directions           v2       (mm/s)², n + 1: max speed² at each point, then planned speed²
 *   cap2     (mm/s)², n: max speed² inside each segment, never below `v2` at its ends
 *   sine     n + 1: sin(φ/2) of a corner that is drawn as a curve; 0 if the velocity jumps there
 *   tangent  mm, n + 1: how much of each adjacent segment that curve may use
 *   drawn    mm, n: how much of the stroke each segment covers, which differs from its length in a stretched frame
 *
 * One object is reused for every run, so planning allocates nothing per stroke.
 */

/**
 * Points closer than this are the same point: there is no travel between them. Points of a stroke closer than
 * twice this to the previous one are skipped, because their direction would be noise.
 */
export const SHORTEST_MM = 5e-7;

/** Where a run ends, mm. */
export interface RunEnd {
  readonly x: number;
  readonly y: number;
  readonly alongMm: number;
}

export class RunPath {
  segmentCount = 0;
  x = new Float64Array(0);
  y = new Float64Array(0);
  length = new Float64Array(0);
  ux = new Float64Array(0);
  uy = new Float64Array(0);
  v2 = new Float64Array(0);
  cap2 = new Float64Array(0);
  sine = new Float64Array(0);
  tangent = new Float64Array(0);
  drawn = new Float64Array(0);
  /** mm along the whole stroke at the first point. */
  startAlong = 0;
  /** Segments before `easeUntil` and from `easeFrom` on are drawn at the easing speed. */
  easeUntil = 0;
  easeFrom = Infinity;
  /** More points may follow later, so nothing may depend on where the path ends. */
  mayGrow = false;

  /** A straight line between two points, at least SHORTEST_MM apart. */
  setLine(x0: number, y0: number, x1: number, y1: number): void {
    this.reserve(2);
    const l = Math.hypot(x1 - x0, y1 - y0);
    this.x[0] = x0;
    this.y[0] = y0;
    this.x[1] = x1;
    this.y[1] = y1;
    this.length[0] = this.drawn[0] = l;
    this.ux[0] = (x1 - x0) / l;
    this.uy[0] = (y1 - y0) / l;
    this.segmentCount = 1;
    this.startAlong = 0;
    this.easeUntil = 0;
    this.easeFrom = Infinity;
  }

  /** Segment i of another path, `alongMm` along its stroke. */
  setSegment(other: RunPath, i: number, alongMm: number): void {
    this.setLine(other.x[i], other.y[i], other.x[i + 1], other.y[i + 1]);
    this.startAlong = alongMm;
    this.drawn[0] = other.drawn[i];
    this.easeUntil = i < other.easeUntil || i >= other.easeFrom ? 1 : 0;
  }

  /**
   * Loads points [first, end) of `xy`, starting `fromAlong` mm along them. Afterwards `segmentCount` is 0 if
   * nothing is left to draw; x[0], y[0] is the start in any case.
   *
   * @throws RangeError if a coordinate is not finite, or so large that a length is not
   */
  load(xy: Float64Array, first: number, end: number, fromAlong: number): void {
    this.reserve(end - first + 3);
    this.easeUntil = 0;
    this.easeFrom = Infinity;
    const { x, y, length, ux, uy, drawn } = this;
    let px = xy[2 * first];
    let py = xy[2 * first + 1];
    if (!(Math.abs(px) + Math.abs(py) < Infinity)) throw notFinite(first, px, py);
    let n = 0;
    let left = fromAlong;
    this.startAlong = 0;
    x[0] = px;
    y[0] = py;
    for (let i = first + 1; i < end; i++) {
      const qx = xy[2 * i];
      const qy = xy[2 * i + 1];
      let dx = qx - px;
      let dy = qy - py;
      let l = Math.sqrt(dx * dx + dy * dy);
      if (l < 2 * SHORTEST_MM) continue;
      if (!(l < Infinity)) throw notFinite(i, qx, qy);
      if (left > 0) {
        if (left > l - 2 * SHORTEST_MM) {
          left -= l;
          this.startAlong += l;
          x[0] = px = qx;
          y[0] = py = qy;
          continue;
        }
        px += (dx / l) * left;
        py += (dy / l) * left;
        this.startAlong += left;
        left = 0;
        x[0] = px;
        y[0] = py;
        dx = qx - px;
        dy = qy - py;
        l = Math.sqrt(dx * dx + dy * dy);
      }
      length[n] = drawn[n] = l;
      ux[n] = dx / l;
      uy[n] = dy / l;
      n++;
      x[n] = px = qx;
      y[n] = py = qy;
    }
    this.segmentCount = n;
  }

  /** Copies everything from another path except its points; set those, then call `measure`. */
  copyLayout(other: RunPath): void {
    this.reserve(other.segmentCount + 1);
    this.segmentCount = other.segmentCount;
    this.drawn.set(other.drawn.subarray(0, other.segmentCount));
    this.startAlong = other.startAlong;
    this.easeUntil = other.easeUntil;
    this.easeFrom = other.easeFrom;
  }

  /** Computes lengths and directions from the points; neighbours must be distinct. */
  measure(): void {
    const { segmentCount: n, x, y, length, ux, uy } = this;
    for (let i = 0; i < n; i++) {
      const dx = x[i + 1] - x[i];
      const dy = y[i + 1] - y[i];
      const l = Math.sqrt(dx * dx + dy * dy);
      const per = 1 / l;
      length[i] = l;
      ux[i] = dx * per;
      uy[i] = dy * per;
    }
  }

  /** Moves the first point by less than SHORTEST_MM, to the actual position of the pen. */
  startAt(x: number, y: number): void {
    this.x[0] = x;
    this.y[0] = y;
    if (this.segmentCount === 0) return;
    const l = Math.hypot(this.x[1] - x, this.y[1] - y);
    this.length[0] = l;
    this.ux[0] = (this.x[1] - x) / l;
    this.uy[0] = (this.y[1] - y) / l;
  }

  /**
   * Prepends the point (x, y), slightly beside the drawing. The new segment covers no part of the drawing.
   */
  prependPoint(x: number, y: number): void {
    const { segmentCount: n } = this;
    for (const column of [this.x, this.y]) column.copyWithin(1, 0, n + 1);
    for (const column of [this.length, this.ux, this.uy, this.drawn]) column.copyWithin(1, 0, n);
    this.segmentCount = n + 1;
    this.startAt(x, y);
    this.drawn[0] = this.length[0];
    this.startAlong = Math.max(0, this.startAlong - this.length[0]);
  }

  end(): RunEnd {
    const { segmentCount: n } = this;
    return { x: this.x[n], y: this.y[n], alongMm: this.endAlong() };
  }

  /** mm along the whole stroke at the last point. */
  private endAlong(): number {
    let along = this.startAlong;
    for (let i = 0; i < this.segmentCount; i++) along += this.drawn[i];
    return along;
  }

  /** Marks the first and last `mm` for easing, and splits segments at the boundaries. The end of a path that may grow is not the last. */
  ease(mm: number): void {
    if (this.segmentCount === 0) return;
    const whole = this.endAlong() - this.startAlong;
    if (whole <= (this.mayGrow ? 1 : 2) * mm) {
      this.easeUntil = this.segmentCount;
      return;
    }
    this.easeUntil = this.cutAt(mm);
    if (!this.mayGrow) this.easeFrom = this.cutAt(whole - mm);
  }

  /** Adds a point `mm` after the first one, unless one is very close; returns its index. */
  private cutAt(mm: number): number {
    const { x, y, length, ux, uy, drawn } = this;
    let i = 0;
    let left = mm;
    while (i < this.segmentCount - 1 && left > drawn[i]) left -= drawn[i++];
    const before = (length[i] * left) / drawn[i];
    if (before < 2 * SHORTEST_MM) return i;
    if (length[i] - before < 2 * SHORTEST_MM) return i + 1;
    for (const column of [x, y]) column.copyWithin(i + 2, i + 1, this.segmentCount + 1);
    for (const column of [length, ux, uy, drawn]) column.copyWithin(i + 1, i, this.segmentCount);
    x[i + 1] = x[i] + ux[i] * before;
    y[i + 1] = y[i] + uy[i] * before;
    length[i + 1] = length[i] - before;
    length[i] = before;
    drawn[i + 1] = drawn[i] - left;
    drawn[i] = left;
    this.segmentCount++;
    return i + 1;
  }

  private reserve(points: number): void {
    if (this.x.length >= points) return;
    const size = Math.max(points, 2 * this.x.length);
    this.x = new Float64Array(size);
    this.y = new Float64Array(size);
    this.length = new Float64Array(size);
    this.ux = new Float64Array(size);
    this.uy = new Float64Array(size);
    this.v2 = new Float64Array(size);
    this.cap2 = new Float64Array(size);
    this.sine = new Float64Array(size);
    this.tangent = new Float64Array(size);
    this.drawn = new Float64Array(size);
  }
}

function notFinite(index: number, x: number, y: number): RangeError {
  return new RangeError(
    `point ${index} of the strokes is (${x}, ${y}): coordinates must be finite and of a realistic size, in mm`,
  );
}
