/**
 * A stop in a shaped motion: brakes the planned motion, and shapes the braking too, so that the pen does not swing
 * afterwards.
 *
 *   planned   ──recent──|──braking──|            recent: the planned motion within the shaper's length before the stop
 *   shaped              |──────────────────|     from the stop on; longer by the shaper's last delay
 */
import { BlockColumns } from "../block-columns.js";
import { ImpulseFilter, type Kernel } from "../shaping/impulse-filter.js";
import { NO_LIMITS, type RunLimits } from "../limits.js";
import { mergeBlocks, SHAPED_RULES } from "../merge.js";
import type { RunEnd } from "../run-path.js";
import { blockState, newMotionState, type MotionState, type Trajectory } from "../trajectory.js";

/** Shorter pieces are rounding errors, s. */
const NO_PIECE_S = 1e-9;
/** A correction within this time is too quick for the gantry to follow, s. */
const JOIN_S = 0.02;

export interface ShapedRest {
  /** Both have time 0 where the stop begins; the planned motion begins before that. */
  readonly planned: BlockColumns;
  readonly shaped: BlockColumns;
}

/**
 * @param planned the motion before the shaper
 * @param tS when the braking begins
 * @param carriage its state at `tS`
 * @param braking blocks of the planned motion from `tS` on; none if it is at rest then
 * @param end where the planned motion comes to rest
 */
export function shapeRest(
  planned: Trajectory,
  run: number,
  kernel: Kernel,
  tS: number,
  carriage: MotionState,
  braking: BlockColumns,
  end: RunEnd,
): ShapedRest {
  const recent = new BlockColumns(0, false);
  addWindow(planned, run, tS - kernel.lengthS, tS, recent);
  for (let k = 0; k < braking.count; k++) recent.pushFrom(braking, k);
  const filtered = new BlockColumns(0, false);
  const shaped = new BlockColumns(0, false);
  if (recent.count === 0) return { planned: recent, shaped };
  const beginS = recent.startS[0] + new ImpulseFilter(kernel).write(recent, 0, end, filtered);
  const exact = new BlockColumns(0, false);
  addAfter(filtered, -beginS, exact);
  joinFrom(carriage, exact, end, shaped);
  mergeBlocks(shaped, 0, end, limitsOf(shaped), SHAPED_RULES);
  return { planned: recent, shaped };
}

/**
 * The carriage follows merged blocks (merge.ts), so it is a few µm away from the exact motion. Two blocks of constant
 * acceleration lead from its state to the exact motion JOIN_S later.
 */
function joinFrom(
  carriage: MotionState,
  exact: BlockColumns,
  end: { readonly x: number; readonly y: number },
  out: BlockColumns,
): void {
  if (exact.count === 0) return;
  let k = 0;
  while (k < exact.count && exact.startS[k] < JOIN_S) k++;
  const isEnd = k === exact.count;
  const [x1, y1] = isEnd ? [end.x, end.y] : [exact.x[k], exact.y[k]];
  const [vx1, vy1] = isEnd ? [0, 0] : [exact.vx[k], exact.vy[k]];
  const wholeS = isEnd ? Math.max(exact.clockS, JOIN_S / 2) : exact.startS[k];
  const { x, y, vx, vy } = carriage;
  const wx = (2 * (x1 - x)) / wholeS - (vx + vx1) / 2;
  const wy = (2 * (y1 - y)) / wholeS - (vy + vy1) / 2;
  const half = wholeS / 2;
  out.push(half, x, y, vx, vy, (wx - vx) / half, (wy - vy) / half, 0);
  const [mx, my] = [x + (half * (vx + wx)) / 2, y + (half * (vy + wy)) / 2];
  out.push(half, mx, my, wx, wy, (vx1 - wx) / half, (vy1 - wy) / half, 0);
  for (; k < exact.count; k++) out.pushFrom(exact, k);
}

/** The maxima of these blocks, as limits for merging them. */
function limitsOf({ count, vx, vy, ax, ay }: BlockColumns): RunLimits {
  let speed = 0;
  let accel = 0;
  for (let k = 0; k < count; k++) {
    speed = Math.max(speed, Math.abs(vx[k]), Math.abs(vy[k]));
    accel = Math.max(accel, Math.abs(ax[k]), Math.abs(ay[k]));
  }
  return { ...NO_LIMITS, speed, accel };
}

/** Appends the part of run `run` from `fromS` to `toS`. Time 0 is `toS`. */
function addWindow(planned: Trajectory, run: number, fromS: number, toS: number, out: BlockColumns): void {
  const { runs, startS, durationS } = planned;
  const state = newMotionState();
  for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1] && startS[k] < toS; k++) {
    const from = Math.max(0, fromS - startS[k]);
    const to = Math.min(durationS[k], toS - startS[k]);
    if (to - from <= NO_PIECE_S) continue;
    const { x, y, vx, vy, ax, ay, alongMm } = blockState(planned, k, from, state);
    out.clockS = startS[k] + from - toS;
    out.push(to - from, x, y, vx, vy, ax, ay, alongMm);
  }
}

/** Appends the part of `from` after `tS`. */
function addAfter(from: BlockColumns, tS: number, out: BlockColumns): void {
  for (let k = 0; k < from.count; k++) {
    const t = Math.max(0, tS - from.startS[k]);
    const rest = from.durationS[k] - t;
    if (rest <= NO_PIECE_S) continue;
    const [vx, vy, ax, ay] = [from.vx[k], from.vy[k], from.ax[k], from.ay[k]];
    const x = from.x[k] + t * (vx + (t * ax) / 2);
    const y = from.y[k] + t * (vy + (t * ay) / 2);
    out.push(rest, x, y, vx + t * ax, vy + t * ay, ax, ay, from.alongMm[k]);
  }
}
