/** The model of Grbl's planner compared with figures computed from its source, and the virtual Grbl with the model. */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob, type MotionSettings } from "../../../../../src/index.js";
import {
  feedFor,
  junctionSpeed2,
  moveOf,
  moveTimeS,
  plannedSpeeds2,
  type Axes,
  type Move,
} from "../../../../../src/drivers/grbl/model/planner.js";
import { VirtualGrbl } from "../../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { GRBL } from "../../../../support/machines/machine.js";
import { strokesOf } from "../../../../support/plots/local-planner.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";

const limitsOf = (accel: number) => ({
  speed: [1e4, 1e4, 1e4] as const,
  accel: [accel, accel, accel] as const,
  junctionMm: 0.01,
});
const H = Math.SQRT1_2;

describe("a corner", () => {
  it.each<[string, Axes, Axes, number, number]>([
    ["90°", [1, 0, 0], [0, 1, 0], 1_000, 5.8431],
    ["90° between diagonals", [H, H, 0], [H, -H, 0], 1_000, 4.9135],
    ["45°", [1, 0, 0], [H, H, 0], 1_000, 11.4617],
    ["135°", [1, 0, 0], [-H, H, 0], 1_000, 2.5903],
    ["90°, slow", [1, 0, 0], [0, 1, 0], 10, 0.5843],
    ["90°, fast", [1, 0, 0], [0, 1, 0], 3_000, 10.1206],
  ])("a corner of %s is taken at the speed of its junction deviation", (_, before, after, accel, speed) => {
    expect(Math.sqrt(junctionSpeed2(before, after, limitsOf(accel)))).toBeCloseTo(speed, 4);
  });

  it("is a stop if the path reverses, and has no limit if it is straight", () => {
    expect(junctionSpeed2([1, 0, 0], [-1, 0, 0], limitsOf(1_000))).toBe(0);
    expect(junctionSpeed2([1, 0, 0], [1, 0, 0], limitsOf(1_000))).toBe(Infinity);
  });
});

describe("the planner", () => {
  it("accelerates along a diagonal as fast as both axes together allow", () => {
    const axes = { speed: [250, 200, 250], accel: [3_000, 3_000, 3_000], junctionMm: 0.01 } as const;
    const move = moveOf([0, 0, 0], [30, 40, 0], Infinity, axes, null);
    expect(move).toMatchObject({ lengthMm: 50, speed: 250, accel: 3_750 });
    expect(moveTimeS(50, move.speed, move.accel)).toBeCloseTo(0.266667, 6);
  });

  it("limits the speed on short moves by the length of its queue", () => {
    const moves: Move[] = [];
    for (let i = 0; i < 400; i++) {
      moves.push(moveOf([i / 10, 0, 0], [(i + 1) / 10, 0, 0], 100, limitsOf(1_000), moves[i - 1] ?? null));
    }
    expect(Math.sqrt(plannedSpeeds2(moves, 15)[200])).toBeCloseTo(52.915, 3);
  });
});

const motionAt = (speedMmPerS: number): MotionSettings => ({
  ...DEFAULT_MOTION,
  draw: { ...DEFAULT_MOTION.draw, speedMmPerS },
});
const CASES: [string, number[], number, number][] = [
  ["a line that reaches its feed", [0, 0, 100, 0], 100, 1.1],
  ["a line that does not", [0, 0, 4, 0], 100, 0.126491],
  ["a square with its three corners", [0, 0, 10, 0, 10, 10, 0, 10, 0, 0], 150, 0.765965],
];

describe("the time of", () => {
  it.each(CASES)("the time of %s in the preview is that of Grbl", (_, line, speed, seconds) => {
    const settings = { motion: motionAt(speed), pen: DEFAULT_PEN };
    const { trajectory } = planJob({ strokes: strokesOf(line) }, settings, GRBL);
    const run = trajectory.runs.stroke.indexOf(0);
    const [first, end] = [trajectory.runs.firstBlock[run], trajectory.runs.firstBlock[run + 1]];
    const sum = trajectory.durationS.slice(first, end).reduce((a, b) => a + b, 0);
    expect(sum).toBeCloseTo(seconds, 6);
  });

  it.each(CASES)("the time of %s on the virtual board is that of Grbl", async (_, line, speed, seconds) => {
    const world = new ManualClock();
    const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
    const port = board.transport();
    let answers = "";
    port.onData((bytes) => (answers += String.fromCharCode(...bytes)));
    const points = Array.from({ length: line.length / 2 - 1 }, (_, i) => [line[2 * i + 2], line[2 * i + 3]]);
    const text = points.map(([x, y]) => `G1X${x}Y${y}F${60 * speed}\n`).join("");
    await port.write(new TextEncoder().encode(`${text}G4P0\n`));
    await world.advance(seconds - 1e-4);
    expect(board.state().state).toBe("Run");
    expect(answers.match(/ok/g)).toHaveLength(points.length);
    await world.advance(2e-4);
    expect(board.state().state).toBe("Idle");
    expect(answers.match(/ok/g)).toHaveLength(points.length + 1);
    board.close();
  });
});

describe("a Grbl that is built for CoreXY", () => {
  const motors = { speed: [100, 80, 10], accel: [500, 400, 20], junctionMm: 0.01, isCore: true } as const;

  it("moves X and Y at F/√2, and Z at F", () => {
    expect(moveOf([0, 0, 0], [50, 0, 0], 40, motors, null).speed).toBeCloseTo(40 / Math.SQRT2, 9);
    expect(moveOf([0, 0, 0], [0, 0, 5], 8, motors, null).speed).toBe(8);
    expect(feedFor(40 / Math.SQRT2, motors)).toBeCloseTo(40, 9);
  });

  it("is limited by its motors: both turn for a move along an axis, and one for a diagonal, √2 times as far", () => {
    const along = moveOf([0, 0, 0], [50, 0, 0], Infinity, motors, null);
    expect([along.speed, along.accel]).toEqual([80, 400]);
    const first = moveOf([0, 0, 0], [30, 30, 0], Infinity, motors, null);
    expect(first.speed).toBeCloseTo(100 / Math.SQRT2, 9);
    expect(first.accel).toBeCloseTo(500 / Math.SQRT2, 9);
    const second = moveOf([0, 0, 0], [30, -30, 0], Infinity, motors, null);
    expect(second.speed).toBeCloseTo(80 / Math.SQRT2, 9);
  });

  it("passes a corner within the junction deviation of its motors' way", () => {
    // The way of the motors is the carriage's, turned by 45° and √2 times as long.
    const [before, after] = [
      [1, 0, 0],
      [0, 1, 0],
    ] as const;
    const turned = [
      [Math.SQRT1_2, Math.SQRT1_2, 0],
      [Math.SQRT1_2, -Math.SQRT1_2, 0],
    ] as const;
    const ofMotors2 = junctionSpeed2(turned[0], turned[1], { ...motors, isCore: false });
    expect(junctionSpeed2(before, after, motors)).toBeCloseTo(ofMotors2 / 2, 9);
  });
});
