/**
 * An interruption at any instant of a plot: by a kill, or by a lost connection after which the board may have received
 * any part of what was sent. Nothing is left out, and no more is drawn twice than what the board had not yet
 * acknowledged, as far as the host knew. In the full run at 4 000 instants on each firmware.
 */
import { describe, expect, it } from "vitest";
import { JOURNAL_S, PROGRESS_S } from "../../../../host/plotter/resume-position.js";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import type { StrokeSet } from "../../../../src/index.js";
import { maxOffDrawingMm, machineOf } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { cases, IS_FULL } from "../../../support/runs/full-run.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { InterruptiblePlot, type Resumption } from "../../../support/plots/interruptions.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { RETRACED_DRAWINGS } from "../../../support/drawings/retraced-drawings.js";
import { sampleStrokes } from "../../../support/drawings/sample-strokes.js";
import { HOPS, penSettings } from "../../../support/machines/flying-pens.js";
import { inQuality, SPRINGS, swinging } from "../../../support/machines/swinging.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";
import { startAfter } from "../../../support/plots/start-after.js";

const SAMPLES = [
  "flower-meadow",
  "harmonograph",
  "hello-paper",
  "moonrise",
  "three-colour-hills",
  "whirling-triangles",
];
const DRAWINGS: readonly (readonly [string, () => Promise<StrokeSet>])[] = [
  ...Object.entries(RETRACED_DRAWINGS).map(
    ([name, strokes]) => [name, () => Promise.resolve(strokes)] as const,
  ),
  ...SAMPLES.map((name) => [name, () => sampleStrokes(name)] as const),
];
/** On each drawing. */
const INSTANTS = cases(250, 12);
/** The short run plots only the beginning. */
const LONGEST_S = IS_FULL ? Infinity : 10;

/** Rounded corners, and a pen that is lifted just before the end of a stroke. */
const UNSEEN_MM = 0.1;

const SHAPED: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  motion: inQuality("fast", SPRINGS[0]),
  machine: "axidraw-v3",
  customMachine: swinging(SPRINGS[0]),
};
/** The place of a shaped carriage along the line differs by up to as much from the pen's. */
const SHAPED_MM = 0.3;

/** More than the commands sent ahead, the braking and the lift take. */
const PAUSE_S = 0.9;

async function interruptedAnywhere(strokes: StrokeSet, settings: PlotSettings, firmware: string) {
  const random = seeded(strokes.xy.length);
  const plot = await InterruptiblePlot.begin(strokes, settings, firmware);
  const spanS = Math.min(plot.totalS, LONGEST_S);
  const instants = Array.from({ length: INSTANTS }, () => random() * spanS).sort((a, b) => a - b);
  const found: Resumption[] = [];
  let nowS = 0;
  for (const atS of instants) {
    await plot.advance(atS - nowS);
    nowS = atS;
    if (plot.isDone) break;
    found.push(plot.killed(), ...plot.disconnected());
  }
  return found;
}

/**
 * The most that is drawn again although the board's position is known. Two lines as near to each other as the carriage
 * may leave the drawing cannot be told apart, so beside a sharp corner the earlier one counts.
 */
const mostAlikeMm = (settings: PlotSettings, unseenMm: number): number =>
  unseenMm + 2 * maxOffDrawingMm(settings.motion, machineOf(settings));

const overlapOf = ({ missingMm }: Resumption): number => Math.max(0, -missingMm);

function check(found: readonly Resumption[], settings: PlotSettings, unseenMm: number): void {
  const { motion, sendAheadMs } = settings;
  const unsureS = sendAheadMs / 1_000 + JOURNAL_S + PROGRESS_S;
  const mostMm = motion.draw.speedMmPerS * unsureS + unseenMm;
  const alikeMm = mostAlikeMm(settings, unseenMm);
  expect(found.length).toBeGreaterThanOrEqual(INSTANTS);
  expect(found.filter(({ missingMm }) => missingMm > unseenMm)).toEqual([]);
  expect(found.filter((one) => overlapOf(one) > one.unsureMm + alikeMm)).toEqual([]);
  expect(found.filter((one) => overlapOf(one) > mostMm)).toEqual([]);
}

/** Killed at an instant from the request of a pause until after its lift. */
async function killedInPause(settings: PlotSettings, firmware: string, random: () => number) {
  const { world, driver, board } = await virtualPlotter({ firmware });
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await world.run(
    driver.plot(new LocalPlanner(FAULT_DRAWING), settings, { journal: { record } }),
  );
  while (journal.length === 0) await world.advance(0.05);
  await world.advance(0.5 + 5 * random());
  void run.pause().catch(() => undefined);
  await world.advance(PAUSE_S * random());
  const last = journal.at(-1);
  board.unplug();
  await world.run(run.finished.catch(() => undefined));
  await world.advance(5);
  const resumed = await world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), settings, startAfter(last)));
  await world.run(resumed.resume());
  expect(await world.run(resumed.finished)).toEqual({ kind: "done" });
  return compareDrawn(FAULT_DRAWING, board.drawn());
}

describe.each(["2.8.1", "3.0.3"])(
  "a plot on firmware %s that is killed during the braking of a pause",
  (firmware) => {
    it.each([
      ["", DEFAULT_PLOT_SETTINGS, UNSEEN_MM],
      [" in shaped motion", SHAPED, 2 * SHAPED_MM],
    ] as const)(
      "leaves nothing out and draws nothing twice%s",
      { timeout: 120_000 },
      async (_, settings, mostMm) => {
        const random = seeded(23);
        for (let i = 0; i < cases(100, 10); i++) {
          const { gapMm, overlapMm } = await killedInPause(settings, firmware, random);
          expect(gapMm).toBeLessThan(mostMm);
          expect(overlapMm).toBeLessThan(mostMm);
        }
      },
    );
  },
);

describe.each(["2.8.1", "3.0.3"])(
  "a plot on firmware %s that is interrupted as its first line begins",
  (firmware) => {
    it("draws nothing of that line twice", async () => {
      const plot = await InterruptiblePlot.begin(FAULT_DRAWING, DEFAULT_PLOT_SETTINGS, firmware);
      const found: Resumption[] = [];
      for (let i = 0; i < 60; i++) {
        found.push(plot.killed(), ...plot.disconnected());
        await plot.advance(0.02);
      }
      expect(found.length).toBeGreaterThan(80);
      expect(found.filter(({ missingMm }) => missingMm > UNSEEN_MM)).toEqual([]);
      expect(found.filter((one) => overlapOf(one) > UNSEEN_MM)).toEqual([]);
    });
  },
);

describe.each(["2.8.1", "3.0.3"])("a plot of short strokes on firmware %s", (firmware) => {
  it.each(["off", "safe", "fast"] as const)(
    "draws nothing twice after a kill until it is at home, with the pen's overlap %s",
    async (overlap) => {
      const plot = await InterruptiblePlot.begin(HOPS, penSettings(overlap), firmware);
      const found: Resumption[] = [];
      while (!plot.isDone) {
        found.push(plot.killed());
        await plot.advance(0.02);
      }
      expect(found.length).toBeGreaterThan(700);
      expect(found.filter(({ missingMm }) => Math.abs(missingMm) > 0.05)).toEqual([]);
    },
  );
});

describe.each(["2.8.1", "3.0.3"])("a plot on firmware %s that is interrupted at any instant", (firmware) => {
  it.each(DRAWINGS)("leaves out nothing of %s", { timeout: 300_000 }, async (_, strokes) => {
    const found = await interruptedAnywhere(await strokes(), DEFAULT_PLOT_SETTINGS, firmware);
    check(found, DEFAULT_PLOT_SETTINGS, UNSEEN_MM);
  });

  it.each(DRAWINGS.slice(0, IS_FULL ? undefined : 3))(
    "leaves out nothing of %s in shaped motion",
    { timeout: 300_000 },
    async (_, strokes) =>
      check(await interruptedAnywhere(await strokes(), SHAPED, firmware), SHAPED, SHAPED_MM),
  );
});
