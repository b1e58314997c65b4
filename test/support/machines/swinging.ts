/** Machines that swing, for tests of shaped motion. */
import { DEFAULT_MOTION, machineById, type MachineProfile, type MotionSettings } from "../../../src/index.js";
import { motionOfQuality, type Quality, type Springs } from "../../../src/internal.js";
import { strokeSetOf, type Point } from "../drawings/arbitraries.js";

export const SPRINGS: readonly Springs[] = [
  { xHz: 15, yHz: 25, damping: 0.05 },
  { xHz: 10, yHz: 15, damping: 0.05 },
  { xHz: 25, yHz: 40, damping: 0.05 },
];

export const swinging = (springs: Springs): MachineProfile => ({ ...machineById("axidraw-v3"), springs });

export const inQuality = (quality: Quality, springs: Springs): MotionSettings => ({
  ...DEFAULT_MOTION,
  ...motionOfQuality(quality, springs),
});

export function median(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

const points = (count: number, at: (share: number) => Point): Point[] =>
  Array.from({ length: count + 1 }, (_, i) => at(i / count));

const star = (tips: number, out: number, inner: number, cx: number, cy: number): Point[] =>
  points(2 * tips, (share) => {
    const radius = Math.round(share * 2 * tips) % 2 === 0 ? out : inner;
    return [cx + radius * Math.cos(2 * Math.PI * share), cy + radius * Math.sin(2 * Math.PI * share)];
  });

const square = (x: number, side: number): Point[] => [
  [x, 10],
  [x + side, 10],
  [x + side, 10 + side],
  [x, 10 + side],
  [x, 10],
];

/** Drawings of polygons and curves, by name. */
export const FIGURES = {
  stars: strokeSetOf(
    [5, 9, 20].flatMap((tips, i) => [star(tips, 20, 8, 30 + 45 * i, 30), star(tips, 8, 3, 30 + 45 * i, 70)]),
  ),
  squares: strokeSetOf([2, 5, 10, 20, 40].map((side, i) => square(10 + 45 * i, side))),
  curves: strokeSetOf([
    points(1500, (s) => [100 + 40 * Math.sin(6 * Math.PI * s), 100 + 40 * Math.sin(8 * Math.PI * s + 1)]),
    points(1500, (s) => [30 + 150 * s, 30 + 8 * Math.sin(30 * Math.PI * s)]),
    ...[1, 3, 8, 20].map((r, i) =>
      points(20 + 20 * r, (s) => [
        40 + 50 * i + r * Math.cos(2 * Math.PI * s),
        180 + r * Math.sin(2 * Math.PI * s),
      ]),
    ),
  ]),
  zigzags: strokeSetOf([
    points(60, (s) => [20 + 240 * s, 30 + (Math.round(60 * s) % 2) * 6]),
    points(200, (s) => [20 + 200 * s, 60 + (Math.round(200 * s) % 2) * 2]),
  ]),
};
