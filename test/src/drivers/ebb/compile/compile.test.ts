import { describe, expect, it } from "vitest";
import {
  commandLine,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  type PenSettings,
  machineById,
  plan,
  planJob,
  setUpCommands,
  type CommandStream,
  type MachineProfile,
} from "../../../../../src/index.js";
import { closingCommands } from "../../../../../src/internal.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";

/** The carriage waits for the pen. */
const WAITING: PenSettings = { ...DEFAULT_PEN, overlap: "off" };
const machine = machineById("axidraw-v3");
const linesOf = (stream: CommandStream): string[] =>
  Array.from({ length: stream.count }, (_, i) => commandLine(stream, i));
const compiled = (strokes: readonly (readonly Point[])[], firmware: string, pen = WAITING) =>
  compile(plan(strokeSetOf(strokes), DEFAULT_MOTION, pen), { machine, firmware, pen });

const DEFAULT_JOB = { motion: DEFAULT_MOTION, pen: WAITING };
const LINE: readonly Point[] = [
  [10, 10],
  [60, 35],
];

describe("compile", () => {
  it.each([
    ["2.4.4", "SM"],
    ["2.5.3", "LM"],
    ["2.7.0", "LT"],
    ["2.8.1", "LT"],
    ["3.0.3", "LT"],
  ])("moves with the best command of firmware %s: %s", (firmware, name) => {
    const names = new Set(linesOf(compiled([LINE], firmware)).map((line) => line.slice(0, 2)));
    expect([...names].sort()).toEqual([name, "SC", "SP"].sort());
  });

  it("uses T3 for constant jerk where the firmware has it", () => {
    const trajectory = plan(strokeSetOf([LINE]), { ...DEFAULT_MOTION, mode: "scurve" }, WAITING);
    const lines = linesOf(compile(trajectory, { machine, firmware: "3.0.3", pen: WAITING }));
    expect(lines.some((line) => line.startsWith("T3,"))).toBe(true);
  });

  it.each([
    ["stepsPerMm", { ...machine, stepsPerMm: undefined }],
    ["motors", { ...machine, motors: "belt" }],
    ["controller", { ...machine, controller: undefined }],
    [
      "controller.microstepMode",
      { ...machine, controller: { ...machine.controller, microstepMode: undefined } },
    ],
    ["controller.servoPin", { ...machine, controller: { ...machine.controller, servoPin: 7 } }],
    ["controller.servoPosAt0Pct", { ...machine, controller: { ...machine.controller, servoPosAt0Pct: NaN } }],
  ])("refuses a machine profile whose %s is missing or wrong, and names it", (field, profile) => {
    const incomplete = profile as unknown as MachineProfile;
    const trajectory = plan(strokeSetOf([LINE]));
    const refused = expect.objectContaining({
      code: "bad-setting",
      message: expect.stringContaining(field) as unknown,
    }) as Error;
    expect(() => compile(trajectory, { machine: incomplete, firmware: "2.8.1", pen: WAITING })).toThrow(
      refused,
    );
    expect(() => setUpCommands(incomplete, WAITING, "2.8.1")).toThrow(refused);
    expect(() => planJob({ strokes: strokeSetOf([LINE]) }, DEFAULT_JOB, incomplete)).toThrow(refused);
  });

  it("writes no commands for an empty plan", () => {
    const stream = compiled([], "2.8.1");
    expect(stream.count).toBe(0);
    expect([...stream.boardS]).toEqual([0]);
  });

  it("sets the servo's frame and the pen's heights first, and holds the queue for each of its moves", () => {
    const lines = linesOf(compiled([LINE], "2.8.1"));
    expect(lines.slice(0, 6)).toEqual([
      "SC,8,8",
      "SC,9,3",
      "SC,4,19800",
      "SC,5,13650",
      "SC,11,1845",
      "SC,12,1230",
    ]);
    expect(lines.filter((line) => line.startsWith("SP"))).toEqual(["SP,0,154", "SP,1,141"]);
  });

  it("moves a pen on the second servo output by S2", () => {
    const nextdraw = machineById("nextdraw-8511");
    const trajectory = plan(strokeSetOf([LINE]), DEFAULT_MOTION, WAITING, { machine: nextdraw });
    const lines = linesOf(compile(trajectory, { machine: nextdraw, firmware: "2.8.1", pen: WAITING }));
    expect(lines.filter((line) => /^S[CP2]/.test(line))).toEqual([
      "SC,8,1",
      "SC,9,3",
      "S2,7560,5,155,62",
      "S2,9720,5,232,60",
    ]);
  });

  it.each(["2.4.4", "2.5.3", "2.8.1", "3.0.3"])(
    "moves the pen when the plan says, and lets the carriage wait for the rest, on firmware %s",
    (firmware) => {
      const strokes = strokeSetOf([LINE, [...LINE].map(([x, y]): Point => [x + 52, y + 25])]);
      const trajectory = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN, { machine });
      const { penMoves } = trajectory;
      const stream = compile(trajectory, { machine, firmware, pen: DEFAULT_PEN });
      const lines = linesOf(stream);
      const isAtRest = (k: number): boolean => stream.run[k] === -1;
      const moves = lines.flatMap((line, k) => (line.startsWith("SP") ? [k] : []));
      const waits = lines.flatMap((line, k) => (/^SM,\d+,0,0$/.test(line) && isAtRest(k) ? [k] : []));
      expect(moves).toHaveLength(penMoves.count);
      let inFlightCount = 0;
      for (const [i, k] of moves.entries()) {
        const [, up, waitMs] = lines[k].split(",").map(Number);
        expect(up).toBe(penMoves.up[i]);
        expect(Math.abs(stream.boardS[k] - penMoves.startS[i])).toBeLessThan(0.011);
        const plannedMs = Math.round(penMoves.waitS[i] * 1_000);
        if (isAtRest(k)) expect(waitMs).toBe(plannedMs);
        else {
          expect(waitMs).toBe(0);
          expect(stream.run[k]).toBe(penMoves.beforeRun[i] - 1);
          expect(lines[waits[inFlightCount]]).toBe(`SM,${plannedMs},0,0`);
          expect(stream.run[waits[inFlightCount] - 1]).toBe(penMoves.beforeRun[i] - 1);
          inFlightCount++;
        }
      }
      expect(inFlightCount).toBe(1);
      expect(waits).toHaveLength(1);
      const endsLateS = stream.boardS[stream.count] - trajectory.totalS;
      expect(Math.abs(endsLateS)).toBeLessThan(0.02);
    },
  );

  it("waits no longer for a pen than a board can, and not at all for a pen that has arrived", () => {
    const afterMove = LINE.map(([x, y]): Point => [x + 52, y + 25]);
    const withWaits = (pen: PenSettings, waitS: number): string[] => {
      const trajectory = plan(strokeSetOf([LINE, afterMove]), DEFAULT_MOTION, pen, { machine });
      const penMoves = { ...trajectory.penMoves, waitS: trajectory.penMoves.waitS.map(() => waitS) };
      const lines = linesOf(compile({ ...trajectory, penMoves }, { machine, firmware: "2.8.1", pen }));
      return lines.filter((line) => line.startsWith("SP") || line.startsWith("SM"));
    };
    expect(withWaits(WAITING, 100)).toEqual(["SP,0,65535", "SP,1,65535", "SP,0,65535", "SP,1,65535"]);
    // The third one moves in flight.
    expect(withWaits(DEFAULT_PEN, 0)).toEqual(["SP,0,0", "SP,1,0", "SP,0,0", "SP,1,0"]);
  });

  it("keeps its columns consistent: text, times, positions", () => {
    const stream = compiled([LINE, [[100, 100]]], "3.0.3");
    expect(stream.textOffsets[stream.count]).toBe(stream.text.length);
    for (let i = 0; i < stream.count; i++) {
      expect(stream.boardS[i + 1]).toBeGreaterThanOrEqual(stream.boardS[i]);
      expect(stream.planS[i + 1]).toBeGreaterThanOrEqual(stream.planS[i] - 1e-9);
      expect(commandLine(stream, i)).toMatch(/^[A-Z][A-Z0-9](,-?\d+)+$/);
      if (/^S[CP]/.test(commandLine(stream, i))) expect(stream.run[i]).toBe(-1);
      else expect(stream.run[i]).toBeGreaterThanOrEqual(0);
    }
    expect(() => commandLine(stream, stream.count)).toThrow(RangeError);
  });

  it("continues from any state of the board", () => {
    const trajectory = plan(strokeSetOf([LINE]), DEFAULT_MOTION, WAITING, { startX: 5, startY: 5 });
    const start = { steps1: 801, steps2: -1, acc1: 12_345, acc2: 2 ** 31 - 1 };
    for (const firmware of ["2.4.4", "2.5.3", "2.8.1", "3.0.3"]) {
      const stream = compile(trajectory, { machine, firmware, pen: WAITING, start });
      const last = stream.count - 1;
      expect([stream.steps1[last], stream.steps2[last]]).toEqual([0, 0]);
    }
  });

  it("never writes a command shorter than a board can sustain, or longer than a hold may wait", () => {
    const curve = Array.from({ length: 500 }, (_, i): Point => [
      100 + 30 * Math.cos(i / 80),
      100 + 30 * Math.sin(i / 80),
    ]);
    for (const firmware of ["2.5.3", "2.8.1", "3.0.3"]) {
      const stream = compiled([curve], firmware);
      let movingS = 0;
      let count = 0;
      for (let i = 0; i < stream.count; i++) {
        if (stream.run[i] < 0) continue;
        const s = stream.boardS[i + 1] - stream.boardS[i];
        expect(s).toBeLessThan(0.2);
        movingS += s;
        count++;
      }
      expect(movingS / count).toBeGreaterThan(0.005);
    }
  });

  it("refuses an invalid firmware and a plan that is not finite", () => {
    const trajectory = plan(strokeSetOf([LINE]), DEFAULT_MOTION, WAITING);
    expect(() => compile(trajectory, { machine, firmware: "new", pen: WAITING })).toThrow(/firmware/);
    expect(() =>
      compile({ ...trajectory, totalS: NaN }, { machine, firmware: "2.8.1", pen: WAITING }),
    ).toThrow(RangeError);
  });
});

describe("the commands around a plot", () => {
  it("switch the motors on, reset the counters and set the pen up before the plot, and switch off after it", () => {
    expect(setUpCommands(machine, WAITING, "2.8.1")[0]).toBe("EM,1,1");
    expect(setUpCommands(machine, WAITING, "2.8.1")).not.toContain("CS");
    expect(setUpCommands(machine, WAITING, "2.5.3")[1]).toBe("CS");
    expect(closingCommands()).toEqual(["EM,0,0"]);
  });
});
