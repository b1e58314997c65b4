/** A plotter whose machine has a virtual Grbl, on a manual clock and over a connection that a test can disturb. */
import { expect } from "vitest";
import { PlotterConnection } from "../../../host/plotter/plotter-connection.js";
import type { PlotStart, RunningPlot } from "../../../host/plotter/plotter-port.js";
import { driver as grblDriver } from "../../../src/drivers/grbl/driver.js";
import { VirtualGrbl } from "../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { VirtualGrblOptions } from "../../../src/drivers/grbl/virtual/virtual-settings.js";
import type { PlannedPlot, PlanRequest } from "../../../host/planning/planning.js";
import {
  PlotwrightError,
  type Clock,
  type MachineProfile,
  type StrokeSet,
  type Transport,
} from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import { GRBL, NO_EVENTS, withoutArcs } from "../machines/machine.js";
import { DRAWING } from "./live-plot.js";
import { LocalPlanner } from "./local-planner.js";
import { ManualClock } from "../clocks/manual-clock.js";
import { outcome } from "./virtual-plotter.js";

/** Settings for a machine with a Grbl. */
export const SETTINGS: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };
const settingsOf = (machine: MachineProfile): PlotSettings => ({ ...SETTINGS, customMachine: machine });
/** The profile of a machine that has one of Grbl's children. */
export const machineWith = ({ face }: VirtualGrblOptions, machine: MachineProfile = GRBL): MachineProfile =>
  face === "DrawCore" ? withoutArcs(machine) : machine;
export const settingsWith = (options: VirtualGrblOptions): PlotSettings => settingsOf(machineWith(options));
/** Longer than any of these takes, s. */
export const LIMIT_S = 60;

/** A connection that a test can cut, or keep from being heard. */
class WeakLine implements Transport {
  isMute = false;
  /** Nothing reaches the board. */
  isDeaf = false;
  /** Time until a reply is read, s. */
  lateS = 0;
  /** What the cable carries to the board. */
  bytesPerS = Infinity;
  /** The host does not run for this part of each second, s. */
  stalledS = 0;
  private sentS = 0;
  private lost: (error?: Error) => void = () => undefined;
  private isLost = false;

  constructor(
    private readonly line: Transport,
    private readonly clock: Clock,
  ) {}

  write(bytes: Uint8Array): Promise<void> {
    if (this.isDeaf) return Promise.resolve();
    if (!this.isLost) return this.sendTimed(bytes);
    return Promise.reject(new PlotwrightError("disconnected", "The cable is unplugged."));
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.line.onData((bytes) => {
      if (this.isMute || this.isLost) return;
      const lateS = Math.max(this.lateS, this.stalledS - (this.clock.nowS() % 1));
      if (lateS > 0) this.clock.after(lateS, () => listener(bytes));
      else listener(bytes);
    });
  }

  onClose(listener: (error?: Error) => void): void {
    this.lost = listener;
    this.line.onClose(listener);
  }

  close(): Promise<void> {
    return this.line.close();
  }

  private sendTimed(bytes: Uint8Array): Promise<void> {
    if (this.bytesPerS === Infinity) return this.line.write(bytes);
    const nowS = this.clock.nowS();
    this.sentS = Math.max(nowS, this.sentS) + bytes.length / this.bytesPerS;
    this.clock.after(this.sentS - nowS, () => void this.line.write(bytes));
    return Promise.resolve();
  }

  unplug(): void {
    this.isLost = true;
    this.lost(new Error("unplugged"));
  }
}

/** `options`: what differs from an ordinary Grbl. */
export async function newPlotter(options: VirtualGrblOptions = {}, machine = machineWith(options)) {
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine }, options);
  return { world, board, ...(await plotterOn(board, world, machine)) };
}

/** Without the questions before the Grbl's settings are read: one of them is refused by all but a DrawCore. */
export const logOfPlot = (driver: PlotterConnection): string => driver.log().split("> $$").at(-1)!;

/** A process that plots on a Grbl, which may have been left by another. */
export async function plotterOn(board: VirtualGrbl, world: ManualClock, machine: MachineProfile = GRBL) {
  const lines: WeakLine[] = [];
  const line = (): WeakLine => lines[lines.length - 1];
  let isDead = false;
  let isSilent = false;
  const open = (): Promise<Transport> => {
    if (isDead) return Promise.reject(new PlotwrightError("no-board", "The process is dead."));
    lines.push(new WeakLine(board.transport(), world));
    line().isMute = isSilent;
    return Promise.resolve(line());
  };
  const driver = new PlotterConnection({
    device: "a port",
    clock: world,
    settings: settingsOf(machine),
    devices: { find: () => Promise.resolve([]), open },
  });
  await world.run(driver.start());
  const begin = async (
    planner = new LocalPlanner(DRAWING),
    start: PlotStart = {},
    settings = settingsOf(machine),
  ) => world.run(driver.plot(planner, settings, start));
  const within = <T>(work: Promise<T>): Promise<unknown> => outcome(world.run(work, LIMIT_S));
  /** Nothing is heard of the board, also after connecting again. */
  const setSilent = (silent: boolean): void => {
    line().isMute = isSilent = silent;
  };
  /** As kill -9 does: nothing is sent any more. */
  const kill = (): void => {
    isDead = line().isDeaf = line().isMute = true;
  };
  /** It is connected again if necessary, and still works. */
  const mustWork = async (lostCount = 0): Promise<void> => {
    await world.advance(5);
    expect(driver.state).toMatchObject({ connection: "idle", activity: "none" });
    const [before, known] = [board.state(), driver.state];
    expect(await within(driver.move({ kind: "move-to", xMm: 12, yMm: 13 }))).toBeUndefined();
    const { xMm, yMm, ...rest } = board.state();
    expect(rest).toMatchObject({ state: "Idle", penUp: true, lostCount });
    // If its position was lost, it was at home. A stop leaves it between two steps.
    expect(xMm).toBeCloseTo(before.xMm + 12 - (known.xMm ?? 0), 1);
    expect(yMm).toBeCloseTo(before.yMm + 13 - (known.yMm ?? 0), 1);
    expect(driver.state).toMatchObject({ xMm: expect.closeTo(12, 1), yMm: expect.closeTo(13, 1) });
    expect(driver.state.penUp).toBe(true);
  };
  return { driver, begin, within, line, setSilent, kill, mustWork };
}

type GrblPlotter = Pick<
  Awaited<ReturnType<typeof newPlotter>>,
  "world" | "board" | "driver" | "line" | "within"
>;

/** Its cable is pulled out while the pen is down, and it is connected again. */
export async function cutOff(
  { world, board, driver, line, within }: GrblPlotter,
  run: RunningPlot,
): Promise<void> {
  await world.advance(3);
  expect(board.state().penUp).toBe(false);
  line().unplug();
  expect(await within(run.finished)).toMatch(/^disconnected/);
  await world.advance(5);
  expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
}

export async function newMachine(options: VirtualGrblOptions = {}) {
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL }, options);
  const line = new WeakLine(board.transport(), world);
  const lost: string[] = [];
  const events = { ...NO_EVENTS, lost: ({ code }: PlotwrightError) => void lost.push(code) };
  const machine = await world.run(
    grblDriver.identify(line, { clock: world, machineClock: world, speed: 1, events }),
  );
  await world.run(machine.readKeptState(SETTINGS, null));
  const within = <T>(work: Promise<T>): Promise<unknown> => outcome(world.run(work, LIMIT_S));
  return { world, board, line, machine, lost, within };
}

/** Its plans have one line that the Grbl refuses, by its index or its text. */
export class RefusedPlanner extends LocalPlanner {
  constructor(
    strokes: StrokeSet,
    private readonly refused: number | string,
  ) {
    super(strokes);
  }

  override async plan(request: PlanRequest): Promise<PlannedPlot> {
    const plot = await super.plan(request);
    const { lines } = plot.commands as unknown as { lines: string[] };
    lines[typeof this.refused === "number" ? this.refused : lines.indexOf(this.refused)] = "G5X1";
    return plot;
  }
}
