import { describe, expect, it } from "vitest";
import { drawLine } from "../../../host/plotter/live-lines.js";

function said(line: string): unknown[] {
  const calls: unknown[] = [];
  drawLine(line, {
    stroke: (points) => calls.push(points),
    lineTo: (x, y) => calls.push([x, y]),
    penUp: () => calls.push("up"),
  });
  return calls;
}

describe("a line of a live drawing", () => {
  it.each([
    ["120.5 80", [120.5, 80]],
    ["  1e1,\t-2  ", [10, -2]],
    ["[3, 4]", [3, 4]],
    [
      "[[0,0],[9,9]]",
      [
        [0, 0],
        [9, 9],
      ],
    ],
    ["[[5,5]]", [[5, 5]]],
    ["up", "up"],
    ["", "up"],
    ["  \r", "up"],
  ])("%j is understood", (line, call) => {
    expect(said(line)).toEqual([call]);
  });

  it.each([
    "down",
    "1",
    "1 2 3",
    "1 x",
    "1e999 2",
    "NaN 1",
    "[1]",
    "[]",
    "[[]]",
    "[[1,2],3]",
    '[["1","2"]]',
    "[1,2",
    "{}",
    '{"x":1}',
    "null",
  ])("%j is refused, with what is allowed", (line) => {
    expect(() => said(line)).toThrow(/is no point such as 120.5 80, no stroke such as .* and not up/);
  });
});
