import { describe, expect, it } from "vitest";
import {
  commandLine,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  type PenSettings,
  machineById,
  plan,
  type CommandStream,
} from "../../../../../src/index.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";

/** The carriage waits for the pen. */
const WAITING: PenSettings = { ...DEFAULT_PEN, overlap: "off" };
const machine = machineById("axidraw-v3");
const firmware = "2.4.4";
const pen = WAITING;

const circle = (x: number, y: number, r: number, n: number): Point[] =>
  Array.from({ length: n + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / n;
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

const compiled = (strokes: readonly (readonly Point[])[]) => {
  const trajectory = plan(strokeSetOf(strokes), DEFAULT_MOTION, pen);
  return { trajectory, stream: compile(trajectory, { machine, firmware, pen }) };
};

/** ms and steps of each slice. */
const slicesOf = (stream: CommandStream): readonly (readonly number[])[] =>
  Array.from({ length: stream.count }, (_, i) => commandLine(stream, i).split(","))
    .filter(([name]) => name === "SM")
    .map(([, ...numbers]) => numbers.map(Number));

describe("slices of constant speed", () => {
  it("come with the advice to update the firmware", () => {
    const { stream } = compiled([circle(50, 50, 10, 100)]);
    expect(stream.warnings).toEqual([expect.stringMatching(/older than 2\.5\.3.*Update the firmware/)]);
    const { trajectory } = compiled([circle(50, 50, 10, 100)]);
    expect(compile(trajectory, { machine, firmware: "2.5.3", pen }).warnings).toEqual([]);
  });

  it("are about 10 ms long, except in a run shorter than that", () => {
    const { stream } = compiled([circle(50, 50, 10, 100), circle(90, 50, 0.02, 9)]);
    const lengths = slicesOf(stream).map(([ms]) => ms);
    expect(Math.max(...lengths)).toBeLessThanOrEqual(15);
    expect(lengths.filter((ms) => ms < 8).length / lengths.length).toBeLessThan(0.01);
  });

  it("keep the plan's time, including rests and moves of less than a step", () => {
    const { trajectory, stream } = compiled([
      [[50, 50]],
      [[50, 50], [50.004, 50]],
      ...Array.from({ length: 40 }, (_, i) => circle(60 + i, 60, 0.1, 9)),
    ]); // prettier-ignore
    expect(Math.abs(stream.boardS[stream.count] - trajectory.totalS)).toBeLessThan(0.01);
  });
});
