/** The three pen lifts of a Grbl: a Z axis, a servo on the spindle's output, and own lines. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob, type MachineProfile } from "../../../../src/index.js";
import { checkMachine } from "../../../../src/drivers/registry.js";
import { machineProfileSchema } from "../../../../src/schema/index.js";
import "../../../support/runs/fixed-seed.js";
import { GRBL, GRBL_LINES, GRBL_SERVO } from "../../../support/machines/machine.js";
import { cutOff, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";

const ONE_LINE = strokesOf([10, 10, 60, 10]);

const linesOf = (machine: MachineProfile, pen = {}): string[] =>
  planJob(
    { strokes: ONE_LINE },
    { motion: DEFAULT_MOTION, pen: { ...DEFAULT_PEN, ...pen } },
    machine,
  ).lines();
const penLines = (machine: MachineProfile, pen = {}): string[] =>
  linesOf(machine, pen).filter((line) => /^(M|G4P0\.|G1Z)/.test(line));

describe.each([
  ["a servo", GRBL_SERVO],
  ["own lines", GRBL_LINES],
  ["a Z axis", GRBL],
])("a plot with %s", (_, machine) => {
  const settings = { ...SETTINGS, customMachine: machine };
  const plotter = async () => {
    const all = await newPlotter({}, machine);
    return { ...all, start: () => all.begin(new LocalPlanner(DRAWING), {}, settings) };
  };

  it("draws everything, moves only when the pen has arrived, and takes as long as planned", async () => {
    const { world, board, start, within } = await plotter();
    const { trajectory } = planJob({ strokes: DRAWING }, settings, machine);
    const run = await start();
    const startS = world.nowS();
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
    expect(board.state()).toMatchObject({ penUp: true, earlyCount: 0, lostCount: 0, xMm: 0, yMm: 0 });
    // The pen goes up before the plan begins, from an unknown height.
    const tookS = world.nowS() - startS;
    expect(tookS - trajectory.totalS).toBeGreaterThan(0.1);
    expect(tookS - trajectory.totalS).toBeLessThan(1.1);
  });

  it("is paused with the pen up, stopped at once, and goes on at the same point", async () => {
    const { world, board, driver, start, within } = await plotter();
    const run = await start();
    for (const stop of ["pause", "emergencyStop", "pause", "emergencyStop"] as const) {
      await world.advance(2.1);
      await world.run(run[stop]());
      expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
      expect(driver.state.penUp).toBe(true);
      await world.run(run.resume());
    }
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
    expect(board.state().earlyCount).toBe(0);
  });

  it("is cut off by its cable, and the pen is lifted first when it is connected again", async () => {
    const all = await plotter();
    await cutOff(all, await all.start());
    expect(all.board.state().penUp).toBe(true);
  });

  it("lifts the pen if the Grbl restarts in mid-stroke", async () => {
    const { world, board, start, within } = await plotter();
    const run = await start();
    await world.advance(3);
    board.restart();
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has restarted/);
    expect(board.state().penUp).toBe(true);
  });
});

describe("the lines of a servo", () => {
  it("move it to the heights of the settings, and wait in steps of 50 ms for its model's time", () => {
    // 246 and 298 ms for 30 %.
    expect(penLines(GRBL_SERVO)).toEqual(["M3S300", "G4P0.3", "M3S600", "G4P0.25"]);
    expect(penLines(GRBL_SERVO, { upPct: 45, downPct: 25 })).toEqual([
      "M3S250",
      "G4P0.25",
      "M3S450",
      "G4P0.2",
    ]);
  });

  it("wait longer as the settings say, and less with a negative extra wait", () => {
    expect(penLines(GRBL_SERVO, { extraLiftMs: 200, extraDropMs: -150 })).toEqual([
      "M3S300",
      "G4P0.15",
      "M3S600",
      "G4P0.45",
    ]);
  });

  it("have the servo that the profile describes, and its own wait", () => {
    const fast = { minMs: 20, slopeMsPerPct: 1, liftPctPerS: 1_000, dropPctPerS: 1_000, frameMs: 3 };
    expect(penLines({ ...GRBL_SERVO, penServo: fast })).toEqual(["M3S300", "G4P0.1", "M3S600", "G4P0.1"]);
    const slow = { ...GRBL_SERVO, controller: { ...GRBL_SERVO.controller, penWaitMs: 400 } };
    expect(penLines({ ...slow, penServo: fast })).toEqual(["M3S300", "G4P0.5", "M3S600", "G4P0.5"]);
  });

  it("have the heights of each layer", () => {
    const two = strokesOf([10, 10, 60, 10], [10, 20, 60, 20]);
    const layers = two.layers.length;
    expect(layers).toBe(1);
    const pen = { ...DEFAULT_PEN, layers: { [two.layers[0].id]: { downPct: 10, upPct: 50 } } };
    const lines = planJob({ strokes: two }, { motion: DEFAULT_MOTION, pen }, GRBL_SERVO).lines();
    expect(lines.filter((line) => line.startsWith("M"))).toEqual(["M3S100", "M3S500", "M3S100", "M3S500"]);
  });
});

it("the height of a Z axis follows the settings, within its limits, and costs the time of its way", () => {
  expect(penLines(GRBL, { upPct: 90, downPct: 24 })).toEqual([
    "G1Z-1F3000",
    "G4P0.1",
    "G1Z10F3000",
    "G4P0.1",
  ]);
  const bounded = { ...GRBL, controller: { ...GRBL.controller, penMinZMm: -0.5, penMaxZMm: 8 } };
  expect(penLines(bounded, { upPct: 90, downPct: 24 })).toEqual([
    "G1Z-0.5F3000",
    "G4P0.1",
    "G1Z8F3000",
    "G4P0.1",
  ]);
  const durationS = (upPct: number): number =>
    planJob({ strokes: ONE_LINE }, { motion: DEFAULT_MOTION, pen: { ...DEFAULT_PEN, upPct } }, GRBL)
      .trajectory.totalS;
  // From 5 to 10 mm, at 50 mm/s, down and up.
  expect(durationS(90) - durationS(60)).toBeCloseTo(0.2, 6);
});

it("own lines are sent as they are", () => {
  const own = { ...GRBL_LINES.controller, penUpLines: "M5\nG4 P0.1", penDownLines: "M3 S1000" };
  expect(linesOf({ ...GRBL_LINES, controller: own }).filter((line) => /^(M|G4 |G4P0\.)/.test(line))).toEqual([
    "M3 S1000",
    "G4P0.2",
    "M5",
    "G4 P0.1",
    "G4P0.2",
  ]);
});

it("waits in own lines count in the planned time", async () => {
  const own = { penUpLines: "M3 S90\nG04 P0.32\nM3 S80", penDownLines: "M4 S40\nG4P.2\nM4 S20" };
  const machine = { ...GRBL_LINES, controller: { ...GRBL_LINES.controller, ...own } };
  const settings = { ...SETTINGS, customMachine: machine };
  const { trajectory } = planJob({ strokes: DRAWING }, settings, machine);
  const { world, begin, within } = await newPlotter({}, machine);
  const run = await begin(new LocalPlanner(DRAWING), {}, settings);
  const startS = world.nowS();
  expect(await within(run.finished)).toEqual({ kind: "done" });
  // The pen goes up before the plan begins.
  const liftS = 0.35 + 0.2;
  expect(Math.abs(world.nowS() - startS - liftS - trajectory.totalS)).toBeLessThan(0.01 * trajectory.totalS);
});

describe("a servo on a Grbl that is set otherwise", () => {
  it.each([
    [{ 32: 1 }, /^bad-setting: The Grbl is in laser mode \(\$32=1\).*\$32=0/],
    [{ 30: 255 }, /^bad-setting: The pen's servo needs S\d+, but the Grbl's highest S is 255 \(\$30\)/],
  ])("refuses to plot, in words, and nothing moves: %j", async (own, words) => {
    const { board, begin, driver, within } = await newPlotter({ settings: own }, GRBL_SERVO);
    const settings = { ...SETTINGS, customMachine: GRBL_SERVO };
    const run = await begin(new LocalPlanner(DRAWING), {}, settings);
    expect(await within(run.finished)).toMatch(words);
    expect(await within(driver.pen({ up: false }))).toMatch(words);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0 });
  });
});

describe("the pen by hand", () => {
  it("goes to any height, and waits for the servo's way", async () => {
    const { world, board, driver, within } = await newPlotter({}, GRBL_SERVO);
    const settings = { ...SETTINGS, customMachine: GRBL_SERVO };
    expect(await within(driver.pen({ up: false, heightPct: 37 }, settings))).toBeUndefined();
    expect(board.state()).toMatchObject({ penUp: false });
    expect(driver.log()).toContain("> M3S370");
    const startS = world.nowS();
    expect(await within(driver.pen({ up: false, heightPct: 36 }, settings))).toBeUndefined();
    expect(world.nowS() - startS).toBeLessThan(0.15);
    expect(await within(driver.move({ kind: "move-to", xMm: 20, yMm: 10 }, settings))).toBeUndefined();
    expect(board.state()).toMatchObject({ penUp: true, xMm: 20, yMm: 10, earlyCount: 0 });
  });
});

describe("a profile's pen lift", () => {
  const { penUpZMm, penDownZMm, penSpeedMmPerS, penAccelMmPerS2, penWaitMs, ...bare } = GRBL.controller;
  const z = { penUpZMm, penDownZMm, penSpeedMmPerS, penAccelMmPerS2, penWaitMs };

  it.each([
    [{ ...z }, null],
    [{ penUpS: 600, penDownS: 300 }, null],
    [{ penUpLines: "M5", penDownLines: "M3S1\nG4P0.1", penWaitMs: 100 }, null],
    [{}, "penUpZMm"],
    [{ ...z, penUpS: 600, penDownS: 300 }, "penUpS"],
    [{ penUpS: 600 }, "penDownS"],
    [{ penUpS: 600, penDownS: 600 }, "penDownS"],
    [{ penUpZMm, penDownZMm }, "penSpeedMmPerS"],
    [{ penUpLines: "M5", penDownLines: "M3 S100 !" }, "penDownLines"],
    [{ penUpLines: "M5\nM0", penDownLines: "M3" }, "penUpLines"],
    [{ penUpLines: "M5", penDownLines: "$H" }, "penDownLines"],
    [{ penUpLines: "M5", penDownLines: "M3 S100\n" }, "penDownLines"],
    [{ penUpLines: "M5", penDownLines: "M3 Ä" }, "penDownLines"],
    [{ penUpS: -1, penDownS: 5 }, "penUpS"],
  ])("is checked: %j; wrong is %s", (pen, field) => {
    const controller = { ...bare, ...pen };
    const checked = machineProfileSchema.safeParse({ ...GRBL, controller });
    expect(checked.error?.issues.map(({ path }) => path.join(".")) ?? null).toEqual(
      field === null ? null : [`controller.${field}`],
    );
    if (field === null) expect(() => checkMachine({ ...GRBL, controller })).not.toThrow();
    else expect(() => linesOf({ ...GRBL, controller })).toThrow(field);
  });

  it("never leaves its heights' order: a higher percent is nearer to the upper value", () => {
    const percent = fc.double({ min: 0, max: 100, noNaN: true });
    fc.assert(
      fc.property(percent, percent, fc.boolean(), (a, b, isTurned) => {
        fc.pre(a > b + 1);
        const pen = isTurned ? { penUpS: 200, penDownS: 500 } : { penUpS: 600, penDownS: 300 };
        const machine = { ...GRBL, controller: { ...bare, ...pen } };
        const [down, up] = penLines(machine, { upPct: a, downPct: b })
          .filter((line) => line.startsWith("M3S"))
          .map((line) => Number(line.slice(3)));
        expect(isTurned ? down > up : up > down).toBe(true);
        expect(Math.min(up, down)).toBeGreaterThanOrEqual(0);
      }),
    );
  });
});
