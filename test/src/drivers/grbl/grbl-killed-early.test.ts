/**
 * A plot on a Grbl that is killed or unplugged soon after it was resumed from elsewhere, before the journal says what the Grbl
 * had received: it goes on where it stopped. And the number by which a Grbl tells runs of plots apart.
 */
import { describe, expect, it, vi } from "vitest";
import type { JournalEntry, PlotStart } from "../../../../host/plotter/plotter-port.js";
import { BoardSettings } from "../../../../src/drivers/grbl/machine/board-settings.js";
import { homeMark, runByMark, keptRun } from "../../../../src/drivers/grbl/machine/kept-home.js";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import type { StrokeSet } from "../../../../src/index.js";
import { machineOf, MIN_RUN } from "../../../../src/internal.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { mmOf } from "../../../support/drawings/stop-truth.js";
import { newPlotter, plotterOn, settingsWith } from "../../../support/plots/grbl-plotter.js";
import { startAfter } from "../../../support/plots/start-after.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { cases } from "../../../support/runs/full-run.js";

const MOST_MM = 0.05;
/** How many runs a Grbl tells apart. */
const RUN_COUNT = 80;
/** What a Grbl's buffers hold is drawn by then. */
const REST_S = 15;
/** The second interruption comes at most this long after the resumption. */
const EARLY_S = 0.6;
const FACES: readonly VirtualGrblOptions[] = [
  { face: "1.1" },
  { face: "grblHAL" },
  { face: "FluidNC" },
  { face: "DrawCore" },
];

/** Short lines side by side, drawn there and back. */
const hatching = (mm: number): StrokeSet =>
  strokesOf(
    ...Array.from({ length: 40 }, (_, i) => {
      const [x, y] = [30 + 2 * i, 20];
      return i % 2 === 0 ? [x, y, x, y + mm] : [x, y + mm, x, y];
    }),
  );

type How = "killed" | "unplugged";
/** What happens before the plot is resumed the first time. */
type Way = "is moved back" | "is killed, and the carriage goes home";

interface Interrupted {
  readonly gapMm: number;
  readonly overlapMm: number;
}

/** Interrupted `earlyS` after it was resumed, which was after `atS`. */
async function interruptedEarly(
  how: How,
  way: Way,
  options: VirtualGrblOptions,
  { strokes, atS, earlyS }: { strokes: StrokeSet; atS: number; earlyS: number },
): Promise<Interrupted> {
  const settings = settingsWith(options);
  const entries: JournalEntry[] = [];
  const journal = { record: (entry: JournalEntry): void => void entries.push(entry) };
  const { world, board, ...first } = await newPlotter(options);
  const nextProcess = () => plotterOn(board, world, machineOf(settings));
  const begin = (plotter: Pick<typeof first, "begin">, start: PlotStart = {}) =>
    plotter.begin(new LocalPlanner(strokes), { ...start, journal }, settings);

  let plotter = first;
  let run = await begin(first);
  run.finished.catch(() => undefined);
  await world.advance(atS);
  await world.run(run.pause());
  if (way === "is moved back") run.moveHoldPlace({ strokes: -4 });
  if (way === "is killed, and the carriage goes home") {
    plotter.kill();
    plotter = await nextProcess();
    await world.run(plotter.driver.move({ kind: "move-to", xMm: 0, yMm: 0 }));
    const left = entries.at(-1);
    run = await begin(plotter, startAfter(left));
    run.finished.catch(() => undefined);
  }
  await world.run(run.resume());
  await world.advance(earlyS);

  const atKill = entries.at(-1)!;
  if (how === "unplugged") plotter.line().unplug();
  else plotter.kill();
  await world.advance(REST_S);
  const last = how === "unplugged" ? entries.at(-1)! : atKill;
  if (how === "killed") plotter = await nextProcess();
  expect(plotter.driver.state.xMm).not.toBeNull();
  const resumed = await begin(plotter, { ...startAfter(last), held: false });
  expect(await world.run(resumed.finished)).toEqual({ kind: "done" });
  return compareDrawn(strokes, board.drawn());
}

async function wrongOnes(
  how: How,
  way: Way,
  options: VirtualGrblOptions,
  isRight: (result: Interrupted) => boolean,
): Promise<unknown[]> {
  const wrong: unknown[] = [];
  const count = cases(24, 4);
  for (const mm of [2, 5, 10]) {
    for (let i = 0; i < count; i++) {
      const earlyS = (EARLY_S * (i + 0.5)) / count;
      const plot = { strokes: hatching(mm), atS: 3 + 0.13 * i, earlyS };
      const { gapMm, overlapMm } = await interruptedEarly(how, way, options, plot);
      if (!isRight({ gapMm, overlapMm })) wrong.push({ mm, earlyS, gapMm, overlapMm });
    }
  }
  return wrong;
}

const isExact = ({ gapMm, overlapMm }: Interrupted): boolean => gapMm <= MOST_MM && overlapMm <= MOST_MM;
const isWhole = ({ gapMm }: Interrupted): boolean => gapMm <= MOST_MM;

describe.each(FACES)("a plot of short lines on $face that is resumed", { timeout: 300_000 }, (options) => {
  describe.each<How>(["killed", "unplugged"])("and is soon %s", (how) => {
    it("goes on where it stopped if it came from home", async () => {
      const way = "is killed, and the carriage goes home";
      expect(await wrongOnes(how, way, options, isExact)).toEqual([]);
    });

    // On its way back the carriage passes the ends of other lines, which may be drawn twice then.
    it("leaves nothing out if it was moved back", async () => {
      expect(await wrongOnes(how, "is moved back", options, isWhole)).toEqual([]);
    });
  });
});

it("a plot is never taken for the one that was left on the Grbl, also if their numbers are alike", async () => {
  const strokes = hatching(10);
  const { world, board, ...first } = await newPlotter();
  const killedAfter = async ({ begin, kill }: Pick<typeof first, "begin" | "kill">, s: number) => {
    const entries: JournalEntry[] = [];
    await begin(new LocalPlanner(strokes), { journal: { record: (entry) => void entries.push(entry) } });
    await world.advance(s);
    kill();
    const entry = entries.at(-1)!;
    await world.advance(REST_S);
    return { entry, next: await plotterOn(board, world) };
  };
  // The Grbl keeps the same of these two numbers.
  const alike = [MIN_RUN, MIN_RUN + RUN_COUNT];
  const random = vi.spyOn(Math, "random");
  try {
    random.mockReturnValueOnce(0);
    const one = await killedAfter(first, 3);
    random.mockReturnValueOnce(RUN_COUNT / MIN_RUN);
    const other = await killedAfter(one.next, 5);
    expect(alike.map(keptRun)).toEqual([keptRun(one.entry.run!), keptRun(one.entry.run!)]);
    expect(mmOf(strokes, other.entry.place)).toBeGreaterThan(mmOf(strokes, one.entry.place));
    const resumed = await other.next.begin(new LocalPlanner(strokes), startAfter(one.entry));
    expect(resumed.holdPlace).toEqual(one.entry.place);
  } finally {
    random.mockRestore();
  }
});

describe("the mark of a Grbl", () => {
  const AT_SWITCHES = [-299, -199, 0] as const;
  const settings = new BoardSettings();
  ["$22=1", "$23=3", "$27=1", "$130=300", "$131=200"].forEach((line) => settings.take(line));

  it("is a tool number that each Grbl takes, and tells home and many runs apart", () => {
    const marks = [[0, 0, 0] as const, AT_SWITCHES].flatMap((home) =>
      [null, ...Array.from({ length: 200 }, (_, i) => keptRun(MIN_RUN + i))].map((run) => {
        const mark = homeMark(home, run, settings);
        expect(Number(mark.slice(1))).toBeLessThanOrEqual(255);
        expect(runByMark(`[GC:G0 G54 ${mark} F0 S0]`)).toBe(run);
        return mark;
      }),
    );
    expect(new Set(marks).size).toBe(2 * (1 + RUN_COUNT));
  });

  it.each([0, 1, 72, 255])("is none of T%s", (tool) => {
    expect(runByMark(`[GC:G0 G54 T${tool} F0 S0]`)).toBeNull();
  });
});
