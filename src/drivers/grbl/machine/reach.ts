/** How far lines lead on each axis, and how strong the signal of a servo becomes. */
import { extremesOf } from "../model/arc-cut.js";
import type { Axes } from "../model/planner.js";

/** The lowest and the highest value. */
export type Range = readonly [min: number, max: number];

/** Of the values of a word, such as "M3S"; null if no line has it. */
export function rangeOf(lines: readonly string[], word: string): Range | null {
  const values = lines.flatMap((line) => valueOf(line, word) ?? []);
  return values.length === 0 ? null : spanOf(values);
}

/** Of the positions on each axis, mm; null for an axis on which nothing moves. `start`: where the lines begin. */
export function reachOf(lines: readonly string[], start: Axes): readonly (Range | null)[] {
  const reached: number[][] = [[], [], []];
  let at = start;
  for (const line of lines) {
    const words = [valueOf(line, "X"), valueOf(line, "Y"), valueOf(line, "Z")];
    const to: Axes = [words[0] ?? at[0], words[1] ?? at[1], words[2] ?? at[2]];
    if (/^G[23]/.test(line)) {
      const arc = {
        i: valueOf(line, "I") ?? 0,
        j: valueOf(line, "J") ?? 0,
        clockwise: line.startsWith("G2"),
      };
      for (const side of extremesOf(arc, at, to)) {
        reached[0].push(side[0]);
        reached[1].push(side[1]);
      }
    }
    words.forEach((mm, axis) => mm !== null && reached[axis].push(mm));
    at = to;
  }
  return reached.map((values) => (values.length === 0 ? null : spanOf(values)));
}

function valueOf(line: string, word: string): number | null {
  const value = new RegExp(`${word}(-?[\\d.]+)`).exec(line)?.[1];
  return value === undefined ? null : Number(value);
}

function spanOf(values: readonly number[]): Range {
  let [min, max] = [Infinity, -Infinity];
  for (const value of values) [min, max] = [Math.min(min, value), Math.max(max, value)];
  return [min, max];
}
