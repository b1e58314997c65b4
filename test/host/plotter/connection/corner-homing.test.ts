/** A machine with one switch in its corner, as a NextDraw: it finds home by itself, and says what keeps it from that. */
import fc from "fast-check";
import { describe, expect, it, vi } from "vitest";
import { driver as ebbDriver } from "../../../../src/drivers/ebb/driver.js";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { machineById, VirtualBoard, type StrokePosition } from "../../../../src/index.js";
import { findsHome, type Machine } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { NO_EVENTS } from "../../../support/machines/machine.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { outcome, virtualPlotter } from "../../../support/plots/virtual-plotter.js";
import { ascii } from "../../../support/plots/virtual-plots.js";
import { cases } from "../../../support/runs/full-run.js";

const MODELS = ["nextdraw-8511", "nextdraw-1117", "nextdraw-2234"] as const;
const settingsOf = (machine: string) => ({ ...DEFAULT_PLOT_SETTINGS, machine });

const newPlotter = (machine: string = MODELS[0], firmware = "3.0.3") =>
  virtualPlotter({ settings: settingsOf(machine), firmware });

/** Distance of the real carriage from its corner, mm. */
const offMm = (board: VirtualBoard): number => {
  const { xMm, yMm } = board.gantry!.carriage;
  return Math.hypot(xMm, yMm);
};

describe("a NextDraw", () => {
  const anywhere = fc.record({
    model: fc.constantFrom(...MODELS),
    firmware: fc.constantFrom("3.0.2", "3.0.3", "3.1.7"),
    // Also at the stop behind the switch.
    x: fc.oneof(fc.constant(-0.01), fc.double({ min: 0, max: 1, noNaN: true })),
    y: fc.oneof(fc.constantFrom(0, 1), fc.double({ min: 0, max: 1, noNaN: true })),
    phase1: fc.integer({ min: 0, max: 63 }),
    phase2: fc.integer({ min: 0, max: 63 }),
  });

  it("homes within 0.05 mm from anywhere", { timeout: 300_000 }, async () => {
    await fc.assert(
      fc.asyncProperty(anywhere, async ({ model, firmware, x, y, phase1, phase2 }) => {
        const { world, driver, board } = await newPlotter(model, firmware);
        const { widthMm, heightMm } = machineById(model);
        board.gantry!.push({ xMm: Math.max(-2, x * widthMm), yMm: y * heightMm }, phase1, phase2);
        await world.run(driver.home());
        expect(offMm(board)).toBeLessThan(0.05);
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, motorsOn: true });
        expect(driver.state).toMatchObject({ xMm: 0, yMm: 0, penUp: true, connection: "idle" });
        await driver.close();
      }),
      { numRuns: cases(100, 20) },
    );
  });
});

describe("a NextDraw that cannot home says what is wrong and what to do, and homes when that is mended:", () => {
  const far = { xMm: 120, yMm: 90 };

  /** Homes while `fault` is done `afterS` into it. Returns the outcome. */
  async function homingWith(
    fault: (board: VirtualBoard) => void,
    { afterS = 0, at = far, mend = () => undefined }: Fault = {},
  ): Promise<unknown> {
    const { world, driver, board } = await newPlotter();
    board.gantry!.push(at, 11, 50);
    const homed = outcome(driver.home());
    if (afterS > 0) await world.advance(afterS);
    fault(board);
    const ended = await world.run(homed);
    expect(driver.state).toMatchObject({ xMm: null, motorsOn: false, penUp: true });
    expect(board.state().motorsOn).toBe(false);
    mend(board);
    await world.advance(5);
    await world.run(driver.home());
    expect(offMm(board)).toBeLessThan(0.05);
    await driver.close();
    return ended;
  }

  interface Fault {
    readonly afterS?: number;
    readonly at?: { readonly xMm: number; readonly yMm: number };
    readonly mend?: (board: VirtualBoard) => void;
  }

  it.each([far, { xMm: 0, yMm: 0 }])("a switch that is not plugged in, from %o", async (at) => {
    const ended = await homingWith((board) => (board.gantry!.switchCondition = "absent"), {
      at,
      mend: (board) => (board.gantry!.switchCondition = "good"),
    });
    expect(ended).toMatch(/^board-error: Home was not found \(switch not detected\)\. .*B1.*chosen model/);
  });

  it("a switch that never opens", async () => {
    const ended = await homingWith((board) => (board.gantry!.switchCondition = "stuck"), {
      mend: (board) => (board.gantry!.switchCondition = "good"),
    });
    expect(ended).toMatch(/^board-error: Home was not found \(carriage blocked\)\. .*nothing is in its way/);
  });

  it.each([
    ["on its way", 80, 0],
    ["just before the switch", 3, 0],
    ["at the switch, after it was found", 2, 4.2],
  ])("a carriage that is blocked %s", async (_where, xMm, afterS) => {
    const ended = await homingWith((board) => (board.gantry!.obstacleMm = xMm), {
      afterS,
      mend: (board) => (board.gantry!.obstacleMm = -Infinity),
    });
    expect(ended).toMatch(/^board-error: Home was not found \(carriage blocked\)\. .*press Home again/);
  });

  it.each([0, 1])("no motor supply, since %i s", async (afterS) => {
    const ended = await homingWith((board) => board.setMotorVolts(5), {
      afterS,
      mend: (board) => board.setMotorVolts(9.1),
    });
    expect(ended).toMatch(/^board-error: Home was not found \(no motor supply\)\. .*plug in/);
  });

  it.each([0.5, 3, 5])("its button, pressed after %d s", async (afterS) => {
    const ended = await homingWith((board) => board.pressButton(), { afterS });
    expect(ended).toMatch(/^board-error: Home was not found \(button pressed\)\. .*press Home|Press Home/);
  });

  it.each([0.5, 1, 2.5, 3, 3.5, 4, 4.5, 5, 5.3])("its board, which restarted after %d s", async (afterS) => {
    const ended = await homingWith((board) => board.restart(), { afterS });
    expect(ended).toMatch(/^board-error: Home was not found \(board restarted\)\. .*Press Home again/);
  });
});

describe("homing a NextDraw", () => {
  it("gives up with words if the switch comes at another place in each pass", async () => {
    const { world, driver, board } = await newPlotter();
    const gantry = board.gantry!;
    gantry.push({ xMm: 30, yMm: 20 }, 11, 50);
    // Something holds the carriage back in each approach, where both motors turn, so that they slip.
    const setModes = gantry.setModes.bind(gantry);
    const slipping = vi.spyOn(gantry, "setModes").mockImplementation((mode1, mode2) => {
      gantry.obstacleMm = mode2 === 0 ? -Infinity : 3.5;
      setModes(mode1, mode2);
    });
    const ended = await world.run(outcome(driver.home()));
    slipping.mockRestore();
    gantry.obstacleMm = -Infinity;
    expect(ended).toMatch(
      /^board-error: Home was not found \(uneven readings\)\. .*belt is tight.*motors are off/,
    );
    expect(driver.state).toMatchObject({ xMm: null, motorsOn: false, penUp: true });
    await world.run(driver.home());
    expect(offMm(board)).toBeLessThan(0.05);
    await driver.close();
  });

  it("is announced if home was set by hand elsewhere and is lost; home set there again is used instead", async () => {
    const { world, driver, board } = await newPlotter();
    const elsewhere = { xMm: 100, yMm: 50 };
    board.gantry!.push(elsewhere);
    await world.run(driver.setHome());
    board.restart();
    expect(await world.run(outcome(driver.moveTo(10, 10)))).toMatch(
      /^board-error: The board restarted.*if home was set by hand elsewhere than in its corner, set it there again/,
    );
    board.gantry!.push(elsewhere);
    await world.run(driver.setHome());
    await world.run(driver.moveTo(10, 10));
    expect(board.gantry!.carriage.xMm).toBeCloseTo(110, 0);
    expect(board.gantry!.carriage.yMm).toBeCloseTo(60, 0);
  });

  /** A machine with these settings on a board that the test has made. */
  async function machineOn(world: ManualClock, board: VirtualBoard): Promise<Machine> {
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    return world.run(ebbDriver.identify(board.transport(), options));
  }

  it("ends with words if the chosen model is smaller than the machine", async () => {
    const world = new ManualClock();
    const board = new VirtualBoard({ clock: world, machine: machineById("nextdraw-2234") });
    board.gantry!.push({ xMm: 700, yMm: 500 });
    const machine = await machineOn(world, board);
    const settings = settingsOf("nextdraw-8511");
    await world.run(machine.readKeptState(settings, null));
    expect(await world.run(outcome(machine.homing!.seekHome(settings)))).toMatch(
      /^board-error: Home was not found \(wrong model\)\. .* more than 531 mm, .* NextDraw 8511 has\. Choose/,
    );
    await world.run(machine.homing!.seekHome(settingsOf("nextdraw-2234")));
    expect(offMm(board)).toBeLessThan(0.05);
  });

  it("stops at once when the user asks for it, and homes afterwards", async () => {
    const { world, driver, board } = await newPlotter();
    board.gantry!.push({ xMm: 250, yMm: 150 });
    const homed = outcome(driver.home());
    await world.advance(1.5);
    await world.run(driver.stopMove());
    expect(await world.run(homed)).toMatch(/^conflict: The move was stopped/);
    const { xMm } = board.gantry!.carriage;
    await world.advance(3);
    expect(board.gantry!.carriage.xMm).toBe(xMm);
    expect(driver.state).toMatchObject({ xMm: null, motorsOn: false, connection: "idle" });
    await world.run(driver.home());
    expect(offMm(board)).toBeLessThan(0.05);
  });

  it("is refused with words by a firmware that cannot stop at the switch; home can then be set by hand", async () => {
    const { world, driver } = await newPlotter(MODELS[0], "2.8.1");
    expect(await world.run(outcome(driver.home()))).toMatch(/^board-error: Firmware 2\.8\.1 cannot stop at/);
    await world.run(driver.moveTo(10, 10));
    expect(driver.state).toMatchObject({ xMm: 10, yMm: 10 });
  });

  it("comes before the first move, after the motors were off, and after a lost position", async () => {
    const { world, driver, board } = await newPlotter();
    const isAt = (xMm: number, yMm: number): void => {
      expect(board.gantry!.carriage.xMm).toBeCloseTo(xMm, 1);
      expect(board.gantry!.carriage.yMm).toBeCloseTo(yMm, 1);
    };
    await world.run(driver.moveTo(30, 20));
    isAt(30, 20);
    await world.run(driver.motorsOff());
    board.gantry!.push({ xMm: 200, yMm: 10 });
    await world.run(driver.moveTo(50, 60));
    isAt(50, 60);
    board.restart();
    const lost = await world.run(outcome(driver.moveTo(10, 10)));
    expect(lost).toMatch(/^board-error: The board restarted.*finds home by itself when you resume/);
    board.gantry!.push({ xMm: 90, yMm: 90 });
    await world.run(driver.moveTo(10, 10));
    isAt(10, 10);
  });

  it("does not follow when home is set by hand, where the carriage is", async () => {
    const { world, driver, board } = await newPlotter();
    board.gantry!.push({ xMm: 100, yMm: 50 });
    const { carriage } = board.gantry!;
    await world.run(driver.setHome());
    expect(board.gantry!.carriage.xMm).toBeCloseTo(carriage.xMm, 0);
    expect(driver.state).toMatchObject({ xMm: 0, yMm: 0 });
  });

  it("is not needed for a mirrored frame, whose corner is not at 0, 0: home is set by hand there", () => {
    expect(findsHome(machineById("nextdraw-8511"))).toBe(true);
    expect(findsHome({ ...machineById("nextdraw-8511"), swapAxes: true })).toBe(true);
    expect(findsHome({ ...machineById("nextdraw-8511"), flipX: true })).toBe(false);
    expect(findsHome(machineById("axidraw-v3"))).toBe(false);
  });
});

describe("a plot on a NextDraw", () => {
  const LINES = strokesOf([20, 20, 120, 20], [120, 60, 20, 60]);

  it("homes first, and after a lost position again when it is resumed: nothing to push, nothing displaced", async () => {
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, overlap: "off" } as const;
    const settings = { ...settingsOf("nextdraw-8511"), pen };
    const { world, driver, board } = await newPlotter();
    board.gantry!.push({ xMm: 140, yMm: 70 }, 20, 33);
    let place: StrokePosition = { stroke: 0, alongMm: 0 };
    const journal = { record: (entry: JournalEntry): void => void (place = entry.place) };
    const first = await world.run(driver.plot(new LocalPlanner(LINES), settings, { journal }));
    const ended = outcome(first.finished);
    while (place.stroke === 0 || place.alongMm < 20) await world.advance(0.1);
    board.restart();
    expect(await world.run(ended)).toMatch(/^board-error: .* finds home by itself when you resume/);
    board.gantry!.push({ xMm: 33, yMm: 180 }, 5, 61);
    const again = await world.run(driver.plot(new LocalPlanner(LINES), settings, { from: place }));
    await world.run(again.resume());
    expect(await world.run(again.finished)).toEqual({ kind: "done" });
    const down = board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 4);
    const [xs, ys] = [0, 1].map((axis) => down.flatMap(({ xy }) => [...xy].filter((_, i) => i % 2 === axis)));
    for (const y of ys) expect(Math.min(Math.abs(y - 20), Math.abs(y - 60))).toBeLessThan(0.05);
    expect(Math.min(...xs)).toBeCloseTo(20, 1);
    expect(Math.max(...xs)).toBeCloseTo(120, 1);
    expect(offMm(board)).toBeLessThan(0.05);
  });
});

describe("a homed NextDraw", () => {
  const settings = settingsOf("nextdraw-8511");
  const makeBoard = (world: ManualClock): VirtualBoard =>
    left(new VirtualBoard({ clock: world, machine: machineById("nextdraw-8511") }));
  const left = (board: VirtualBoard): VirtualBoard => {
    board.gantry!.push({ xMm: 40, yMm: 25 });
    return board;
  };
  const homeVariable = async (world: ManualClock, machine: Machine): Promise<readonly string[]> =>
    (await world.run(machine.console!.send("QL,12"))).replies;

  async function connected(world: ManualClock, board: VirtualBoard): Promise<Machine> {
    const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
    const machine = await world.run(ebbDriver.identify(board.transport(), options));
    await world.run(machine.readKeptState(settings, null));
    return machine;
  }

  it("stays homed across programs and restarts, and says so to the maker's software", async () => {
    const world = new ManualClock();
    const board = makeBoard(world);
    const first = await connected(world, board);
    expect(await homeVariable(world, first)).toEqual(["0", "OK"]);
    await world.run(first.moveTo(70, 40, settings));
    expect(await homeVariable(world, first)).toEqual(["1", "OK"]);
    await world.run(first.close());
    const second = await connected(world, board);
    expect(second.positionMm(machineById("nextdraw-8511"))).toEqual({ x: 70, y: 40 });
    await world.run(second.moveTo(10, 10, settings));
    expect(board.gantry!.carriage.xMm).toBeCloseTo(10, 1);
    await world.run(second.motorsOff());
    expect(await homeVariable(world, second)).toEqual(["0", "OK"]);
  });

  it("is used as it is after the maker's software has homed it, with coarser steps", async () => {
    const world = new ManualClock();
    const board = makeBoard(world);
    const first = await connected(world, board);
    await world.run(first.homing!.seekHome(settings));
    await world.run(first.close());
    // It homes, sets 1/8 steps and moves 60, 40 mm: x + y = 100 mm, x − y = 20 mm, at 40 steps/mm.
    send(board, "CU,10,1", "CU,4,16", "SC,8,1", "EM,2,2", "CS", "SL,1,12", "SL,7,24", "SM,2000,4000,800");
    await world.advance(3);
    const second = await connected(world, board);
    expect(second.positionMm(machineById("nextdraw-8511"))).toEqual({ x: 60, y: 40 });
    expect(second.foundMidPlot).toBeNull();
  });

  it("moves although other software still watches the switch, which is pressed at home", async () => {
    const world = new ManualClock();
    const board = makeBoard(world);
    const first = await connected(world, board);
    await world.run(first.homing!.seekHome(settings));
    await world.run(first.close());
    send(board, "CU,52,2", "CU,51,2");
    const second = await connected(world, board);
    await world.run(second.moveTo(30, 30, settings));
    expect(board.gantry!.carriage.xMm).toBeCloseTo(30, 1);
  });

  it.each([
    ["has switched one motor off", ["SL,1,12", "EM,1,0"]],
    ["has failed to home", ["EM,1,1", "SM,500,2000,2000", "SL,0,12"]],
  ])("is homed again after other software %s", async (_what, lines) => {
    const world = new ManualClock();
    const board = makeBoard(world);
    const first = await connected(world, board);
    await world.run(first.moveTo(70, 40, settings));
    await world.run(first.close());
    send(board, "CU,10,1", "CU,4,16", ...lines);
    await world.advance(2);
    const second = await connected(world, board);
    expect(second.state).toBeNull();
    await world.run(second.moveTo(30, 30, settings));
    expect(board.gantry!.carriage.xMm).toBeCloseTo(30, 1);
  });
});

const send = (board: VirtualBoard, ...lines: readonly string[]): void => {
  for (const line of lines) board.receive(ascii(`${line}\r`));
};
