/** A plotter with a Grbl that fails, or is stopped, at an awkward moment: nothing waits forever, and it works again. */
import { describe, expect, it } from "vitest";
import type { JournalEntry, RunningPlot } from "../../../../host/plotter/plotter-port.js";
import type { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { StrokePosition } from "../../../../src/index.js";
import { pointAt } from "../../../../src/internal.js";
import {
  LIMIT_S,
  newMachine,
  newPlotter,
  SETTINGS,
  settingsWith,
  RefusedPlanner,
} from "../../../support/plots/grbl-plotter.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { circle } from "../../../support/drawings/round-drawing.js";
import { GRBL, withoutArcs } from "../../../support/machines/machine.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";

const TWO_LINES = strokesOf([10, 10, 60, 10, 60, 40], [20, 50, 80, 50]);

const STOPS: readonly [string, (run: RunningPlot) => Promise<void>][] = [
  ["pause", (run) => run.pause()],
  ["cancel", (run) => run.cancel()],
  ["emergency stop", (run) => run.emergencyStop()],
];

describe("a plot ends", () => {
  it.each(STOPS)("a plot ends if the cable is unplugged during a %s", async (_, stop) => {
    const { world, begin, within, line, mustWork } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    const asked = stop(run).catch(() => undefined);
    line().unplug();
    expect(await within(run.finished)).toMatch(/^disconnected/);
    await world.run(asked, LIMIT_S);
    await mustWork();
  });

  it.each(STOPS)("a plot ends if the board does not answer a %s", async (_, stop) => {
    const { world, begin, within, line, mustWork } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    const asked = stop(run).catch(() => undefined);
    line().isMute = true;
    expect(await within(run.finished)).toMatch(/^board-timeout/);
    await world.run(asked, LIMIT_S);
    await mustWork();
  });

  it("a plot ends with the pen up if the plotter is closed during a pause's braking", async () => {
    const { world, board, driver, begin, within } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    const asked = run.pause().catch(() => undefined);
    await world.advance(0.02);
    expect(board.state()).toMatchObject({ state: "Hold:1", penUp: false });
    expect(await within(driver.close())).toBeUndefined();
    expect(await within(run.finished)).toMatch(/^disconnected: The plotter was closed/);
    await world.run(asked, LIMIT_S);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
  });

  it("a plot ends if a pause crosses its last reply", async () => {
    const lines = strokesOf([10, 10, 20, 10]);
    const whole = await newPlotter();
    whole.line().lateS = 0.02;
    const run = await whole.begin(new LocalPlanner(lines));
    const startS = whole.world.nowS();
    await whole.world.run(run.finished);
    const tookS = whole.world.nowS() - startS;
    for (let earlyS = 0; earlyS < 0.08; earlyS += 0.004) {
      const { world, line, begin, within, mustWork } = await newPlotter();
      line().lateS = 0.02;
      const late = await begin(new LocalPlanner(lines));
      await world.advance(tookS - earlyS);
      const asked = late.pause().catch(() => undefined);
      await world.advance(5);
      await world.run(Promise.all([asked, late.resume()]), LIMIT_S);
      expect(await within(late.finished)).toEqual({ kind: "done" });
      await mustWork();
    }
  });

  it("a stopped move by hand ends if the board does not answer", async () => {
    const { world, machine, line, lost, within } = await newMachine();
    const move = machine.moveTo(100, 50, SETTINGS);
    await world.advance(0.6);
    line.isMute = true;
    machine.stopAtOnce();
    expect(await within(move)).toMatch(/^board-timeout/);
    expect(lost).toEqual(["board-timeout"]);
  });
});

describe("after an error", () => {
  it("a refused line leaves the pen up, the position known and the plotter free", async () => {
    const { board, driver, begin, within, mustWork } = await newPlotter();
    const places: StrokePosition[] = [];
    const journal = { record: ({ place }: JournalEntry) => void places.push(place) };
    const run = await begin(new RefusedPlanner(DRAWING, 12), { journal });
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl refused G5X1 with error:20/);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    const { xMm, yMm } = board.state();
    expect(xMm + yMm).toBeGreaterThan(1);
    const { state } = driver;
    expect(state).toMatchObject({ connection: "idle", penUp: true });
    expect(Math.hypot(state.xMm! - xMm, state.yMm! - yMm)).toBeLessThan(0.002);
    const left = pointAt(DRAWING, places[places.length - 1]);
    expect(Math.hypot(left.x - xMm, left.y - yMm)).toBeLessThan(0.05);
    // It slowed down along the path.
    expect(driver.log()).not.toContain("ALARM");
    await mustWork();
  });

  it("a hand move with a refused line leaves the pen up and the machine free", async () => {
    const { board, machine, within } = await newMachine();
    await within(machine.movePen(true, SETTINGS));
    await within(machine.prepareMotors(SETTINGS));
    const planner = new RefusedPlanner(TWO_LINES, 4);
    const plot = await planner.plan({
      from: null,
      until: null,
      startXMm: 0,
      startYMm: 0,
      settings: SETTINGS,
      firmware: machine.firmware,
    });
    expect(await within(machine.perform(plot, SETTINGS))).toMatch(/^board-error: The Grbl refused G5X1/);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(await within(machine.moveTo(3, 4, SETTINGS))).toBeUndefined();
    expect(board.state()).toMatchObject({ xMm: 3, yMm: 4 });
  });

  it.each([
    [
      "an alarm",
      (board: VirtualGrbl) => board.stopWith(1),
      /^board-error: The Grbl has stopped with ALARM:1/,
    ],
    ["a restart", (board: VirtualGrbl) => board.restart(), /^board-error: The Grbl has restarted/],
  ])("%s in mid-plot lifts the pen and forgets the position", async (_, fault, message) => {
    const { world, board, driver, begin, within, mustWork } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    fault(board);
    expect(await within(run.finished)).toMatch(message);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null });
    await mustWork();
  });

  it("an alarm while it slows down for a pause ends the plot", async () => {
    const { world, board, driver, begin, within } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    const asked = run.pause().catch(() => undefined);
    await world.advance(0.02);
    board.stopWith(1);
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has stopped with ALARM:1/);
    await world.run(asked, LIMIT_S);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
  });

  it("a plotter that is closed during a move by hand stops, lifts the pen and closes", async () => {
    const { world, board, driver, within } = await newPlotter();
    const patch = driver.move({ kind: "test-patch" });
    await world.advance(1.2);
    expect(board.state()).toMatchObject({ state: "Run", penUp: false });
    expect(await within(driver.close())).toBeUndefined();
    expect(await within(patch)).toMatch(/^conflict/);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.log()).not.toContain("> !");
  });
});

describe("a restart of a board whose boot loader waits before the Grbl starts", () => {
  const BOOT_S = 1.5;
  const CIRCLE_MM = 30;

  /** Plots until the board restarts on the circle of the drawing. Its greeting comes after BOOT_S. */
  async function restarted(meanwhile: (run: RunningPlot) => Promise<void>) {
    const { world, board, driver, begin, within, line } = await newPlotter();
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    const run = await begin(new LocalPlanner(DRAWING), { journal: { record } });
    await world.advance(2.1);
    const { xMm, yMm } = board.state();
    const drawnMm = CIRCLE_MM * Math.atan2(yMm - 50, xMm - 60);
    expect(Math.hypot(yMm - 50, xMm - 60)).toBeCloseTo(CIRCLE_MM, 1);
    const weak = line();
    weak.isMute = weak.isDeaf = true;
    board.restart();
    const asked = meanwhile(run).catch(() => undefined);
    await world.advance(BOOT_S);
    weak.isMute = weak.isDeaf = false;
    board.restart();
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has restarted/);
    await asked;
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.state).toMatchObject({ xMm: null, yMm: null });
    return { drawnMm, left: journal.at(-1)?.place };
  }

  it.each([
    ["without a stop", () => Promise.resolve()],
    ["during an emergency stop", (run: RunningPlot) => run.emergencyStop()],
  ])("leaves nothing out, %s", async (_, meanwhile) => {
    const { drawnMm, left } = await restarted(meanwhile);
    expect(left?.stroke).toBe(0);
    expect(left?.alongMm).toBeLessThan(drawnMm + 0.05);
    expect(left?.alongMm).toBeGreaterThan(drawnMm - 30);
  });
});

describe("a restart at rest", () => {
  it("is reported, and the old position no longer counts", async () => {
    const { world, board, driver, within } = await newPlotter();
    expect(await within(driver.move({ kind: "move-to", xMm: 100, yMm: 50 }))).toBeUndefined();
    board.restart();
    expect(driver.state).toMatchObject({ connection: "fault", xMm: null, penUp: null, motorsOn: null });
    expect(driver.state.message).toMatch(/^The Grbl has restarted: .*push the carriage to home/);
    await world.advance(5);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
    expect(await within(driver.move({ kind: "move-to", xMm: 5, yMm: 6 }))).toBeUndefined();
    // Where it stood, at 100, 50, was home.
    expect(board.state()).toMatchObject({ xMm: 105, yMm: 56 });
  });

  it("ends a plot that is held, since its home is lost", async () => {
    const { world, board, begin, within } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    await world.run(run.pause());
    board.restart();
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has restarted/);
  });
});

describe("an emergency stop", () => {
  it("an emergency stop during a pause's braking stops at once, and the plot resumes from there", async () => {
    const { world, board, driver, begin } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    const paused = run.pause();
    await world.advance(0.005);
    expect(board.state().state).toBe("Hold:1");
    const stopped = run.emergencyStop();
    await world.advance(0);
    expect(board.state().state).not.toBe("Hold:1");
    expect(driver.log()).toContain("ALARM:3");
    await world.run(Promise.all([paused, stopped]), LIMIT_S);
    expect(driver.log().match(/\(reset\)/g)).toHaveLength(1);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
  });

  it.each([
    [
      "a hit switch",
      (board: VirtualGrbl) => board.stopWith(1),
      /^board-error: The Grbl has stopped with ALARM:1/,
    ],
    ["a restart", (board: VirtualGrbl) => board.restart(), /^board-error: The Grbl has restarted/],
  ])("an emergency stop just after %s does not hide that the position is lost", async (_, fault, message) => {
    const { world, board, driver, begin, within, line } = await newPlotter();
    const run = await begin();
    await world.advance(2.1);
    line().lateS = 0.02;
    fault(board);
    const stopped = run.emergencyStop().catch(() => undefined);
    expect(await within(run.finished)).toMatch(message);
    await world.run(stopped, LIMIT_S);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.state).toMatchObject({ xMm: null, yMm: null });
  });

  it("among moves so short that some have left the Grbl's queue leaves nothing out", async () => {
    const strokes = strokesOf(...[10, 20, 30].map((x) => circle(x, 30, 4, 0, 0.97, 80).flat()));
    const machine = withoutArcs(GRBL);
    const settings = settingsWith({ face: "DrawCore" });
    const { world, board, begin } = await newPlotter({}, machine);
    const run = await begin(new LocalPlanner(strokes), {}, settings);
    await world.advance(1);
    for (let i = 0; i < 20; i++) {
      await world.advance(0.31);
      await world.run(run.emergencyStop());
      await world.run(run.resume());
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(compareDrawn(strokes, board.drawn()).gapMm).toBeLessThan(0.05);
  });

  it("an emergency stop while the pen lifts for a move by hand cancels the move", async () => {
    const { world, board, machine, within } = await newMachine();
    const move = machine.moveTo(100, 50, SETTINGS);
    await world.advance(0.05);
    expect(machine.penMoving).toBe(true);
    machine.stopAtOnce();
    expect(await within(move)).toBe("conflict: The move was stopped at once.");
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0, penUp: true });
    expect(await within(machine.moveTo(3, 4, SETTINGS))).toBeUndefined();
    expect(board.state()).toMatchObject({ xMm: 3, yMm: 4 });
  });

  it("an emergency stop while the pen lifts before a plot starts holds the plot", async () => {
    const { world, board, driver, begin } = await newPlotter();
    const run = await begin();
    await world.advance(0.05);
    expect(driver.state.penMoving).toBe(true);
    await world.run(run.emergencyStop(), LIMIT_S);
    expect(driver.state.activity).toBe("held");
    await world.advance(1);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0, penUp: true });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
  });
});

describe("a Grbl that does not answer", () => {
  it("is noticed at rest", async () => {
    const { world, driver, line, mustWork } = await newPlotter();
    line().isMute = true;
    await world.advance(5.5);
    expect(driver.state).toMatchObject({ connection: "fault" });
    expect(driver.state.message).toMatch(/^The board has stopped answering/);
    await mustWork();
  });

  it.each(["M0", "$SLP", "$H", "$C"])("a typed %s does not make a Grbl stop answering", async (typed) => {
    const { driver, within, mustWork } = await newPlotter();
    expect(await within(driver.command(typed))).toMatch(
      /^bad-setting: .* was not sent: the Grbl (would|does not)/,
    );
    await mustWork();
  });
});
