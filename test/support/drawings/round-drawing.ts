/** A drawing of round lines, all some mm apart: more than 9 s of plotting. */
import type { StrokeSet } from "../../../src/index.js";
import { strokesOf } from "../plots/local-planner.js";

type Point = readonly [x: number, y: number];

/** Points of an arc of `turns` (1: a circle), the first at `from` turns. */
export const circle = (
  x: number,
  y: number,
  r: number,
  from: number,
  turns: number,
  count: number,
): Point[] =>
  Array.from({ length: count + 1 }, (_, i) => {
    const angle = 2 * Math.PI * (from + (turns * i) / count);
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

/** A rectangle with round corners, from its left side on. */
export const roundedRectangle = (x: number, y: number, width: number, height: number, r: number): Point[] => [
  [x, y + r],
  ...circle(x + r, y + r, r, 0.5, 0.25, 12),
  ...circle(x + width - r, y + r, r, 0.75, 0.25, 12),
  ...circle(x + width - r, y + height - r, r, 0, 0.25, 12),
  ...circle(x + r, y + height - r, r, 0.25, 0.25, 12),
  [x, y + r],
];

const spiral = (x: number, y: number, pitchMm: number, turns: number): Point[] =>
  Array.from({ length: 72 * turns + 1 }, (_, i) => {
    const [r, angle] = [2 + (pitchMm * i) / 72, (2 * Math.PI * i) / 72];
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

export const ROUND_DRAWING: StrokeSet = strokesOf(
  // A little less than a circle, whose ends would be at the same place.
  circle(25, 28, 14, 0, 0.97, 100).flat(),
  circle(25, 28, 5, 0.5, -0.9, 60).flat(),
  roundedRectangle(50, 12, 40, 32, 6).slice(0, -1).flat(),
  spiral(70, 28, 3.5, 3).flat(),
  [...circle(30, 60, 8, 0.5, 0.5, 40), ...circle(46, 60, 8, 0.5, -0.5, 40)].flat(),
);
