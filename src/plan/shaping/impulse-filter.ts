/**
 * The filter of input shapers (shapers.ts): the output is a sum of delayed, weighted copies of the planned
 * motion q. Each axis has its own impulses.
 *
 *   u(t) = Σ Aᵢ q(t − tᵢ)      Σ Aᵢ = 1
 *
 * q has constant acceleration per block. So u has constant acceleration as long as no copy passes the end of a
 * block, and the output consists of blocks again, exactly. It is longer than the input by the delay of the last
 * impulse. With weights Aᵢ ≥ 0 each axis keeps the input's limits of speed and acceleration.
 *
 * Method: each axis separately is a sequence of pieces of constant acceleration. An output block ends wherever a
 * piece of either axis ends.
 */
import type { BlockColumns } from "../block-columns.js";

/** One delayed, weighted copy of the motion of an axis. */
export interface Impulse {
  readonly delayS: number;
  readonly weight: number;
}

/** The impulses of a shaper, for each axis. */
export interface Kernel {
  /** Sorted by delay. */
  readonly x: readonly Impulse[];
  readonly y: readonly Impulse[];
  /** Mean delay of the output, s; the same in both axes. */
  readonly meanDelayS: number;
  /** Delay of the last impulse, s: how much longer the output is than the input. */
  readonly lengthS: number;
}

/**
 * The axis with the shorter mean delay is delayed further, so that both have the same mean delay: otherwise
 * straight lines would bend.
 */
export function impulseKernel(x: readonly Impulse[], y: readonly Impulse[]): Kernel {
  const [meanX, meanY] = [meanDelayOf(x), meanDelayOf(y)];
  const meanDelayS = Math.max(meanX, meanY);
  const delayedX = delayed(x, meanDelayS - meanX);
  const delayedY = delayed(y, meanDelayS - meanY);
  const lengthS = Math.max(...[...delayedX, ...delayedY].map(({ delayS }) => delayS));
  return { x: delayedX, y: delayedY, meanDelayS, lengthS };
}

export const meanDelayOf = (impulses: readonly Impulse[]): number =>
  impulses.reduce((sum, { delayS, weight }) => sum + weight * delayS, 0);

const delayed = (impulses: readonly Impulse[], byS: number): readonly Impulse[] =>
  impulses.map(({ delayS, weight }) => ({ delayS: delayS + byS, weight }));

/** Ends of blocks closer in time than this are treated as one, s. */
const SAME_S = 1e-11;

/** One coordinate of the output: its current piece of constant acceleration. */
class Axis {
  /** When it begins and ends, s after the start of the input. */
  startS = 0;
  endS = 0;
  /** Position, velocity and acceleration at its start. */
  p = 0;
  v = 0;
  a = 0;
  private readonly delayS: Float64Array;
  private readonly weight: Float64Array;
  /** For each impulse: its current block, and when it leaves that block. */
  private readonly block: Int32Array;
  private readonly leavesS: Float64Array;

  constructor(impulses: readonly Impulse[]) {
    this.delayS = Float64Array.from(impulses, ({ delayS }) => delayS);
    this.weight = Float64Array.from(impulses, ({ weight }) => weight);
    this.block = new Int32Array(impulses.length);
    this.leavesS = new Float64Array(impulses.length);
  }

  /** Sets the first piece: the rest before the start. */
  begin(first: number, p: number): void {
    for (let i = 0; i < this.block.length; i++) {
      this.block[i] = first - 1;
      this.leavesS[i] = this.delayS[i];
    }
    this.startS = this.v = this.a = 0;
    this.p = p;
    this.endS = this.delayS[0];
  }

  /** Sets the next piece. Row `end` of the input's columns is the rest after the last block. */
  next(
    first: number,
    end: number,
    startS: Float64Array,
    p: Float64Array,
    v: Float64Array,
    a: Float64Array,
  ): void {
    const { delayS, weight, block, leavesS } = this;
    const tS = this.endS;
    let endS = Infinity;
    let p1 = 0;
    let v1 = 0;
    let a1 = 0;
    for (let i = 0; i < weight.length; i++) {
      if (leavesS[i] <= tS + SAME_S) {
        const k = ++block[i];
        leavesS[i] = k < end ? delayS[i] + startS[k + 1] - startS[first] : Infinity;
      }
      if (leavesS[i] < endS) endS = leavesS[i];
      const w = weight[i];
      const k = block[i];
      if (k < first) p1 += w * p[first];
      else if (k === end) p1 += w * p[end];
      else {
        const s = tS - delayS[i] - (startS[k] - startS[first]);
        p1 += w * (p[k] + s * (v[k] + (s * a[k]) / 2));
        v1 += w * (v[k] + s * a[k]);
        a1 += w * a[k];
      }
    }
    this.startS = tS;
    this.endS = endS;
    this.p = p1;
    this.v = v1;
    this.a = a1;
  }
}

export class ImpulseFilter {
  private readonly x: Axis;
  private readonly y: Axis;

  constructor(kernel: Kernel) {
    this.x = new Axis(kernel.x);
    this.y = new Axis(kernel.y);
  }

  /**
   * Appends the filtered run to `out`, without rests at its beginning and end. The place along the drawing is
   * set later (shaped-along.ts).
   *
   * @param from the run is its blocks from `first` on
   * @param end where the run comes to rest
   * @returns how much later than the input the output begins to move, s
   */
  write(
    from: BlockColumns,
    first: number,
    end: { readonly x: number; readonly y: number },
    out: BlockColumns,
  ): number {
    const { x, y } = this;
    const { count } = from;
    // A row for the rest after the last block.
    from.push(0, end.x, end.y, 0, 0, 0, 0, 0);
    from.count = count;
    const { startS } = from;
    const firstOut = out.count;
    let beginS = 0;
    x.begin(first, from.x[first]);
    y.begin(first, from.y[first]);
    let tS = 0;
    for (;;) {
      if (x.endS <= tS + SAME_S) x.next(first, count, startS, from.x, from.vx, from.ax);
      if (y.endS <= tS + SAME_S) y.next(first, count, startS, from.y, from.vy, from.ay);
      const nextS = x.endS < y.endS ? x.endS : y.endS;
      if (nextS === Infinity) break;
      const sx = tS - x.startS;
      const sy = tS - y.startS;
      const vx = x.v + sx * x.a;
      const vy = y.v + sy * y.a;
      // Leave out the rest at the beginning: a move along one axis begins with the first impulse of that axis.
      if (out.count === firstOut && vx === 0 && vy === 0 && x.a === 0 && y.a === 0) beginS = nextS;
      else {
        const k = out.add(nextS - tS);
        out.x[k] = x.p + (sx * (x.v + vx)) / 2;
        out.y[k] = y.p + (sy * (y.v + vy)) / 2;
        out.vx[k] = vx;
        out.vy[k] = vy;
        out.ax[k] = x.a;
        out.ay[k] = y.a;
        out.alongMm[k] = 0;
      }
      tS = nextS;
    }
    while (out.count > firstOut && isRest(out, out.count - 1)) out.clockS = out.startS[--out.count];
    return beginS;
  }
}

const isRest = ({ vx, vy, ax, ay }: BlockColumns, k: number): boolean =>
  vx[k] === 0 && vy[k] === 0 && ax[k] === 0 && ay[k] === 0;
