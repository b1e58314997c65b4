/** What merging wants to know of every piece again and again: where it is beside the plan, and which way it goes. */
import type { BlockColumns } from "./block-columns.js";

const NAMES = [
  "knot",
  "middle",
  "knotUx",
  "knotUy",
  "middleX",
  "middleY",
  "middleUx",
  "middleUy",
  "jump",
] as const;

export class PieceNotes {
  /** The plan's instant where the piece begins, s; written before, one more than pieces. */
  tau = new Float64Array(0);
  /** The plan's block at that instant. */
  block = new Int32Array(0);
  /** Distance to the left of the plan's line where the piece begins, and in its middle, mm; NaN where that is not known. */
  knot = new Float64Array(0);
  middle = new Float64Array(0);
  /** Unit direction at the beginning; place and direction in the middle. */
  knotUx = new Float64Array(0);
  knotUy = new Float64Array(0);
  middleX = new Float64Array(0);
  middleY = new Float64Array(0);
  middleUx = new Float64Array(0);
  middleUy = new Float64Array(0);
  /** By how much the acceleration to the left changes where the piece begins, mm/s². */
  jump = new Float64Array(0);

  /** Makes room for so many pieces. What was there is lost, but for τ. */
  reserve(count: number): void {
    if (this.block.length >= count) return;
    const size = 2 * count;
    const tau = new Float64Array(size);
    tau.set(this.tau);
    this.tau = tau;
    this.block = new Int32Array(size);
    for (const name of NAMES) this[name] = new Float64Array(size);
  }

  /** Notes directions and middle of piece i. */
  note(i: number, { durationS, x, y, vx, vy, ax, ay }: BlockColumns): void {
    const half = durationS[i]! / 2;
    const ux = vx[i]!;
    const uy = vy[i]!;
    const wx = ux + half * ax[i]!;
    const wy = uy + half * ay[i]!;
    const v = 1 / Math.sqrt(ux * ux + uy * uy);
    const w = 1 / Math.sqrt(wx * wx + wy * wy);
    this.knotUx[i] = v * ux;
    this.knotUy[i] = v * uy;
    this.jump[i] = i > 0 ? v * (ux * (ay[i]! - ay[i - 1]!) - uy * (ax[i]! - ax[i - 1]!)) : 0;
    this.middleX[i] = x[i]! + (half * (ux + wx)) / 2;
    this.middleY[i] = y[i]! + (half * (uy + wy)) / 2;
    this.middleUx[i] = w * wx;
    this.middleUy[i] = w * wy;
  }
}
