/** A plotter whose machine has a Grbl, virtual, on a manual clock. */
import { describe, expect, it } from "vitest";
import { NodePlotter } from "../../../support/plots/node-plotter.js";
import { planJob, type StrokeSet } from "../../../../src/index.js";
import { driver as grblDriver } from "../../../../src/drivers/grbl/driver.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { GRBL, NO_EVENTS } from "../../../support/machines/machine.js";
import { DRAWING, drawnMm, expectDrawn } from "../../../support/plots/live-plot.js";
import { logOfPlot } from "../../../support/plots/grbl-plotter.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { ScriptedLine } from "../../../support/machines/scripted-line.js";
import { outcome, virtualBoardOf } from "../../../support/plots/virtual-plotter.js";

const SETTINGS: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };
const TWO_LINES = strokesOf([10, 10, 60, 10, 60, 40], [20, 50, 80, 50]);
async function newPlotter() {
  const world = new ManualClock();
  const driver = new NodePlotter({ device: "virtual", clock: world, settings: SETTINGS });
  await world.run(driver.start());
  const board = driver.virtualMachine;
  if (!(board instanceof VirtualGrbl)) throw new TypeError("it is not a virtual Grbl");
  const begin = async (strokes: StrokeSet = TWO_LINES, start = {}) =>
    world.run(driver.plot(new LocalPlanner(strokes), SETTINGS, start));
  return { world, driver, board, begin };
}

const drawn = (board: VirtualGrbl): number[][] =>
  board
    .drawn()
    .filter(({ penDown, xy }) => penDown && xy.length > 2)
    .map(({ xy }) => [xy[0], xy[1], xy[xy.length - 2], xy[xy.length - 1]]);

const lengthMm = ({ xy, offsets }: StrokeSet): number => {
  let sum = 0;
  for (let s = 0; s + 1 < offsets.length; s++) {
    for (let i = offsets[s] + 1; i < offsets[s + 1]; i++) {
      sum += Math.hypot(xy[2 * i] - xy[2 * i - 2], xy[2 * i + 1] - xy[2 * i - 1]);
    }
  }
  return sum;
};

describe("a plotter with a Grbl", () => {
  it("identifies itself, plots to the end, and is idle at home again", async () => {
    const { world, driver, board, begin } = await newPlotter();
    expect(driver.state).toMatchObject({ kind: "virtual", connection: "idle", firmware: "Grbl 1.1h" });
    const run = await begin();
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(drawn(board)).toEqual([
      [10, 10, 60, 40],
      [20, 50, 80, 50],
    ]);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0, penUp: true, lostCount: 0 });
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true, xMm: 0, yMm: 0 });
  });

  it("takes as long as the preview says, and reports its progress", async () => {
    const { world, begin } = await newPlotter();
    const { trajectory } = planJob({ strokes: DRAWING }, SETTINGS, GRBL);
    const run = await begin(DRAWING);
    const startS = world.nowS();
    const seen: { atS: number; planS: number; progress: number }[] = [];
    run.onProgress(({ planS, progress }) => seen.push({ atS: world.nowS() - startS, planS, progress }));
    await world.run(run.finished);
    // The pen goes up before the plan begins.
    const liftS = 0.25;
    expect(world.nowS() - startS - liftS).toBeGreaterThan(trajectory.totalS - 0.02);
    expect(world.nowS() - startS - liftS).toBeLessThan(trajectory.totalS + 0.02);
    expect(seen.every((one, i) => i === 0 || one.progress >= seen[i - 1].progress)).toBe(true);
    expect(seen[seen.length - 1].progress).toBe(1);
    expect(seen.filter(({ atS, planS }) => Math.abs(atS - liftS - planS) > 0.3)).toEqual([]);
  });

  it("comes to rest along the path, lifts the pen, and resumes where it stopped", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const run = await begin(DRAWING);
    for (let i = 0; i < 8; i++) {
      await world.advance(0.43 + 0.11 * i);
      await world.run(run.pause());
      expect(driver.state.activity).toBe("held");
      expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
      expect(driver.state.penUp).toBe(true);
      await world.run(run.resume());
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
    expect(Math.abs(drawnMm(board) - lengthMm(DRAWING))).toBeLessThan(0.2);
    expect(logOfPlot(driver)).not.toMatch(/ALARM|error:/);
    expect(board.state().lostCount).toBe(0);
  });

  it("stops at once, and resumes from there", async () => {
    const { world, board, driver, begin } = await newPlotter();
    const run = await begin(DRAWING);
    await world.advance(2.1);
    const before = world.nowS();
    await world.run(run.emergencyStop());
    expect(driver.log()).toContain("ALARM:3");
    expect(world.nowS() - before).toBeLessThan(1);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
  });

  it.each(["pause", "emergencyStop"] as const)(
    "resumes on the right side of a narrow tip: %s",
    async (stop) => {
      const tip = strokesOf([90, 45, 25, 45.02, 90, 45.04]);
      const tipMm = Math.hypot(65, 0.02);
      let stopCount = 0;
      for (let afterS = 1.7; afterS < 2.2; afterS += 0.01) {
        const { world, board, begin } = await newPlotter();
        const run = await begin(tip);
        await world.run(run.change({ speedPct: 200 }));
        await world.advance(afterS);
        await world.run(run[stop]());
        const placeMm = run.holdPlace!.alongMm;
        const restMm = board.state().xMm - 25;
        const hasPassed = board.drawn().some(({ penDown, xy }) => penDown && xy.some((mm) => mm < 25.001));
        expect([afterS, placeMm]).toEqual([
          afterS,
          expect.closeTo(tipMm + (hasPassed ? restMm : -restMm), 1),
        ]);
        if (restMm < 3) stopCount++;
      }
      expect(stopCount).toBeGreaterThan(15);
    },
  );

  it("goes on with the next stroke if less than a step of one is left, also after a second pause", async () => {
    const { world, board, begin } = await newPlotter();
    const from = { stroke: 0, alongMm: 80 - 0.001 };
    const run = await begin(TWO_LINES, { from });
    await world.run(run.resume());
    await world.advance(0.6);
    await world.run(run.pause());
    expect(run.holdPlace).toEqual({ stroke: 1, alongMm: 0 });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(drawn(board)).toEqual([[20, 50, 80, 50]]);
  });

  it("is cancelled: lifts the pen and goes home", async () => {
    const { world, board, begin } = await newPlotter();
    const run = await begin(DRAWING);
    await world.advance(2.5);
    await world.run(run.cancel());
    expect(await run.finished).toEqual({ kind: "cancelled" });
    expect(board.state()).toMatchObject({ xMm: 0, yMm: 0, penUp: true });
    expect(drawnMm(board)).toBeLessThan(lengthMm(DRAWING) / 2);
  });

  it("applies new speeds when it resumes after a pause", async () => {
    const { world, begin } = await newPlotter();
    const run = await begin(DRAWING);
    await world.advance(1.5);
    await world.run(run.pause());
    await world.run(run.change({ speedPct: 50 }));
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
  });

  it("moves by hand, sets home, switches its motors off, and answers typed lines", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.moveTo(30, 20));
    expect(board.state()).toMatchObject({ xMm: 30, yMm: 20, penUp: true });
    await world.run(driver.setHome());
    await world.run(driver.jog(5, 0));
    expect(driver.state).toMatchObject({ xMm: 5, yMm: 0 });
    await world.run(driver.cyclePen());
    await world.run(driver.drawTestPatch());
    expect(driver.state).toMatchObject({ xMm: 5, yMm: 0 });
    // Its own work offset stays the user's.
    expect(board.state()).toMatchObject({ xMm: 35, yMm: 20, penUp: true });
    expect(await world.run(driver.command("$I"))).toMatchObject({
      replies: ["[VER:1.1h.20190830:]", "[OPT:V,15,128]", "ok"],
    });
    expect(await world.run(driver.command("G38.2 Z-1"))).toMatchObject({
      replies: ["error:20"],
      refused: true,
    });
    expect(await outcome(world.run(driver.move({ kind: "servo", pos: 12_000 })))).toMatch(
      /^bad-setting: .* does not lift its pen with a servo/,
    );
    expect(await outcome(world.run(driver.command("!")))).toMatch(/^bad-setting/);
    await world.run(driver.motorsOff());
    expect(driver.state).toMatchObject({ motorsOn: false, xMm: null });
    await world.run(driver.moveTo(1, 2));
    expect(driver.state).toMatchObject({ motorsOn: true, xMm: 1, yMm: 2 });
  });

  it.each(["asleep", "held", "moving"])("is found again when it was left %s", async (how) => {
    const world = new ManualClock();
    const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
    const line = board.transport();
    const left = { asleep: "$SLP\n", held: "G1X50F600\n!", moving: "G1X50F600\n" }[how] ?? "";
    await line.write(new TextEncoder().encode(left));
    await world.advance(1);
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    const machine = await world.run(grblDriver.identify(board.transport(), options));
    await world.run(machine.readKeptState(SETTINGS, null));
    expect(machine.firmware).toBe("Grbl 1.1h");
    expect(board.state().state).toBe("Idle");
    await world.run(machine.moveTo(10, 20, SETTINGS));
    expect(board.state()).toMatchObject({ zMm: 5, penUp: true });
    expect(machine.positionMm(GRBL)?.x).toBeCloseTo(10, 3);
    await machine.close();
  });

  it.each([
    [
      "answers once and is silent then",
      1,
      /^no-board: Something answers on this port, but it is not a Grbl.*wait/,
    ],
    ["answers each line", Infinity, /^no-board: Something answers on this port, but it is not a Grbl.*wait/],
    ["never answers", 0, /^board-timeout: /],
  ])("reports another device that %s", async (_, answers, message) => {
    const world = new ManualClock();
    let left = answers;
    const line = new ScriptedLine(() => (left-- > 0 ? "echo:wait\n" : null), "\n");
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    expect(await outcome(world.run(grblDriver.identify(line, options)))).toMatch(message);
    expect(line.closed).toBe(true);
  });

  it("is replaced by an EiBotBoard for a job of such a machine, and used again afterwards", async () => {
    const { world, driver } = await newPlotter();
    const run = await world.run(driver.plot(new LocalPlanner(TWO_LINES), DEFAULT_PLOT_SETTINGS));
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(driver.state.firmware).toBe("2.8.1");
    expect(virtualBoardOf(driver).state()).toMatchObject({ steps1: 0, penUp: true });
    await world.run(driver.moveTo(10, 10, SETTINGS));
    expect(driver.state).toMatchObject({ firmware: "Grbl 1.1h", xMm: 10, yMm: 10 });
  });
});
