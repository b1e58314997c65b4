/**
 * Input shapers: sequences of impulses that leave a damped spring at rest. Each axis is such a spring, of natural
 * frequency f and damping ratio ζ. The simplest shaper sends the motion twice, half a period apart, so that the two
 * swings cancel.
 *
 *   T = 1/(f √(1 − ζ²))       period of the damped swing, s
 *   K = exp(−ζπ/√(1 − ζ²))    the share of a swing that is left after T/2; K^p after p T/2
 *
 *   zv    1, K           at 0, T/2            no swing at f; the shortest
 *   mzv   1, √2 k, k²    at 0, 3T/8, 3T/4     no swing at f, less near it; k = K^¾
 *   zvd   1, 2K, K²      at 0, T/2, T         as zv, and the swing's derivative with respect to f is 0 too
 *   ei    b, 2cK, bK²    at 0, T/2, T         leaves 5 % of the swing at f, and at most 5 % in a wide band around it
 *
 * The weights are divided by their sum. mzv: three impulses 3/8 T apart have phases 0°, 135°, 270°; they cancel for
 * weights 1 : √2 : 1. Sources: Singer and Seering (1990) for zv and zvd; Singhose, Seering and Singer (1994) for ei.
 */
import type { MotionSettings, Shaper } from "../../settings/motion.js";
import type { Springs } from "../../machines/profile.js";
import { impulseKernel, meanDelayOf, type Impulse, type Kernel } from "./impulse-filter.js";

/** Share of the swing that ei leaves at f. */
const EI_REST = 0.05;

/** Weights without damping, and the time between impulses in half periods. */
const SHAPES: Readonly<Record<Exclude<Shaper, "none">, { weights: readonly number[]; halves: number }>> = {
  zv: { weights: [1, 1], halves: 1 },
  mzv: { weights: [1, Math.SQRT2, 1], halves: 3 / 4 },
  zvd: { weights: [1, 2, 1], halves: 1 },
  ei: { weights: [1 + EI_REST, 2 * (1 - EI_REST), 1 + EI_REST], halves: 1 },
};

export function shaperImpulses(shaper: Exclude<Shaper, "none">, hz: number, damping: number): Impulse[] {
  const { weights, halves } = SHAPES[shaper];
  const root = Math.sqrt(1 - damping * damping);
  const stepS = halves / (2 * hz * root);
  const decay = Math.exp((-damping * Math.PI * halves) / root);
  const decayed = weights.map((weight, i) => weight * decay ** i);
  const sum = decayed.reduce((total, weight) => total + weight, 0);
  return decayed.map((weight, i) => ({ delayS: i * stepS, weight: weight / sum }));
}

/** Null if there is nothing to shape. */
export function shaperKernel(shaper: Shaper, springs: Springs | null): Kernel | null {
  if (shaper === "none" || springs === null) return null;
  const { xHz, yHz, damping } = springs;
  return impulseKernel(shaperImpulses(shaper, xHz, damping), shaperImpulses(shaper, yHz, damping));
}

/**
 * Max deviation of the carriage from the planned line, mm: |u(t) − q(t − D)| ≤ A σ²/2, where D is the mean delay and σ²
 * the variance of the impulses. A is the acceleration limit with the pen down.
 */
export function maxShapingErrorMm({ shaper, draw, layers }: MotionSettings, springs: Springs | null): number {
  if (shaper === undefined || shaper === "none" || springs === null) return 0;
  const variances = [springs.xHz, springs.yHz].map((hz) =>
    varianceOf(shaperImpulses(shaper, hz, springs.damping)),
  );
  const accels = Object.values(layers ?? {}).map((layer) => layer.accelMmPerS2 ?? 0);
  return (Math.max(draw.accelMmPerS2, ...accels) * Math.max(...variances)) / 2;
}

function varianceOf(impulses: readonly Impulse[]): number {
  const mean = meanDelayOf(impulses);
  return impulses.reduce((sum, { delayS, weight }) => sum + weight * (delayS - mean) ** 2, 0);
}
