/**
 * Every fault of a Grbl: the state in which a plot ends, its words, and what is on the paper after the plot was resumed.
 * Nothing is left out, nothing is drawn twice that could have been known, and nothing waits for ever.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { driver as grblDriver } from "../../../../src/drivers/grbl/driver.js";
import type { FaceName } from "../../../../src/drivers/grbl/virtual/faces.js";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import type { MachineProfile } from "../../../../src/index.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { GRBL, GRBL_SERVO, NO_EVENTS } from "../../../support/machines/machine.js";
import { ScriptedLine } from "../../../support/machines/scripted-line.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { machineWith, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { outcome } from "../../../support/plots/virtual-plotter.js";
import { cases, IS_FULL } from "../../../support/runs/full-run.js";
import { startAfter } from "../../../support/plots/start-after.js";

const GAP_MM = 0.05;
/** What is drawn twice at most if the place is known. */
const KNOWN_MM = 0.05;
/** If the place is lost, or an answer is missing, the plot resumes at the last rest: the longest stroke, and one short. */
const STROKE_MM = 131;
/** The same if all answers are missing for some time: two of the longest strokes. */
const SILENCE_MM = 230;
/** Each plot ends or is held within this time of its fault, s. */
const END_S = 20;
/** After that it is connected again, s. */
const REPAIR_S = 15;
/** The drawing takes longer than that, s. */
const PLOT_S = 9;

type World = Awaited<ReturnType<typeof newPlotter>>;

interface Row {
  readonly fault: (world: World) => void;
  /** "done": it does not notice. "held": as by a pause. Otherwise the words with which it is interrupted. */
  readonly ends: RegExp;
  readonly options?: VirtualGrblOptions;
  /** Whether the position is known at the end. */
  readonly keepsHome: boolean;
  readonly mostTwiceMm: number;
  /** What a person does then. */
  readonly repair?: (world: World) => void;
  /** The pen is up only after the repair. */
  readonly liftsLater?: boolean;
}

/** Rows with the same effects. */
const held = (fault: Row["fault"], ends = /^held$/): Row => ({
  fault,
  ends,
  keepsHome: true,
  mostTwiceMm: KNOWN_MM,
});
const unsure = (fault: Row["fault"], ends: RegExp): Row => ({
  fault,
  ends,
  keepsHome: true,
  mostTwiceMm: STROKE_MM,
});
const lost = (fault: Row["fault"], words: RegExp): Row => ({
  fault,
  ends: new RegExp(
    `^board-error: ${words.source}.*: push the carriage to home by hand before you resume\\.` +
      "( The height of the pen is lost, too: .* turn its Z axis by hand .*)?$",
  ),
  keepsHome: false,
  mostTwiceMm: STROKE_MM,
});

const OUT_OF_STEP =
  /^board-error: An answer of the Grbl was lost, damaged or doubled.* When it is resumed, .* Check the USB/;

const HOLDS: Readonly<Record<string, Row>> = {
  "another program sends !": held(({ board }) => board.takeFromOther("!")),
  "its hold button is pressed": held(({ board }) => board.pressHold()),
  "its hold and then its resume button are pressed": held(({ board, world }) => {
    board.pressHold();
    world.after(0.15, () => board.takeFromOther("~"));
  }, /^(held|done)$/),
  "its door is opened": {
    ...held(
      ({ board }) => board.setDoor(true),
      /^board-error: The Grbl's safety door is open.* Close the door: the pen is lifted then/,
    ),
    repair: ({ board }) => board.setDoor(false),
    liftsLater: true,
  },
  "its door is opened and closed at once": held(({ board }) => {
    board.setDoor(true);
    board.setDoor(false);
  }),
  "its door is opened and closed, and its resume button is pressed": {
    ...held(({ board, world }) => {
      board.setDoor(true);
      world.after(0.12, () => {
        board.setDoor(false);
        board.takeFromOther("~");
      });
    }, /^(held$|done$|board-error: The Grbl's safety door is open)/),
    liftsLater: true,
  },
  "another program stops it as a door does": held(({ board }) => board.takeFromOther("\x84")),
};

const OTHERS: Readonly<Record<string, Row>> = {
  "another program sends it to sleep": lost(
    ({ board }) => board.takeFromOther("$SLP"),
    /The Grbl no longer draws: it has gone to sleep.* Its position is lost/,
  ),
  "another program has it check lines": unsure(
    ({ board }) => board.takeFromOther("$C"),
    /^board-error: The Grbl no longer draws: another program has sent \$C.* End that program;/,
  ),
  "another program jogs": unsure(
    ({ board }) => board.takeFromOther("$J=G91X3F300"),
    /^board-error: The Grbl (no longer draws: another program moves it|refused \S+ with error:9 \(.*another program)/,
  ),
  "another program resets it": lost(
    ({ board }) => board.takeFromOther("\x18"),
    /The Grbl has (stopped with ALARM:3 \(the machine was reset during a motion\)|restarted)/,
  ),
  "its reset button is pressed": lost(
    ({ board }) => board.restart(),
    /The Grbl has restarted: its reset button was pressed, or its supply failed\./,
  ),
};

const LINES: Readonly<Record<string, Row>> = {
  "a line end is lost": unsure(
    ({ board }) => board.spoil("line-end-lost"),
    /^board-(error: (The Grbl refused|An answer)|timeout: The Grbl has not confirmed)/,
  ),
  "an answer is lost": unsure(({ board }) => board.spoil("reply-lost"), OUT_OF_STEP),
  "an answer is doubled": unsure(({ board }) => board.spoil("reply-doubled"), OUT_OF_STEP),
  "an answer is damaged": unsure(({ board }) => board.spoil("reply-damaged"), OUT_OF_STEP),
  "noise comes between the lines": held(({ board }) => board.say("\x7f\x01k>[<Ru"), /^done$/),
  "it is silent for 2 s": {
    ...unsure(({ world, setSilent }) => {
      setSilent(true);
      world.after(2, () => setSilent(false));
    }, /^(done|board-(error: An answer|timeout: The Grbl has not confirmed).* Check the USB cable)/),
    mostTwiceMm: SILENCE_MM,
  },
  "it is silent for good": {
    ...held(
      ({ setSilent }) => setSilent(true),
      /^board-timeout: The board has stopped answering .*check its USB cable and power/,
    ),
    repair: ({ setSilent }) => setSilent(false),
    liftsLater: true,
  },
};

const REFUSALS = [...Array.from({ length: 38 }, (_, i) => i + 1), 79];
/** Those without a meaning on a child of Grbl. */
const UNKNOWN: Readonly<Record<FaceName, readonly number[]>> = {
  "1.1": [18, 19, 79],
  "0.9": [18, 19, 79],
  DrawCore: [18, 19, 79],
  FluidNC: [19, 79],
  grblHAL: [],
};
const ADVICE =
  "\\. If that happens again, (check the machine's profile|switch off in the machine's profile that it draws arcs)";
const WITHOUT_REASON = new RegExp(ADVICE);
const WITH_REASON = new RegExp(` \\([a-zG].{8,}\\)${ADVICE}`);

const codesOf = (face: FaceName): Readonly<Record<string, Row>> =>
  Object.fromEntries([
    ...REFUSALS.map((code) => {
      const reason = UNKNOWN[face].includes(code) ? WITHOUT_REASON : WITH_REASON;
      const ends = new RegExp(`^board-error: The Grbl refused \\S+ with error:${code}${reason.source}`);
      const row = unsure(({ board }) => board.spoil("refused"), ends);
      return [`it refuses a line with error:${code}`, { ...row, options: { refusal: code } }];
    }),
    ...[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14].map((code) => [
      `it stops with ALARM:${code}`,
      lost(
        ({ board }) => board.stopWith(code),
        new RegExp(
          `The Grbl has stopped with ALARM:${code} \\([a-zG].{8,}\\)\\. Check the carriage's position`,
        ),
      ),
    ]),
    [
      "it stops with an alarm of its own",
      lost(({ board }) => board.stopWith(37), /The Grbl has stopped with ALARM:37\. /),
    ],
  ]);

/** Plots, with the fault after `atS`, and resumes as a person would. */
async function plotWith(row: Row, face: FaceName, ordinary: MachineProfile, atS: number) {
  const machine = machineWith({ face }, ordinary);
  const plotter = await newPlotter({ face, ...row.options }, machine);
  const { world, board, driver, begin } = plotter;
  const settings = { ...SETTINGS, customMachine: machine };
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const run = await begin(new LocalPlanner(FAULT_DRAWING), { journal: { record } }, settings);
  await world.advance(atS);
  row.fault(plotter);
  const isHeld = new Promise<string>((resolve) => run.onHeld((now) => now && resolve("held")));
  const isOver = outcome(run.finished.then(({ kind }) => kind));
  const ended = String(await world.run(Promise.race([isHeld, isOver]), END_S));
  const isUpAtEnd = board.state().penUp || row.liftsLater === true;
  row.repair?.(plotter);
  await world.advance(REPAIR_S);
  const { connection, xMm, penUp } = driver.state;
  const isUp = isUpAtEnd && board.state().penUp && penUp === true;
  if (xMm === null) board.pushHome();
  if (ended.includes("The height of the pen is lost")) board.pushPen(0);
  if (ended === "held") {
    await world.run(run.resume());
    await world.run(run.finished, 60);
  } else if (ended !== "done") {
    expect(connection).toBe("idle");
    const rest = await begin(
      new LocalPlanner(FAULT_DRAWING),
      { ...startAfter(journal.at(-1)), held: false },
      settings,
    );
    await world.run(rest.finished, 60);
  }
  expect(board.state()).toMatchObject({ state: "Idle", penUp: true, lostCount: 0 });
  const { gapMm, overlapMm } = compareDrawn(FAULT_DRAWING, board.drawn());
  const isWhole = gapMm <= GAP_MM && overlapMm <= row.mostTwiceMm;
  const isAsSaid = row.ends.test(ended) && (xMm !== null) === row.keepsHome;
  return { isRight: isUp && isWhole && isAsSaid, ended, isUp, xMm, gapMm, overlapMm };
}

/** Several instants of the plot. */
async function wrongOnes(name: string, row: Row, face: FaceName, machine: MachineProfile, count: number) {
  const random = seeded(9_973 * name.length);
  const wrong: unknown[] = [];
  for (let i = 0; i < count; i++) {
    const atS = 1 + (PLOT_S - 1) * random();
    const { isRight, ...result } = await plotWith(row, face, machine, atS);
    if (!isRight) wrong.push({ atS, ...result });
  }
  return wrong;
}

const FACES: readonly FaceName[] = ["1.1", "grblHAL", "FluidNC", "DrawCore"];
const MACHINES: readonly (readonly [string, MachineProfile])[] = [
  ["a Z axis", GRBL],
  ["a servo", GRBL_SERVO],
];

describe.each(MACHINES)("a plot with %s", { timeout: 60_000 }, (_, machine) => {
  describe.each(FACES)("on a %s", (face) => {
    it.each(Object.entries({ ...HOLDS, ...OTHERS, ...LINES }))("%s", async (name, row) => {
      expect(await wrongOnes(name, row, face, machine, cases(12, 2))).toEqual([]);
    });
  });
});

// The others say nothing while they seek their switches.
describe.each<FaceName>(["grblHAL", "FluidNC"])("a plot on a %s", { timeout: 60_000 }, (face) => {
  it("another program homes it", async () => {
    const row = lost(
      ({ board }) => board.takeFromOther("$H"),
      /The Grbl no longer draws: another program has sent it to its switches\. Its position is lost/,
    );
    expect(await wrongOnes("homed", row, face, GRBL, cases(12, 2))).toEqual([]);
  });
});

describe.each(IS_FULL ? FACES : FACES.slice(0, 1))("a plot on a %s", { timeout: 60_000 }, (face) => {
  it.each(Object.entries(codesOf(face)))("%s", async (name, row) => {
    expect(await wrongOnes(name, row, face, GRBL, cases(6, 1))).toEqual([]);
  });
});

describe("another device on the port", () => {
  it.each([
    ["an EiBotBoard", (line: string) => `!8 Err: Unknown command '${line.slice(0, 2)}:3F'\r\n`],
    ["a modem", (line: string) => `${line}\r\r\nERROR\r\n`],
    ["a 3D printer with Marlin", (line: string) => `echo:Unknown command: "${line}"\nok\n`],
    ["a GPS receiver", () => "$GPGGA,,,,,,0,00,99.99,,,,,,*48\r\n"],
    ["something at another baud rate", () => "\xf8\x80\x00x\xfe\x1c"],
  ])("%s is named as another one, with what it says", async (_, answer) => {
    const line = new ScriptedLine(answer, "\n");
    const world = new ManualClock();
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    const words = await outcome(world.run(grblDriver.identify(line, options), END_S));
    expect(words).toMatch(
      /^no-board: Something answers on this port, but it is not a Grbl: choose another device, or another machine\./,
    );
    expect(line.closed).toBe(true);
  });

  it("nothing at all is told apart from it", async () => {
    const world = new ManualClock();
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    const words = await outcome(world.run(grblDriver.identify(new ScriptedLine(), options), END_S));
    expect(words).toMatch(
      /^board-timeout: Nothing answers on this port: check that it is the plotter's port/,
    );
  });
});
