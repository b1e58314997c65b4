/**
 * Where a plot resumes when the board has lost its position or has refused a command: nothing is left out,
 * and no more is drawn twice than the board can have drawn since its last certain position.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry, PlotStart, RunningPlot } from "../../../../host/plotter/plotter-port.js";
import type { Devices } from "../../../../host/plotter/devices.js";
import { PlotterConnection as HostDriver } from "../../../../host/plotter/plotter-connection.js";
import { VirtualBoard, type PlotwrightError, type StrokeSet, type Transport } from "../../../../src/index.js";
import { firmwareFeatures } from "../../../../src/drivers/ebb/protocol/firmware.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { cases } from "../../../support/runs/full-run.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import {
  drawnUntilMm,
  KeepingPlanner,
  mmOf,
  planSAfter,
  ranTicks,
} from "../../../support/drawings/stop-truth.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";
import { startAfter } from "../../../support/plots/start-after.js";

const FIRMWARES = ["2.8.1", "3.0.3"];
const COUNT = 10;
const PLOT_S = 8;
const SPEED_MM_PER_S = DEFAULT_PLOT_SETTINGS.motion.draw.speedMmPerS;
/**
 * Between two readings of the supply, on a board whose replies wait for the motion before them, plus the
 * motion that it holds.
 */
const SUPPLY_INTERVAL_S = 0.25 + 0.3;
const WINDOW_S = 0.3;
const MAX_OVERLAP_MM = SPEED_MM_PER_S * (SUPPLY_INTERVAL_S + WINDOW_S);
/** Drawn beside the path before a board with a blocked parser can be stopped. */
const WINDOW_MM = SPEED_MM_PER_S * (WINDOW_S + 0.15);
const GAP_MM = 0.05;

/** A circle of 25 mm, nine times over. */
const ROUND_AND_ROUND = strokesOf(
  Array.from({ length: 9 * 60 + 1 }, (_, i) => [
    30 + 4 * Math.cos((i / 60) * 2 * Math.PI),
    30 + 4 * Math.sin((i / 60) * 2 * Math.PI),
  ]).flat(),
);
const STRAIGHT = strokesOf([10, 10, 200, 10], [200, 20, 10, 90]);
/** The length of its last stroke. */
const LAST_MM = Math.hypot(190, 70);

/** The host reads each reply that much later. */
function withLateReplies(transport: Transport, clock: ManualClock, lateS: number): Transport {
  const onData = transport.onData.bind(transport);
  transport.onData = (listener) => onData((bytes) => void clock.after(lateS, () => listener(bytes)));
  return transport;
}

interface Interrupted {
  readonly world: ManualClock;
  readonly driver: HostDriver;
  readonly board: VirtualBoard;
  readonly strokes: StrokeSet;
  readonly journal: JournalEntry[];
  readonly message: string;
}

/** Plots until `happen` interrupts the plot, `afterS` seconds after its start. */
async function interrupt(
  firmware: string,
  afterS: number,
  happen: (board: VirtualBoard) => void,
  strokes = FAULT_DRAWING,
  lateS = 0,
): Promise<Interrupted> {
  const world = new ManualClock();
  const board = new VirtualBoard({ clock: world, firmware, servo: {} });
  const devices: Devices = {
    find: () => Promise.resolve([]),
    open: () => Promise.resolve(withLateReplies(board.transport(), world, lateS)),
  };
  const driver = new HostDriver({ device: "a port", clock: world, devices });
  await world.run(driver.start());
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await world.run(
    driver.plot(new LocalPlanner(strokes), DEFAULT_PLOT_SETTINGS, { journal: { record } }),
  );
  await underWay(world, journal);
  await world.advance(afterS);
  happen(board);
  const message = await world.run(
    run.finished.then(
      () => "done",
      (error: PlotwrightError) => `${error.code}: ${error.message}`,
    ),
    20,
  );
  return { world, driver, board, strokes, journal, message };
}

/** Waits until the plot is planned and has begun. */
async function underWay(world: ManualClock, journal: readonly JournalEntry[]): Promise<void> {
  while (journal.length === 0) await world.advance(0.05);
}

/** Resumes the plot from the journal's place, and compares the paper with the drawing. */
async function resumeAndCompare({ world, driver, board, strokes, journal }: Interrupted) {
  const last = journal.at(-1);
  const run = await world.run(
    driver.plot(new LocalPlanner(strokes), DEFAULT_PLOT_SETTINGS, startAfter(last)),
  );
  await world.advance(1);
  await world.run(run.resume());
  expect(await world.run(run.finished)).toEqual({ kind: "done" });
  expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  return compareDrawn(strokes, board.drawn());
}

describe.each(FIRMWARES)("a plot on firmware %s", (firmware) => {
  it("a plot whose motors lose their supply resumes from the last good reading", async () => {
    const random = seeded(5);
    for (let i = 0; i < COUNT; i++) {
      const plot = await interrupt(firmware, 0.4 + (PLOT_S - 1) * random(), (one) => one.setMotorVolts(0));
      expect(plot.message).toMatch(/^board-error: The motors have no power.*overlap a little/);
      // In steps, so that pending promises settle in between.
      for (let step = 0; step < 40; step++) await plot.world.advance(0.05);
      expect(plot.board.state()).toMatchObject({ penUp: true, motorsOn: false });
      plot.board.setMotorVolts(9.1);
      await plot.world.advance(5);
      expect(plot.driver.state).toMatchObject({ connection: "idle", xMm: null });
      const { gapMm, overlapMm } = await resumeAndCompare(plot);
      expect(gapMm).toBeLessThan(GAP_MM);
      expect(overlapMm).toBeLessThan(MAX_OVERLAP_MM);
    }
  });

  it("a plot whose board restarts is interrupted at once, and resumes from its last certain position", async () => {
    const random = seeded(6);
    for (let i = 0; i < COUNT; i++) {
      const plot = await interrupt(firmware, 0.4 + (PLOT_S - 1) * random(), (one) => one.restart());
      expect(plot.message).toMatch(/^board-error: The board restarted.*overlap a little/);
      expect(plot.board.state()).toMatchObject({ penUp: true, motorsOn: false });
      expect(plot.driver.state).toMatchObject({ connection: "idle", xMm: null });
      const { gapMm, overlapMm } = await resumeAndCompare(plot);
      expect(gapMm).toBeLessThan(GAP_MM);
      expect(overlapMm).toBeLessThan(MAX_OVERLAP_MM);
    }
  });

  it("a plot with a refused command keeps its position, and resumes from that command", async () => {
    const random = seeded(7);
    let refused = 0;
    for (let i = 0; i < 2 * COUNT; i++) {
      const plot = await interrupt(firmware, 0.4 + 9 * random(), (one) => one.refuseNext(), STRAIGHT);
      // It may have been a query: those are repeated.
      if (plot.message === "done") continue;
      refused++;
      expect(plot.message).toMatch(/^board-error: The board refused /);
      expect(plot.board.state()).toMatchObject({ penUp: true, motorsOn: true });
      expect(plot.driver.state.xMm).not.toBeNull();
      const { gapMm, overlapMm, awayMm } = await resumeAndCompare(plot);
      expect(gapMm).toBeLessThan(GAP_MM);
      expect(overlapMm).toBeLessThan(GAP_MM);
      expect(awayMm).toBeLessThan(GAP_MM);
    }
    expect(refused).toBeGreaterThan(COUNT / 2);
  });

  it("a plot with three refused commands in a row leaves nothing out", { timeout: 120_000 }, async () => {
    const random = seeded(9);
    for (let i = 0; i < cases(100, COUNT); i++) {
      const [strokes, lateS] = [[STRAIGHT, FAULT_DRAWING][i % 2], [0, 0, 0.05, 0.05, 0.2, 0.2][i % 6]];
      const afterS = 0.4 + 6 * random();
      const plot = await interrupt(firmware, afterS, (one) => one.refuseNext(3), strokes, lateS);
      // They may have been queries: those are repeated.
      if (plot.message === "done") continue;
      const { gapMm, overlapMm } = await resumeAndCompare(plot);
      expect(gapMm).toBeLessThan(GAP_MM);
      expect(overlapMm).toBeLessThan(WINDOW_MM);
    }
  });

  it("a plot with a refused command on a curve leaves nothing out", async () => {
    const random = seeded(8);
    for (let i = 0; i < COUNT; i++) {
      const plot = await interrupt(firmware, 0.4 + 6 * random(), (one) => one.refuseNext());
      if (plot.message === "done") continue;
      const { gapMm, overlapMm } = await resumeAndCompare(plot);
      expect(gapMm).toBeLessThan(GAP_MM);
      // If the board's parser is free, it is stopped before any command after the refused one.
      expect(overlapMm).toBeLessThan(firmware === "3.0.3" ? GAP_MM : WINDOW_MM);
    }
  });
});

// On 2.8.1 the commands sent ahead wait in the system's buffers, which the virtual connection loses when it
// is unplugged.
it("a plot whose server is killed on a line that retraces itself resumes from the place that fits what the board had received", async () => {
  const random = seeded(9);
  for (let i = 0; i < 2 * COUNT; i++) {
    const { world, driver } = await virtualPlotter({ firmware: "3.0.3" });
    const planner = new KeepingPlanner(ROUND_AND_ROUND);
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    const run = await world.run(driver.plot(planner, DEFAULT_PLOT_SETTINGS, { journal: { record } }));
    await underWay(world, journal);
    await world.advance(1.5 + 4 * random());
    // A killed server writes nothing at its end; the board plays what it has.
    const last = journal.at(-1)!;
    virtualBoardOf(driver).unplug();
    await world.run(run.finished.catch(() => undefined));
    await world.advance(5);
    const { idleTicksTimed } = firmwareFeatures("3.0.3");
    const ticks = ranTicks(virtualBoardOf(driver)) - (1 + idleTicksTimed);
    const [plot] = planner.plots;
    const truthMm = drawnUntilMm(ROUND_AND_ROUND, plot, planSAfter(plot.commands, ticks));
    const again = await world.run(
      driver.plot(new LocalPlanner(ROUND_AND_ROUND), DEFAULT_PLOT_SETTINGS, startAfter(last)),
    );
    expect(Math.abs(mmOf(ROUND_AND_ROUND, again.holdPlace!) - truthMm)).toBeLessThan(2 * GAP_MM);
    await world.run(Promise.all([again.cancel(), again.finished]));
  }
});

describe.each(FIRMWARES)("the place of a board on firmware %s", (firmware) => {
  async function begunOnLine(afterS: number) {
    const { world, driver } = await virtualPlotter({ firmware });
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    const run = await world.run(
      driver.plot(new LocalPlanner(STRAIGHT), DEFAULT_PLOT_SETTINGS, { journal: { record } }),
    );
    await underWay(world, journal);
    await world.advance(afterS);
    return { world, driver, journal, run };
  }

  /** A killed server writes nothing at its end; the board plays what it has, and is found again. */
  async function killedOnLine(afterS: number) {
    const { world, driver, journal, run } = await begunOnLine(afterS);
    virtualBoardOf(driver).unplug();
    await world.run(run.finished.catch(() => undefined));
    await world.advance(5);
    const last = journal.at(-1)!;
    const resume = (start: PlotStart = {}): Promise<RunningPlot> =>
      world.run(
        driver.plot(new LocalPlanner(STRAIGHT), DEFAULT_PLOT_SETTINGS, {
          ...startAfter(last),
          ...start,
        }),
      );
    const holdPlace = async (): Promise<number> => {
      const again = await resume();
      const place = again.holdPlace!;
      await world.run(Promise.all([again.cancel(), again.finished]));
      return mmOf(STRAIGHT, place);
    };
    const reconnect = async (): Promise<void> => {
      virtualBoardOf(driver).unplug();
      await world.advance(5);
    };
    return { world, driver, fromMm: mmOf(STRAIGHT, last.place), resume, holdPlace, reconnect };
  }

  it("is that of the plot after it was found a second time", async () => {
    const { fromMm, holdPlace, reconnect } = await killedOnLine(2);
    await reconnect();
    expect(await holdPlace()).toBeGreaterThan(fromMm + GAP_MM);
  });

  it("is stored before it is left, also if there is no hold and nothing more is drawn", async () => {
    const { world, fromMm, resume } = await killedOnLine(8.8);
    const entries: JournalEntry[] = [];
    const run = await resume({ held: false, journal: { record: (entry) => entries.push(entry) } });
    await world.advance(0.3);
    const end = { stroke: 1, alongMm: LAST_MM };
    expect(fromMm).toBeLessThan(mmOf(STRAIGHT, end) - GAP_MM);
    expect(entries.at(-1)?.place).toEqual(end);
    await world.run(run.finished);
  });

  it("is not that of another plot that was interrupted since", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(1);
    const other = await world.run(driver.plot(new LocalPlanner(STRAIGHT), DEFAULT_PLOT_SETTINGS));
    await world.advance(3);
    await reconnect();
    await world.run(other.finished.catch(() => undefined));
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });

  it("is the chosen one after a pause, also with the pen on the paper", async () => {
    const { world, driver, journal, run } = await begunOnLine(2);
    await world.run(run.pause());
    const chosen = run.moveHoldPlace({ mm: -20 });
    await world.run(run.movePenAtHold(false));
    virtualBoardOf(driver).unplug();
    await world.run(run.finished.catch(() => undefined));
    await world.advance(5);
    const last = journal.at(-1)!;
    expect(last.place).toEqual(chosen);
    const again = await world.run(
      driver.plot(new LocalPlanner(STRAIGHT), DEFAULT_PLOT_SETTINGS, startAfter(last)),
    );
    expect(again.holdPlace).toEqual(chosen);
    await world.run(Promise.all([again.cancel(), again.finished]));
  });

  it("is not that of the plot after the carriage was moved by hand along its line", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(2);
    await world.run(driver.moveTo(10 + fromMm + 30, 10));
    await reconnect();
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });

  it("is not that of the plot after home was set where it stopped", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(7);
    await world.run(driver.setHome());
    await reconnect();
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });

  it("is not that of the plot after the carriage was pushed home by hand", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(7);
    await world.run(driver.motorsOff());
    await world.run(driver.setHome());
    await reconnect();
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });

  it("is not that of the plot after a typed command has moved the carriage along its line", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(2);
    await world.run(driver.command("SM,1000,1600,1600"));
    await reconnect();
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });

  it("is not that of another plot that has ended since", async () => {
    const { world, driver, fromMm, holdPlace, reconnect } = await killedOnLine(2);
    const other = await world.run(
      driver.plot(new LocalPlanner(strokesOf([5, 5, 9, 5])), DEFAULT_PLOT_SETTINGS),
    );
    await world.run(other.finished);
    await reconnect();
    expect(await holdPlace()).toBeCloseTo(fromMm, 6);
  });
});
