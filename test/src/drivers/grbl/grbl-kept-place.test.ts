/**
 * A Grbl that keeps its position over a hold, a pulled cable or a killed process: the line goes on where it stopped, within
 * 0.05 mm, and nothing is left out. If it loses its position, nothing is left out either.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry, RunningPlot } from "../../../../host/plotter/plotter-port.js";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import { machineOf, pointAt } from "../../../../src/internal.js";
import type { PlotSettings } from "../../../../src/schema/index.js";
import type { ManualClock } from "../../../support/clocks/manual-clock.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { ROUND_DRAWING } from "../../../support/drawings/round-drawing.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import {
  machineWith,
  newPlotter,
  plotterOn,
  SETTINGS,
  settingsWith,
} from "../../../support/plots/grbl-plotter.js";
import { GRBL_LINES } from "../../../support/machines/machine.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { layeredStrokes, LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { cases } from "../../../support/runs/full-run.js";
import { startAfter } from "../../../support/plots/start-after.js";

const MOST_MM = 0.05;
/** The drawing takes longer than that. */
const PLOT_S = 9;
/** The same with a pen that own lines move. */
const OWN_LINES_S = 9.8;
/** What a Grbl's buffers hold is drawn by then. */
const REST_S = 15;
const FACES: readonly VirtualGrblOptions[] = [
  { face: "1.1" },
  { face: "grblHAL" },
  { face: "FluidNC" },
  { face: "DrawCore" },
];

type How =
  | "killed"
  | "unplugged"
  | "unplugged, then held by another program"
  | "killed while it pauses"
  | "killed, and the Grbl is reset";

/** Interrupts a plot after `atS`, and resumes it by a new process, or after the cable is back. */
async function interrupted(
  how: How,
  options: VirtualGrblOptions,
  atS: number,
  strokes = FAULT_DRAWING,
  settings = settingsWith(options),
  restS = REST_S,
) {
  const isUnplugged = how.startsWith("unplugged");
  const { world, board, ...first } = await newPlotter(options, machineOf(settings));
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await first.begin(new LocalPlanner(strokes), { journal: { record } }, settings);
  await world.advance(atS);
  const ended = run.finished.catch(() => undefined);
  if (how === "killed while it pauses") {
    void run.pause().catch(() => undefined);
    await world.advance(0.3);
  }
  // What the dead process would still write is not written.
  const atKill = journal.at(-1)!;
  if (isUnplugged) first.line().unplug();
  else first.kill();
  if (how === "unplugged, then held by another program") {
    await world.advance(0.5);
    board.takeFromOther("!");
  }
  await world.advance(restS);
  if (how === "killed, and the Grbl is reset") {
    board.restart();
    // As the person is asked to.
    board.pushHome();
    board.pushPen(0);
  }
  const last = isUnplugged ? journal.at(-1)! : atKill;
  const next = isUnplugged ? first : await plotterOn(board, world, machineOf(settings));
  const found = next.driver.state;
  const start = { ...startAfter(last), journal: { record } };
  const resumed = await next.begin(new LocalPlanner(strokes), start, settings);
  resumeAtPenStops(resumed);
  await world.run(resumed.resume());
  expect(await world.run(resumed.finished)).toEqual({ kind: "done" });
  await ended;
  expect(board.state()).toMatchObject({ state: "Idle", penUp: true, lostCount: 0 });
  return { found, ...compareDrawn(strokes, board.drawn()) };
}

const resumeAtPenStops = (run: RunningPlot): void =>
  run.onHeld((_, wait) => {
    if (wait) void run.resume();
  });

const DRAWINGS = { "lines and curves": FAULT_DRAWING, "round lines": ROUND_DRAWING };
const PLOTS = FACES.flatMap((options) =>
  Object.entries(DRAWINGS).map(([name, drawing]) => [name, options.face, options, drawing] as const),
);

describe.each(PLOTS)("a plot of %s on %s", (_, __, options, drawing) => {
  it.each(["killed", "unplugged"] as const)(
    "goes on where it stopped if it is %s",
    { timeout: 300_000 },
    async (how) => {
      const random = seeded(7 + how.length);
      const wrong: unknown[] = [];
      for (let i = 0; i < cases(how === "killed" ? 20 : 10, 3); i++) {
        const atS = 0.6 + (PLOT_S - 0.6) * random();
        const { gapMm, overlapMm, awayMm, found } = await interrupted(how, options, atS, drawing);
        expect(found.xMm).not.toBeNull();
        if (gapMm > MOST_MM || overlapMm > MOST_MM || awayMm > MOST_MM) {
          wrong.push({ atS, gapMm, overlapMm, awayMm });
        }
      }
      expect(wrong).toEqual([]);
    },
  );

  it.each(["killed while it pauses", "killed, and the Grbl is reset"] as const)(
    "leaves nothing out if it is %s",
    { timeout: 120_000 },
    async (how) => {
      const random = seeded(3);
      for (let i = 0; i < cases(20, 2); i++) {
        const { gapMm, found } = await interrupted(how, options, 0.6 + (PLOT_S - 1) * random(), drawing);
        expect(gapMm).toBeLessThan(MOST_MM);
        if (how !== "killed while it pauses") expect(found.xMm).toBeNull();
      }
    },
  );

  it("goes on where it stopped after each of many holds", { timeout: 300_000 }, async () => {
    const random = seeded(11);
    const { world, board, begin } = await newPlotter(options);
    const run = await begin(new LocalPlanner(drawing));
    let holdCount = 0;
    let isOver = false;
    void run.finished.then(() => (isOver = true));
    while (!isOver && holdCount < cases(100, 12)) {
      await world.advance(0.02 + (PLOT_S / cases(100, 12)) * 1.5 * random());
      await world.run(run.pause());
      if (!isOver) expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
      await world.run(run.resume());
      holdCount++;
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    const { gapMm, overlapMm, awayMm } = compareDrawn(drawing, board.drawn());
    expect(gapMm).toBeLessThan(MOST_MM);
    expect(overlapMm).toBeLessThan(MOST_MM);
    expect(awayMm).toBeLessThan(MOST_MM);
    expect(holdCount).toBeGreaterThan(5);
  });
});

describe.each(FACES)("a plot of short lines on $face that was resumed", (options) => {
  const HATCHING = strokesOf(
    ...Array.from({ length: 120 }, (_, i) => {
      const [x, y] = [20 + (i % 12) * 6, 20 + Math.floor(i / 12) * 4];
      return [x, y, x + 4, y + 1];
    }),
  );
  const settings = settingsWith(options);
  const machine = machineOf(settings);

  /** Killed, resumed by a second process, and interrupted again `afterS` later. */
  async function interruptedAgain(how: "killed" | "unplugged", afterS: number) {
    const { world, board, ...first } = await newPlotter(options);
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    const plotBy = (plotter: typeof first) => {
      const start = { ...startAfter(journal.at(-1)), held: false, journal: { record } };
      return plotter.begin(new LocalPlanner(HATCHING), start, settings);
    };
    await plotBy(first);
    await world.advance(4);
    first.kill();
    await world.advance(REST_S);
    const second = await plotterOn(board, world, machine);
    const run = await plotBy(second);
    const ended = run.finished.catch(() => undefined);
    await world.advance(afterS);
    const count = journal.length;
    if (how === "killed") second.kill();
    else second.line().unplug();
    await world.advance(REST_S);
    // What the dead process would still write is not written.
    if (how === "killed") journal.length = count;
    const rest = await plotBy(how === "killed" ? await plotterOn(board, world, machine) : second);
    expect(await world.run(rest.finished)).toEqual({ kind: "done" });
    await ended;
    const { gapMm, overlapMm } = compareDrawn(HATCHING, board.drawn());
    return { afterS, gapMm, overlapMm };
  }

  it.each(["killed", "unplugged"] as const)(
    "goes on where it stopped if it is %s soon after",
    { timeout: 120_000 },
    async (how) => {
      const count = cases(30, 6);
      for (let i = 0; i < count; i++) {
        const { gapMm, overlapMm, afterS } = await interruptedAgain(how, (0.9 * i) / count);
        expect({ afterS, isWhole: gapMm < MOST_MM, isOnce: overlapMm < MOST_MM }).toEqual({
          afterS,
          isWhole: true,
          isOnce: true,
        });
      }
    },
  );
});

describe.each(FACES)("a pen that own lines move, on $face", (options) => {
  const machine = machineWith(options, GRBL_LINES);
  const settings = { ...SETTINGS, customMachine: machine };

  it.each(["killed", "unplugged"] as const)(
    "draws nothing twice, and leaves nothing out, if it is %s",
    { timeout: 300_000 },
    async (how) => {
      const random = seeded(5);
      const wrong: unknown[] = [];
      for (let i = 0; i < cases(40, 8); i++) {
        // Also at the end, when it is on its way home.
        const atS = 0.8 + (OWN_LINES_S - 0.8) * (i % 2 ? random() : 1 - 0.2 * random());
        const { gapMm, overlapMm } = await interrupted(how, options, atS, FAULT_DRAWING, settings);
        if (gapMm > MOST_MM || overlapMm > MOST_MM) wrong.push({ atS, gapMm, overlapMm });
      }
      expect(wrong).toEqual([]);
    },
  );
});

describe.each(FACES)("a plot of long, slow lines on $face", (options) => {
  const ZIGZAG = strokesOf(Array.from({ length: 30 }, (_, i) => [i % 2 === 0 ? 20 : 270, 10 + 5 * i]).flat());
  const usual = settingsWith(options);
  const { motion } = usual;
  const SLOW = { ...usual, motion: { ...motion, draw: { ...motion.draw, speedMmPerS: 40 } } };
  /** Longer than the whole plot. */
  const DRAWN_S = 400;

  // Its queue holds up to 100 s of the drawing. A plotter that is connected again stops it after a minute.
  it.each(["killed", "unplugged", "unplugged, then held by another program"] as const)(
    "goes on where it stopped if it is %s",
    async (how) => {
      const count = cases(6, 2);
      for (let i = 0; i < count; i++) {
        const atS = 5 + (20 * i) / count;
        const { gapMm, overlapMm } = await interrupted(how, options, atS, ZIGZAG, SLOW, DRAWN_S);
        expect({ atS, isWhole: gapMm < MOST_MM, isOnce: overlapMm < MOST_MM }).toEqual({
          atS,
          isWhole: true,
          isOnce: true,
        });
      }
    },
  );
});

describe("the place of a Grbl", () => {
  const LINE = strokesOf([10, 10, 200, 10], [200, 20, 10, 90]);

  /** It stopped on the first line. `meanwhile`: what the next process does before it ends too. */
  async function killedOnLine(
    meanwhile: (next: Awaited<ReturnType<typeof plotterOn>>, world: ManualClock) => unknown,
  ): Promise<{ fromMm: number; resumedMm: number }> {
    const { world, board, ...first } = await newPlotter();
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    await first.begin(new LocalPlanner(LINE), { journal: { record } });
    await world.advance(2.5);
    const last = journal.at(-1)!;
    expect(last.place.stroke).toBe(0);
    first.kill();
    await world.advance(REST_S);
    const second = await plotterOn(board, world);
    await meanwhile(second, world);
    second.kill();
    const third = await plotterOn(board, world);
    const resumed = await third.begin(new LocalPlanner(LINE), startAfter(last));
    return { fromMm: last.place.alongMm, resumedMm: resumed.holdPlace!.alongMm };
  }

  it("is that of the plot after it was found a second time", async () => {
    const { fromMm, resumedMm } = await killedOnLine(() => undefined);
    expect(resumedMm).toBeGreaterThan(fromMm + MOST_MM);
  });

  it("is not that of the plot after the carriage was moved by hand to a later line", async () => {
    const { x, y } = pointAt(LINE, { stroke: 1, alongMm: 30 });
    const { fromMm, resumedMm } = await killedOnLine((next, world) =>
      world.run(next.driver.move({ kind: "move-to", xMm: x, yMm: y })),
    );
    expect(resumedMm).toBeCloseTo(fromMm, 6);
  });

  it("is not that of another run of the same drawing that was killed since, farther on", async () => {
    const { fromMm, resumedMm } = await killedOnLine(async (next, world) => {
      await next.begin(new LocalPlanner(LINE), { from: { stroke: 0, alongMm: 100 }, held: false });
      await world.advance(2);
      next.kill();
      await world.advance(REST_S);
    });
    expect(resumedMm).toBeCloseTo(fromMm, 6);
  });

  it("is not that of another plot that was cancelled since", async () => {
    const { fromMm, resumedMm } = await killedOnLine(async (next, world) => {
      const other = await next.begin(new LocalPlanner(strokesOf([5, 5, 90, 5])));
      await world.run(other.cancel());
      await world.run(other.finished);
    });
    expect(resumedMm).toBeCloseTo(fromMm, 6);
  });
});

describe("a plot with a pen stop", () => {
  const LAYERS = ["first", "second"].map((id) => ({ id, name: id, color: null }));
  const TWO_PENS = layeredStrokes(LAYERS, [
    [0, [20, 20, 30, 20]],
    [0, [30, 30, 60, 30]],
    [1, [20, 40, 40, 40]],
    [1, [20, 50, 40, 50]],
  ]);
  const WITH_STOP: PlotSettings = { ...SETTINGS, penStops: "layers" };

  /** Runs to the stop; returns how long that takes from the beginning, s. */
  async function stopS(): Promise<number> {
    const { world, begin } = await newPlotter();
    const run = await begin(new LocalPlanner(TWO_PENS), {}, WITH_STOP);
    const fromS = world.nowS();
    await world.run(new Promise<void>((resolve) => run.onHeld((held) => held && resolve())));
    return world.nowS() - fromS;
  }

  /** From the beginning of the last stroke before the stop, until home. */
  async function instants(): Promise<number[]> {
    const count = cases(60, 12);
    const untilS = await stopS();
    return Array.from({ length: count }, (_, i) => untilS * (0.4 + (0.6 * (i + 0.5)) / count));
  }

  it("leaves nothing out after the stop if it is killed just before", { timeout: 120_000 }, async () => {
    for (const atS of await instants()) {
      const { gapMm } = await interrupted("killed", { face: "1.1" }, atS, TWO_PENS, WITH_STOP);
      expect({ atS, isWhole: gapMm < MOST_MM }).toEqual({ atS, isWhole: true });
    }
  });

  it("leaves nothing out after the stop at an emergency stop before it", { timeout: 120_000 }, async () => {
    for (const atS of await instants()) {
      const { world, board, begin } = await newPlotter();
      const run = await begin(new LocalPlanner(TWO_PENS), {}, WITH_STOP);
      resumeAtPenStops(run);
      await world.advance(atS);
      for (let again = 0; again < 2; again++) {
        await world.run(run.emergencyStop());
        await world.run(run.resume());
        await world.advance(0.3);
      }
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      const { gapMm } = compareDrawn(TWO_PENS, board.drawn());
      expect({ atS, isWhole: gapMm < MOST_MM }).toEqual({ atS, isWhole: true });
    }
  });
});

it("a DrawCore that greets only at the first connection is the same board at the next one", async () => {
  const { world, board, driver, begin, line, within } = await newPlotter({ face: "DrawCore" });
  const before = line();
  before.unplug();
  while (line() === before) await world.advance(0.1);
  // As a board does whose port is opened for the first time.
  board.restart();
  await world.advance(6);
  expect(driver.state).toMatchObject({ connection: "idle", firmware: "DrawCore 2.09" });
  await begin();
  await world.advance(3);
  line().unplug();
  await world.advance(6);
  expect(driver.state).toMatchObject({ connection: "idle", firmware: "DrawCore 2.09" });
  expect(driver.state.xMm).not.toBeNull();
  expect(await within(driver.move({ kind: "home" }))).toBeUndefined();
});
