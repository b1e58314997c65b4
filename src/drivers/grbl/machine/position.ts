/**
 * Where the carriage of one Grbl is, and what the Grbl keeps of it for the next connection. A carriage whose place is unknown
 * counts as at home.
 */
import { positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { FoundMidPlot, PenBefore } from "../../driver.js";
import type { GrblState } from "../grbl-job.js";
import { difference, type Axes } from "../model/planner.js";
import { hasRestarted, type Status } from "../protocol.js";
import { foundMidPlot, homeByMark, homeMark, keptRun, runByMark, type GrblMemory } from "./kept-home.js";
import type { GrblPen } from "./pen.js";
import type { GrblSession } from "./session.js";

export class GrblPosition {
  /**
   * Home in machine coordinates, mm; null: unknown. It is kept here and not in the Grbl, whose work offsets are the user's.
   */
  home: Axes | null = null;
  /** Where it rested last, in machine coordinates. */
  machineAt: Axes = [0, 0, 0];
  foundMidPlot: FoundMidPlot | null = null;
  /** `keptRun` of the unfinished plot that moved the carriage last; null if something else did. */
  run: number | null = null;

  constructor(
    private readonly session: GrblSession,
    private readonly pen: GrblPen,
    private readonly changed: () => void,
  ) {}

  inMm(profile: MachineProfile): { x: number; y: number } | null {
    const { stepsPerMm } = profile;
    if (!this.home) return null;
    const [x, y] = difference(this.machineAt, this.home);
    return positionFromMotors(profile, x * stepsPerMm, y * stepsPerMm);
  }

  stateFrom(home: Axes, profile: MachineProfile): GrblState {
    const { session, pen, machineAt } = this;
    const [x, y] = difference(home, session.offset);
    return {
      at: difference(machineAt, home),
      zero: [x, y, pen.zeroInWorkMm],
      limits: { ...session.settings.limitsFor(profile), isCore: session.plansMotors },
      queueMoves: session.queueMoves,
      arcToleranceMm: session.settings.arcToleranceMm,
    };
  }

  /** A Grbl that was not restarted still counts from the same place. Returns whether it does. */
  remember(status: Status, before: PenBefore | null, profile: MachineProfile): boolean {
    const { foundModes, settings } = this.session;
    const memory = hasRestarted(status) ? null : (before?.memory as GrblMemory | null | undefined);
    this.pen.zeroMm = memory?.penZeroMm ?? null;
    this.home = memory?.home ?? homeByMark(foundModes, status.machineAt, profile, settings);
    this.machineAt = status.machineAt;
    this.run = memory === null || memory === undefined ? runByMark(foundModes) : memory.run;
    this.changed();
    return Boolean(memory) || this.home !== null;
  }

  /** Whether an unfinished plot has left the carriage at a known place. */
  get isInPlot(): boolean {
    return this.home !== null && this.run !== null;
  }

  /** Call after `remember`. */
  foundWith(penUp: boolean, before: PenBefore | null): void {
    if (this.home === null || this.run === null) return;
    const memory = (before?.memory ?? {}) as Partial<GrblMemory>;
    this.foundMidPlot =
      memory.foundMidPlot === undefined
        ? foundMidPlot(penUp, this.run, this.session.isCutShort)
        : memory.foundMidPlot;
  }

  /**
   * Call with its number before a run of a plot moves the carriage. Call with null when it has ended, and before anything
   * else moves it.
   */
  async noteRun(number: number | null): Promise<void> {
    const run = number === null ? null : keptRun(number);
    if (run === this.run) return;
    this.run = run;
    await this.mark();
  }

  /** Tells the next connection where home is, as far as that is possible. */
  mark(): Promise<void> {
    const { session, pen, home, run } = this;
    return session.attempt(homeMark(pen.zeroMm === null ? home : null, run, session.settings));
  }

  async homeIsHere(): Promise<Axes> {
    const { machineAt } = await this.session.status();
    this.home = this.machineAt = machineAt;
    this.foundMidPlot = null;
    this.run = null;
    await this.mark();
    this.changed();
    return machineAt;
  }
}
