/**
 * The blocks of a trajectory while it is being made: columns that grow, and a running clock.
 *
 * When they must grow, the share of the drawing already planned tells how much the whole will need, so they seldom grow
 * twice.
 */
const COLUMN_NAMES = ["durationS", "x", "y", "vx", "vy", "ax", "ay", "startS", "alongMm"] as const;

/** Arrays longer than what is used by more than this share are cut to size at the end. */
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
  /** Only where `withJerk`: jerk is zero everywhere otherwise. */
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

  /** Says that the blocks so far are those of `segments` more segments of the drawing. */
  addSegments(segments: number): void {
    this.segmentsDone += segments;
    this.blocksDone = this.count;
  }

  private grow(needed: number): void {
    const { segmentsDone, blocksDone } = this;
    const likely = segmentsDone > 0 ? 1.02 * this.segmentsExpected * (blocksDone / segmentsDone) : 4 * needed;
    // Up to 32 times as much: the first strokes may be unlike the rest.
    this.resize(Math.min(likely > needed ? likely : 2 * needed, 32 * needed) + 64);
  }

  /** Appends one block and moves the clock on. */
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
    if (this.count === this.durationS.length) this.grow(this.count + 1);
    const k = this.count++;
    this.durationS[k] = durationS;
    this.x[k] = x;
    this.y[k] = y;
    this.vx[k] = vx;
    this.vy[k] = vy;
    this.ax[k] = ax;
    this.ay[k] = ay;
    this.alongMm[k] = alongMm;
    this.startS[k] = this.clockS;
    this.clockS += durationS;
    if (this.jx !== null && this.jy !== null) this.jx[k] = this.jy[k] = 0;
  }

  /** Block i, which lies beyond the end, becomes the last one. */
  moveToEnd(i: number): void {
    const { durationS, x, y, vx, vy, ax, ay, alongMm } = this;
    this.push(durationS[i]!, x[i]!, y[i]!, vx[i]!, vy[i]!, ax[i]!, ay[i]!, alongMm[i]!);
  }

  /** Jerk of the last block; only where there are columns for it. */
  setJerk(jx: number, jy: number): void {
    if (this.jx === null || this.jy === null) return;
    this.jx[this.count - 1] = jx;
    this.jy[this.count - 1] = jy;
  }

  /** Forgets the blocks and keeps the arrays. */
  clear(): void {
    this.count = 0;
    this.clockS = 0;
  }

  /** Cuts the arrays to what is used, where that saves enough to be worth a copy. */
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
