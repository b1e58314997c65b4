/**
 * Fewer, longer blocks: replaces neighbouring blocks of a run by two blocks of constant acceleration (a
 * pair).
 *
 *   blocks  |--|-|--|-|--|-|--|-|--|        from state (p₀, v₀) to state (p₁, v₁) in T seconds
 *   pair    |-----T/2-----|-----T/2-----|
 *
 *   velocity in the middle   w = 2 Δp/T − (v₀ + v₁)/2
 *   accelerations            a₁ = 2 (w − v₀)/T        a₂ = 2 (v₁ − w)/T
 *
 * A pair ends in exactly the same state as the blocks it replaces, so no error is carried forward. It is
 * allowed if
 *
 *   |w| ≤ V and |a₁|, |a₂| ≤ A     (velocity is linear in each half, so the extremes are at the ends)
 *   it deviates from the planned line by at most ε
 *   it is slower than the slowest of its blocks by at most MAX_DIP
 *
 * At each block, start with a group as long as the one merged just before, or else with the shortest. The group grows
 * until it fails, or shrinks until it passes (greedy, no backtracking). Linear in the number of blocks.
 *
 * A pair may take slightly longer than its blocks (STRETCH). Its velocity oscillates slightly around that of an
 * arc, so on an arc drawn at V or A almost no pair would be allowed without extra time.
 */
import type { BlockColumns } from "./block-columns.js";
import { isVelocityAllowed, SLACK, type RunLimits } from "./limits.js";
import type { RunEnd } from "./run-path.js";

/** A pair may take longer than the blocks that it replaces by this share. */
const STRETCH = 0.012;

/** A pair may be slower than the slowest of its blocks by this share. */
const MAX_DIP = 0.04;

/** Longest pair, s: the position along the drawing is only interpolated inside a block. */
const LONGEST_S = 0.6;

/** A deviation that lasts for less than this is too short to excite a gantry that resonates at 10 to 40 Hz, s. */
const SHORT_S = 0.024;

/** Factor from one trial length to the next. */
const GROWTH = 1.25;

/** Shortest group from which merging always saves a block. */
const MIN_GROUP = 3;

/** Max duration of a group for each block saved, s: a board handles long blocks easily, so merging them gains nothing. */
const LONGEST_PER_SAVED_S = 0.2;

export interface MergeRules {
  /** ε, mm. */
  readonly toleranceMm: number;
  /** ε of pairs shorter than SHORT_S, mm. */
  readonly shortToleranceMm: number;
  /** Blocks shorter than this should be merged, s. */
  readonly floorS: number;
  /** False if a pair must match the plan at equal times, because velocity jumps at vertices or the motion is shaped. */
  readonly isSmooth: boolean;
  /** The limits apply to each axis separately, and no pair may take longer than the blocks that it replaces. */
  readonly isShaped: boolean;
}

/**
 * For the blocks of a shaped motion. The tolerance is small, because a deviation excites the vibration again unless
 * it is too short for the gantry to follow. The floor is above the 5 ms that the board may need for a command.
 */
export const SHAPED_RULES: MergeRules = {
  toleranceMm: 0.005,
  shortToleranceMm: 0.02,
  floorS: 0.006,
  isSmooth: false,
  isShaped: true,
};

/** Merges the blocks of one run, from `first` to the last one, in place. The run ends at rest at `at`. */
export function mergeBlocks(
  blocks: BlockColumns,
  first: number,
  at: RunEnd,
  limits: RunLimits,
  rules: MergeRules,
): void {
  const last = blocks.count;
  // Add a row for the end state of the last block, so that every block has a successor.
  blocks.push(0, at.x, at.y, 0, 0, 0, 0, at.alongMm);
  let firstPair = last;
  let size = MIN_GROUP;
  let i = first;
  while (i < last) {
    const end = mergeGroup(blocks, i, Math.min(i + size, last), last, limits, rules);
    if (end > i) firstPair = Math.min(firstPair, i);
    size = Math.max(MIN_GROUP, end - i);
    i = Math.max(i + 1, end);
  }
  blocks.removeEmpty(firstPair);
}

/**
 * Replaces a group of blocks [i, end) by a pair. Tries the group that ends at `guess` first, then grows or shrinks it.
 * Returns the end of the longest group that passed; i if none did.
 */
function mergeGroup(
  blocks: BlockColumns,
  i: number,
  guess: number,
  last: number,
  limits: RunLimits,
  rules: MergeRules,
): number {
  let end = guess;
  let wholeS = pairTime(blocks, i, end, limits, rules);
  while (wholeS === 0) {
    if (end <= i + 2) return i;
    end = i + Math.floor((end - i) / GROWTH);
    wholeS = pairTime(blocks, i, end, limits, rules);
  }
  while (end >= guess && end < last) {
    const longer = Math.min(i + Math.ceil(GROWTH * (end - i)), last);
    const longerS = pairTime(blocks, i, longer, limits, rules);
    if (longerS === 0) break;
    end = longer;
    wholeS = longerS;
  }
  writePair(blocks, i, end, wholeS);
  return end;
}

/** Duration of the pair that can replace blocks [i, m), s; 0 if none can, or if it saves nothing. */
function pairTime(blocks: BlockColumns, i: number, m: number, limits: RunLimits, rules: MergeRules): number {
  if (!isWorthMerging(blocks, i, m, rules.floorS)) return 0;
  const wholeS = allowedTime(blocks, i, m, limits, rules);
  const isAllowed =
    wholeS > 0 && isNear(blocks, i, m, wholeS, limits, rules) && isFastEnough(blocks, i, m, wholeS);
  return isAllowed ? wholeS : 0;
}

/** One axis of the pair's velocity in its middle. */
const middleVelocity = (d: number, v0: number, v1: number, wholeS: number): number =>
  (2 * d) / wholeS - (v0 + v1) / 2;

/**
 * The duration of the pair, s: that of its blocks, or slightly longer. 0 if with either duration the pair exceeds V, A or
 * a motor limit, or reverses direction in one half (the position along the drawing is interpolated by speed).
 */
function allowedTime(
  { startS, x, y, vx, vy }: BlockColumns,
  i: number,
  m: number,
  limits: RunLimits,
  { isShaped }: MergeRules,
): number {
  const { stretchX, stretchY } = limits;
  const dx = x[m] - x[i];
  const dy = y[m] - y[i];
  const vx0 = vx[i];
  const vy0 = vy[i];
  const vx1 = vx[m];
  const vy1 = vy[m];
  const blocksS = startS[m] - startS[i];
  const maxS = isShaped ? blocksS : blocksS * (1 + STRETCH);
  for (let wholeS = blocksS; wholeS <= maxS; wholeS *= 1 + STRETCH) {
    const wx = middleVelocity(dx, vx0, vx1, wholeS);
    const wy = middleVelocity(dy, vy0, vy1, wholeS);
    const maxChange = (limits.accel * SLACK * wholeS) / 2;
    if (
      isShorter(wx - vx0, wy - vy0, maxChange, isShaped) &&
      isShorter(vx1 - wx, vy1 - wy, maxChange, isShaped) &&
      isShorter(wx / stretchX, wy / stretchY, limits.speed * SLACK, isShaped) &&
      vx0 * wx + vy0 * wy >= 0 &&
      wx * vx1 + wy * vy1 >= 0 &&
      isVelocityAllowed(limits, wx / stretchX, wy / stretchY)
    ) {
      return wholeS;
    }
  }
  return 0;
}

const isShorter = (x: number, y: number, maxLength: number, inEachAxis: boolean): boolean =>
  inEachAxis ? Math.abs(x) <= maxLength && Math.abs(y) <= maxLength : x * x + y * y <= maxLength * maxLength;

/**
 * A pair is useful if it saves blocks that are not long anyway. It is also useful if it replaces two blocks, one of them
 * shorter than the floor, by two that are not.
 */
function isWorthMerging({ startS, durationS }: BlockColumns, i: number, m: number, floorS: number): boolean {
  const wholeS = startS[m] - startS[i];
  if (wholeS > LONGEST_S) return false;
  if (m - i >= MIN_GROUP) return wholeS <= LONGEST_PER_SAVED_S * (m - i - 2);
  return m - i === 2 && wholeS >= 2 * floorS && Math.min(durationS[i], durationS[i + 1]) < floorS;
}

/**
 * Whether the pair stays within ε of the planned line, checked once per block. The difference e of the two
 * motions is known at the block's start. Within the block e is a parabola, so it deviates from the straight
 * line between its end values by at most |e″| d²/8.
 *
 * Being early or late along the line is allowed, since only the drawn line matters. An offset of s mm along the
 * line counts as a distance of A s²/v². Over s mm, a line drawn at v under A deviates from a straight by at most
 * half of that; the other half is a margin for parts nearby that are drawn slower.
 */
function isNear(
  { durationS, startS, x, y, vx, vy, ax, ay }: BlockColumns,
  i: number,
  m: number,
  wholeS: number,
  { accel }: RunLimits,
  rules: MergeRules,
): boolean {
  const tolerance = wholeS < SHORT_S ? rules.shortToleranceMm : rules.toleranceMm;
  // The pair in the time of its blocks: faster if it takes longer than they do.
  const start = startS[i];
  const blocksS = startS[m] - start;
  const faster = wholeS / blocksS;
  const halfS = blocksS / 2;
  const x0 = x[i];
  const y0 = y[i];
  const vx0 = vx[i] * faster;
  const vy0 = vy[i] * faster;
  const x1 = x[m];
  const y1 = y[m];
  const vx1 = vx[m] * faster;
  const vy1 = vy[m] * faster;
  const wx = middleVelocity(x1 - x0, vx0, vx1, blocksS);
  const wy = middleVelocity(y1 - y0, vy0, vy1, blocksS);
  const a1x = (wx - vx0) / halfS;
  const a1y = (wy - vy0) / halfS;
  const a2x = (vx1 - wx) / halfS;
  const a2y = (vy1 - wy) / halfS;
  // Slower than this, the line can bend with a radius of 16 ε or less: too tight to tell along from across.
  const slow2 = rules.isSmooth ? 16 * tolerance * accel : Infinity;
  for (let k = i; k < m; k++) {
    const d = durationS[k];
    const t = startS[k] - start;
    const isFirst = t < halfS;
    const u = isFirst ? t : t - blocksS;
    const dx = isFirst ? x0 + u * (vx0 + (u * a1x) / 2) - x[k] : x1 + u * (vx1 + (u * a2x) / 2) - x[k];
    const dy = isFirst ? y0 + u * (vy0 + (u * a1y) / 2) - y[k] : y1 + u * (vy1 + (u * a2y) / 2) - y[k];
    // e in the middle of the block, if the pair's acceleration there is that of its first or its second half. Both are
    // possible in the block that contains the pair's middle.
    const isSecond = !isFirst || t + d > halfS;
    const first = isFirst ? (d * d) / 8 : 0;
    const second = isSecond ? (d * d) / 8 : 0;
    const e1x = first * (a1x - ax[k]);
    const e1y = first * (a1y - ay[k]);
    const e2x = second * (a2x - ax[k]);
    const e2y = second * (a2y - ay[k]);
    const rest = tolerance - Math.max(Math.abs(e1x) + Math.abs(e1y), Math.abs(e2x) + Math.abs(e2y));
    if (rest > 0 && dx * dx + dy * dy <= rest * rest) continue;
    const ux = vx[k];
    const uy = vy[k];
    const v2 = ux * ux + uy * uy;
    if (v2 < slow2) return false;
    const across =
      Math.abs(dx * uy - dy * ux) + Math.max(Math.abs(e1x * uy - e1y * ux), Math.abs(e2x * uy - e2y * ux));
    const along =
      Math.abs(dx * ux + dy * uy) + Math.max(Math.abs(e1x * ux + e1y * uy), Math.abs(e2x * ux + e2y * uy));
    if (across / Math.sqrt(v2) + (accel * along * along) / (v2 * v2) > tolerance) return false;
  }
  return true;
}

/**
 * Whether the pair is slower than the slowest of its blocks by at most MAX_DIP. A pair that cuts a tight bend inside ε can
 * be much slower there, which shows as a heavier line.
 */
function isFastEnough(blocks: BlockColumns, i: number, m: number, wholeS: number): boolean {
  const { durationS, x, y, vx, vy, ax, ay } = blocks;
  const wx = middleVelocity(x[m] - x[i], vx[i], vx[m], wholeS);
  const wy = middleVelocity(y[m] - y[i], vy[i], vy[m], wholeS);
  const pair2 = Math.min(lowestSpeed2(vx[i], vy[i], wx, wy), lowestSpeed2(wx, wy, vx[m], vy[m]));
  const allowed2 = pair2 / (1 - MAX_DIP) ** 2;
  for (let k = i; k <= m; k++) {
    const d = durationS[k];
    if (lowestSpeed2(vx[k], vy[k], vx[k] + d * ax[k], vy[k] + d * ay[k]) <= allowed2) return true;
  }
  return false;
}

/** The lowest speed² while the velocity changes evenly from v to w: the distance² of its straight from 0. */
function lowestSpeed2(vx: number, vy: number, wx: number, wy: number): number {
  const changeX = wx - vx;
  const changeY = wy - vy;
  const fromV = -(vx * changeX + vy * changeY);
  const change2 = changeX * changeX + changeY * changeY;
  if (fromV <= 0) return vx * vx + vy * vy;
  if (fromV >= change2) return wx * wx + wy * wy;
  const across = vx * wy - vy * wx;
  return (across * across) / change2;
}

/** Writes the pair over blocks i and i + 1. The others of [i, m) get zero duration, so that they are removed later. */
function writePair(blocks: BlockColumns, i: number, m: number, wholeS: number): void {
  const { durationS, x, y, vx, vy, ax, ay, alongMm } = blocks;
  const halfS = wholeS / 2;
  const wx = middleVelocity(x[m] - x[i], vx[i], vx[m], wholeS);
  const wy = middleVelocity(y[m] - y[i], vy[i], vy[m], wholeS);
  const middle = lengthOf(wx, wy);
  const first = lengthOf(vx[i], vy[i]) + middle;
  const second = middle + lengthOf(vx[m], vy[m]);
  const share = first > 0 ? first / (first + second) : 0;
  for (let k = i + 2; k < m; k++) durationS[k] = 0;
  durationS[i] = durationS[i + 1] = halfS;
  ax[i] = (wx - vx[i]) / halfS;
  ay[i] = (wy - vy[i]) / halfS;
  alongMm[i + 1] = alongMm[i] + share * (alongMm[m] - alongMm[i]);
  x[i + 1] = x[i] + (halfS * (vx[i] + wx)) / 2;
  y[i + 1] = y[i] + (halfS * (vy[i] + wy)) / 2;
  vx[i + 1] = wx;
  vy[i + 1] = wy;
  ax[i + 1] = (vx[m] - wx) / halfS;
  ay[i + 1] = (vy[m] - wy) / halfS;
}

const lengthOf = (x: number, y: number): number => Math.sqrt(x * x + y * y);
