/** A Grbl whose lines and answers are lost, doubled or damaged on their way: nothing waits forever, nothing is left out. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { GrblSession } from "../../../../src/drivers/grbl/machine/session.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { LineFault } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import "../../../support/runs/fixed-seed.js";
import { cases } from "../../../support/runs/full-run.js";
import { GRBL } from "../../../support/machines/machine.js";
import { newMachine, newPlotter, SETTINGS, RefusedPlanner } from "../../../support/plots/grbl-plotter.js";
import { DRAWING, drawnMm } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { farthest, SegmentGrid } from "../../../support/drawings/segment-grid.js";

/** The drawing takes 13 s. */
const PLOT_S = 13;
const FAULTS: readonly LineFault[] = [
  "reply-lost",
  "reply-doubled",
  "reply-damaged",
  "line-end-lost",
  "refused",
];

const COMBINED: readonly (readonly LineFault[])[] = [
  ...FAULTS.map((fault) => [fault]),
  ["refused", "reply-lost"],
  ["refused", "reply-damaged"],
  ["reply-doubled", "refused"],
  ["reply-doubled", "reply-lost"],
];

/** Points of the drawing, 0.25 mm apart. */
function* points(): Iterable<readonly [number, number]> {
  const { xy, offsets } = DRAWING;
  for (let s = 0; s + 1 < offsets.length; s++) {
    for (let i = offsets[s]; i + 1 < offsets[s + 1]; i++) {
      const [x0, y0, x1, y1] = xy.subarray(2 * i, 2 * i + 4);
      const count = Math.ceil(4 * Math.hypot(x1 - x0, y1 - y0));
      for (let k = 0; k <= count; k++) yield [x0 + ((x1 - x0) * k) / count, y0 + ((y1 - y0) * k) / count];
    }
  }
}

/** Every point of the drawing is on a line that was drawn. */
function expectAllDrawn(board: VirtualGrbl): void {
  const drawn = new SegmentGrid(1);
  for (const { penDown, xy } of board.drawn()) if (penDown && xy.length > 2) drawn.addPolyline(xy);
  expect(farthest(points(), drawn)).toBeLessThan(0.02);
}

/** Plots, and disturbs the connection after `atS`. A plot that ends with an error is resumed as by a user. */
async function plotDisturbed(
  atS: number,
  disturb: (board: VirtualGrbl) => void,
  planner = new LocalPlanner(DRAWING),
) {
  const { world, board, driver, begin, within, mustWork } = await newPlotter();
  const entries: JournalEntry[] = [];
  const journal = { record: (entry: JournalEntry): void => void entries.push(entry) };
  const run = await begin(planner, { journal });
  await world.advance(atS);
  disturb(board);
  const first = await within(run.finished);
  // What was not disturbed by then stays undisturbed.
  for (const fault of FAULTS) board.spoil(fault, 0);
  const atEnd = { penUp: board.state().penUp, isHomeKnown: driver.state.xMm !== null };
  if (typeof first === "string") {
    // A lost connection is made again.
    await world.advance(8);
    if (driver.state.xMm === null) board.pushHome();
    const from = entries.at(-1)!.place;
    const rest = await begin(new LocalPlanner(DRAWING), { from, held: false, journal });
    expect(await within(rest.finished)).toEqual({ kind: "done" });
  }
  return { first, board, driver, atEnd, mustWork };
}

describe("a plot", { timeout: 120_000 }, () => {
  it.each(COMBINED.map((faults) => [faults.join(" and "), faults] as const))(
    "leaves nothing out and ends with the pen up, with this fault at any time: %s",
    async (_, faults) => {
      await fc.assert(
        fc.asyncProperty(
          fc.double({ min: 0.3, max: PLOT_S, noNaN: true }),
          fc.integer({ min: 1, max: 3 }),
          async (atS, count) => {
            const { first, board, atEnd, mustWork } = await plotDisturbed(atS, (one) => {
              for (const fault of faults) one.spoil(fault, count);
            });
            expect(atEnd.penUp).toBe(true);
            expectAllDrawn(board);
            if (typeof first === "string") expect(first).toMatch(/^board-(error|timeout): /);
            else expect(first).toEqual({ kind: "done" });
            const { lostCount } = board.state();
            // More than one answer too many may overflow the buffer.
            expect(lostCount > 0 && count === 1).toBe(false);
            await mustWork(lostCount);
          },
        ),
        { numRuns: cases(60, 8) },
      );
    },
  );

  it.each(["reply-lost", "reply-doubled", "reply-damaged"] as const)(
    "says that the answers are out of step, and keeps home: %s",
    async (fault) => {
      const { first, atEnd } = await plotDisturbed(3, (board) => board.spoil(fault));
      expect(first).toMatch(/^board-error: An answer of the Grbl was lost, damaged or doubled/);
      expect(atEnd).toEqual({ penUp: true, isHomeKnown: true });
    },
  );

  it("is drawn twice only where the answers are uncertain: within one stroke", async () => {
    const whole = await plotDisturbed(PLOT_S + 5, () => undefined);
    const { board } = await plotDisturbed(3, (one) => one.spoil("reply-lost"));
    const circleMm = 2 * Math.PI * 30;
    expect(drawnMm(board) - drawnMm(whole.board)).toBeLessThan(circleMm + 5);
  });

  it("is not held up by lines that mean nothing", async () => {
    for (const noise of [
      "",
      "k",
      "ok?",
      "<Idle|MPos:9.000,9.0",
      "<Run>",
      "[MSG:",
      "error",
      "\u007f\u007f",
      "ALARM",
    ]) {
      const { first, driver } = await plotDisturbed(2.5, (board) => board.say(noise));
      expect([noise, first]).toEqual([noise, { kind: "done" }]);
      expect(driver.state).toMatchObject({ xMm: 0, yMm: 0 });
    }
  });

  it.each([
    "ok",
    "error:20",
    "ALARM:1",
    "[GC:G1]",
    "Grbl 1.1h ['$' for help]",
    "<Alarm|MPos:0.000,0.000,0.000>",
  ])("leaves nothing out if noise looks like an answer: %s", async (noise) => {
    for (const atS of [1.4, 3, 8.6, 12]) {
      const { board, atEnd } = await plotDisturbed(atS, (one) => one.say(noise));
      expect(atEnd.penUp).toBe(true);
      expectAllDrawn(board);
    }
  });

  it("draws a line again that the Grbl refused, and keeps home although it cut the corner", async () => {
    const { first, atEnd, board } = await plotDisturbed(
      0.1,
      () => undefined,
      new RefusedPlanner(DRAWING, "G1X25Y45.5"),
    );
    expect(first).toMatch(/^board-error: The Grbl refused G5X1 with error:20/);
    expect(atEnd).toEqual({ penUp: true, isHomeKnown: true });
    expectAllDrawn(board);
  });

  it("lifts the pen although the Grbl refuses many lines in a row", async () => {
    const { first, atEnd } = await plotDisturbed(3, (board) => board.spoil("refused", 14));
    expect(first).toMatch(/^board-error: The Grbl refused/);
    expect(atEnd.penUp).toBe(true);
  });

  it("says that the pen is down if the Grbl refuses everything", async () => {
    const { world, board, begin, within } = await newPlotter();
    const run = await begin();
    await world.advance(3);
    board.spoil("refused", 10_000);
    expect(await within(run.finished)).toMatch(/error:20.* The pen could not be lifted: lift it by hand\./);
    expect(board.state().penUp).toBe(false);
  });

  it("is paused by the hold button of the machine", async () => {
    const { world, board, driver, begin, within } = await newPlotter();
    const run = await begin();
    await world.advance(3);
    board.pressHold();
    await world.advance(4);
    expect(driver.state.activity).toBe("held");
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    await world.run(run.resume());
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectAllDrawn(board);
  });
});

describe("a move by hand", () => {
  it.each(["reply-lost", "reply-damaged", "line-end-lost"] as const)(
    "never waits forever: %s",
    async (fault) => {
      for (let early = 0; early < 6; early++) {
        const { world, board, driver, within, mustWork } = await newPlotter();
        const move = driver.move({ kind: "move-to", xMm: 30, yMm: 20 });
        await world.advance(0.1 * early);
        board.spoil(fault);
        const outcome = await within(move);
        if (outcome !== undefined) expect(outcome).toMatch(/^board-(error|timeout): /);
        board.spoil(fault, 0);
        await world.advance(10);
        await mustWork();
      }
    },
  );

  it("waits for a long wait and a slow move", async () => {
    const { board, machine, world, within } = await newMachine();
    const session = (machine as unknown as { session: GrblSession }).session;
    expect(await within(session.send("G4P20"))).toBeUndefined();
    expect(await within(session.send("G1X2F60"))).toBeUndefined();
    const slow = session.send("G4P0");
    await world.advance(1);
    expect(board.state().state).toBe("Run");
    expect(await within(slow)).toBeUndefined();
    expect(board.state().xMm).toBe(2);
  });
});

describe("the receive buffer", () => {
  it.each([128, 127, 120])("a receive buffer of %d characters never overflows", async (rxBytes) => {
    const { board, begin, within } = await newPlotter({ rxBytes });
    const run = await begin();
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expect(board.state().lostCount).toBe(0);
    expectAllDrawn(board);
  });
});

describe("connecting", () => {
  it("does not execute the beginning of a line that was left unfinished", async () => {
    const world = new ManualClock();
    const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
    await board.transport().write(new TextEncoder().encode("G1X10F600"));
    const session = new GrblSession(board.transport(), world);
    expect(await world.run(session.identify())).toBe("Grbl 1.1h");
    await world.advance(3);
    expect(board.state().xMm).toBe(0);
    board.close();
  });

  it("survives a lost status report", async () => {
    const { machine, line, world, within } = await newMachine();
    line.isMute = true;
    const query = machine.ping!();
    await world.advance(0.1);
    line.isMute = false;
    expect(await within(query)).toBeUndefined();
    expect(await within(machine.moveTo(5, 6, SETTINGS))).toBeUndefined();
  });
});
