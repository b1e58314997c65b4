/**
 * A Grbl that keeps its position over a hold, a pulled cable or a killed process: the line goes on where it stopped, within
 * 0.05 mm, and nothing is left out. If it loses its position, nothing is left out either.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { newPlotter, plotterOn } from "../../../support/plots/grbl-plotter.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { cases } from "../../../support/runs/full-run.js";

const MOST_MM = 0.05;
/** The drawing takes longer than that. */
const PLOT_S = 9;
/** What a Grbl's buffers hold is drawn by then. */
const REST_S = 15;
const FACES: readonly VirtualGrblOptions[] = [
  { face: "1.1" },
  { face: "grblHAL" },
  { face: "FluidNC" },
  { face: "DrawCore" },
];

type How = "killed" | "unplugged" | "killed while it pauses" | "killed, and the Grbl is reset";

/** Interrupts a plot after `atS`, and resumes it by a new process, or after the cable is back. */
async function interrupted(how: How, options: VirtualGrblOptions, atS: number) {
  const { world, board, ...first } = await newPlotter(options);
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await first.begin(new LocalPlanner(FAULT_DRAWING), { journal: { record } });
  await world.advance(atS);
  const ended = run.finished.catch(() => undefined);
  if (how === "killed while it pauses") {
    void run.pause().catch(() => undefined);
    await world.advance(0.3);
  }
  // What the dead process would still write is not written.
  const atKill = journal.at(-1)!;
  if (how === "unplugged") first.line().unplug();
  else first.kill();
  await world.advance(REST_S);
  if (how === "killed, and the Grbl is reset") {
    board.restart();
    // As the person is asked to.
    board.pushHome();
  }
  const { place: from, received } = how === "unplugged" ? journal.at(-1)! : atKill;
  const next = how === "unplugged" ? first : await plotterOn(board, world);
  const found = next.driver.state;
  const resumed = await next.begin(new LocalPlanner(FAULT_DRAWING), { from, received, journal: { record } });
  await world.run(resumed.resume());
  expect(await world.run(resumed.finished)).toEqual({ kind: "done" });
  await ended;
  expect(board.state()).toMatchObject({ state: "Idle", penUp: true, lostCount: 0 });
  return { found, ...compareDrawn(FAULT_DRAWING, board.drawn()) };
}

describe.each(FACES)("a plot on $face", (options) => {
  it.each(["killed", "unplugged"] as const)(
    "goes on where it stopped if it is %s",
    { timeout: 300_000 },
    async (how) => {
      const random = seeded(7 + how.length);
      const wrong: unknown[] = [];
      for (let i = 0; i < cases(how === "killed" ? 20 : 10, 3); i++) {
        const atS = 0.6 + (PLOT_S - 0.6) * random();
        const { gapMm, overlapMm, awayMm, found } = await interrupted(how, options, atS);
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
        const { gapMm, found } = await interrupted(how, options, 0.6 + (PLOT_S - 1) * random());
        expect(gapMm).toBeLessThan(MOST_MM);
        if (how !== "killed while it pauses") expect(found.xMm).toBeNull();
      }
    },
  );

  it("goes on where it stopped after each of many holds", { timeout: 300_000 }, async () => {
    const random = seeded(11);
    const { world, board, begin } = await newPlotter(options);
    const run = await begin(new LocalPlanner(FAULT_DRAWING));
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
    const { gapMm, overlapMm, awayMm } = compareDrawn(FAULT_DRAWING, board.drawn());
    expect(gapMm).toBeLessThan(MOST_MM);
    expect(overlapMm).toBeLessThan(MOST_MM);
    expect(awayMm).toBeLessThan(MOST_MM);
    expect(holdCount).toBeGreaterThan(5);
  });
});
