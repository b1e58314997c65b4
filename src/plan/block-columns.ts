/**
 * The blocks of a trajectory under construction: growing columns and a running clock.
 *
 * When the columns are full, the new size is estimated from the share of the drawing planned so far, so that
 * they seldom grow more than twice.
 */
const COLUMN_NAMES = ["durationS", "x", "y", "vx", "vy", "ax", "ay", "startS", "alongMm"] as const;

/** Arrays with more unused space than this share are trimmed at the end. */
const WASTE = 0.05;

export class BlockColumns {
  count = 0;
  /** Seconds from the trajectory's start to the next block, pen waits included. */
  clockS = 0;
  durationS = new Float64Array(0);
  x = new Float64Array(0);
  y = new Float64Array(0);
  vx = new Float64Array(0);
  vy = new Float64Array(0);
  ax = new Float64Array(0);
  ay = new Float64Array(0);
  startS = new Float64Array(0);
  alongMm = new Float64Array(0);
  /** Only with `withJerk`; otherwise jerk is zero everywhere. */
  jx: Float64Array<ArrayBuffer> | null;
  jy: Float64Array<ArrayBuffer> | null;
  private segmentsDone = 0;
  private blocksDone = 0;

  /** @param segmentsExpected how many polyline segments the whole plan has: a hint for the sizes */
  constructor(
    private readonly segmentsExpected: number,
    withJerk: boolean,
  ) {
    this.jx = withJerk ? new Float64Array(0) : null;
    this.jy = withJerk ? new Float64Array(0) : null;
  }

  /** Reports that the blocks so far cover `segments` more segments of the drawing. */
  addSegments(segments: number): void {
    this.segmentsDone += segments;
    this.blocksDone = this.count;
  }

  private grow(needed: number): void {
    const { segmentsDone, blocksDone } = this;
    const likely = segmentsDone > 0 ? 1.01 * this.segmentsExpected * (blocksDone / segmentsDone) : 4 * needed;
    // At most 500 times as much, since the first strokes may not be typical.
    this.resize(Math.min(likely > needed ? likely : 2 * needed, 500 * needed) + 64);
  }

  /**
   * Appends a block that begins now, and advances the clock. Returns its row: the caller sets position, velocity,
   * acceleration and stroke there. Jerk is 0 unless the caller sets it.
   */
  add(durationS: number): number {
    if (this.count === this.durationS.length) this.grow(this.count + 1);
    const k = this.count++;
    this.durationS[k] = durationS;
    this.startS[k] = this.clockS;
    this.clockS += durationS;
    return k;
  }

  /** Appends one block without jerk: for where there are few. */
  push(
    durationS: number,
    x: number,
    y: number,
    vx: number,
    vy: number,
    ax: number,
    ay: number,
    alongMm: number,
  ): void {
    const k = this.add(durationS);
    this.x[k] = x;
    this.y[k] = y;
    this.vx[k] = vx;
    this.vy[k] = vy;
    this.ax[k] = ax;
    this.ay[k] = ay;
    this.alongMm[k] = alongMm;
  }

  /** The blocks as a trajectory has them. The arrays are the same, not copies. */
  ofTrajectory() {
    const { count: blockCount, durationS, x, y, vx, vy, ax, ay, jx, jy, startS, alongMm } = this;
    return { blockCount, durationS, x, y, vx, vy, ax, ay, jx, jy, startS, alongMm };
  }

  /** Appends block i of `from`, without its jerk. */
  pushFrom({ durationS, x, y, vx, vy, ax, ay, alongMm }: BlockColumns, i: number): void {
    this.push(durationS[i], x[i], y[i], vx[i], vy[i], ax[i], ay[i], alongMm[i]);
  }

  /** Moves the blocks from `first` on in time. */
  shift(first: number, byS: number): void {
    for (let k = first; k < this.count; k++) this.startS[k] += byS;
    this.clockS += byS;
  }

  /** Removes the blocks of zero duration from `first` on, and recomputes the start times. They must have no jerk. */
  removeEmpty(first: number): void {
    const { count, durationS, x, y, vx, vy, ax, ay, startS, alongMm } = this;
    let clockS = startS[first];
    let to = first;
    for (let k = first; k < count; k++) {
      if (durationS[k] === 0) continue;
      durationS[to] = durationS[k];
      x[to] = x[k];
      y[to] = y[k];
      vx[to] = vx[k];
      vy[to] = vy[k];
      ax[to] = ax[k];
      ay[to] = ay[k];
      alongMm[to] = alongMm[k];
      startS[to] = clockS;
      clockS += durationS[to];
      to++;
    }
    this.count = to;
    this.clockS = clockS;
  }

  /** Removes all blocks; the arrays stay allocated. */
  clear(): void {
    this.count = 0;
    this.clockS = 0;
  }

  /** Trims the arrays to their used length, if that saves enough to be worth a copy. */
  trim(): void {
    if (this.durationS.length > this.count * (1 + WASTE)) this.resize(this.count);
  }

  private resize(capacity: number): void {
    for (const name of COLUMN_NAMES) this[name] = resized(this[name], this.count, capacity);
    if (this.jx) this.jx = resized(this.jx, this.count, capacity);
    if (this.jy) this.jy = resized(this.jy, this.count, capacity);
  }
}

function resized(
  from: Float64Array<ArrayBuffer>,
  count: number,
  capacity: number,
): Float64Array<ArrayBuffer> {
  const to = new Float64Array(Math.ceil(capacity));
  to.set(count < from.length ? from.subarray(0, count) : from);
  return to;
}
