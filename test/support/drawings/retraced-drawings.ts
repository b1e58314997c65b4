/** Ten drawings whose lines pass the same places more than once: exactly, nearly, or on a crossing. */
import type { StrokeSet } from "../../../src/index.js";
import { strokesOf } from "../plots/local-planner.js";
import { RETRACED } from "./stop-truth.js";

type Point = readonly [x: number, y: number];

const line = (count: number, at: (i: number) => Point): number[] =>
  Array.from({ length: count }, (_, i) => at(i)).flat();
const circle = (times: number, radiusMm: number, driftMm = 0): number[] =>
  line(60 * times + 1, (i) => [
    30 + driftMm * i + radiusMm * Math.cos((i / 30) * Math.PI),
    30 + driftMm * i + radiusMm * Math.sin((i / 30) * Math.PI),
  ]);
const star = (times: number): number[] =>
  line(5 * times + 1, (i) => [
    30 + 12 * Math.sin((i * 4 * Math.PI) / 5),
    30 - 12 * Math.cos((i * 4 * Math.PI) / 5),
  ]);

export const RETRACED_DRAWINGS: Readonly<Record<string, StrokeSet>> = {
  "a line there and back": strokesOf([3, 5, 53, 5, 3, 5], [3, 9, 23, 9, 3, 9], [3, 13, 9, 13, 3, 13]),
  "a line drawn eight times": strokesOf(line(9, (i) => [i % 2 === 0 ? 10 : 30, 20])),
  "strokes that retrace the stroke before": strokesOf(
    [5, 5, 45, 5],
    [45, 5, 5, 5],
    [5, 5, 45, 5],
    [10, 5, 40, 5],
    [40, 5, 5, 5],
  ),
  "a circle nine times over": strokesOf(circle(9, 4)),
  "a small circle thirty times over": strokesOf(circle(30, 1)),
  "circles that hardly drift": strokesOf(circle(9, 4, 0.0003)),
  "overlapping loops": strokesOf(circle(12, 4, 0.01)),
  "a star drawn four times": strokesOf(star(4)),
  "tips, hairpins and zigzags": RETRACED,
  "curves that nearly coincide": strokesOf(
    line(121, (i) => [10 + i / 4, 20 + 4 * Math.sin(i / 9)]),
    line(121, (i) => [40 - i / 4, 20.03 + 4 * Math.sin((120 - i) / 9)]),
    line(363, (i) => {
      const k = i % 242 < 121 ? i % 121 : 120 - (i % 121);
      return [10 + k / 4, 40 + 0.01 * Math.floor(i / 121) + 4 * Math.sin(k / 9)];
    }),
  ),
};
