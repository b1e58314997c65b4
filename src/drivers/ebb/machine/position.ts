/**
 * The position of one board's carriage, in steps from home. The board's counters start at 0 whenever its motors are
 * switched on; `origin` is the position at that moment. Home is where the carriage is when the motors are switched on
 * after it was moved by hand, or where a machine with switches finds it.
 */
import { PlotwrightError } from "../../../errors.js";
import { positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type { FoundMidPlot } from "../../driver.js";
import type { MachineSettings } from "../../machine-job.js";
import { delay } from "../../transport.js";
import type { BoardState } from "../compile/command-stream.js";
import { setUpCommands } from "../protocol/commands.js";
import { ebbOf } from "../protocol/ebb-controller.js";
import { parseSteps } from "../protocol/replies.js";
import type { Connection } from "./connection.js";
import { PositionMarker } from "./position-marker.js";

/** How long a newly connected board may keep moving. */
const REST_S = 2;
const REST_POLL_S = 0.05;

export class EbbPosition {
  /** The board's state from which the next stream is compiled; null while the position is unknown. */
  state: BoardState | null = null;
  origin: readonly [number, number] = [0, 0];
  motorsOn: boolean | null = null;
  /** The pen of a board that was left in the middle of a plot, as found when connecting; null after the first move. */
  foundMidPlot: FoundMidPlot | null = null;
  readonly mark: PositionMarker;
  /** The motors' microsteps while their position is known. */
  private microstepMode = 0;
  /** Home is where the machine's own switch is. */
  private isHomed = false;

  constructor(
    private readonly connection: Connection,
    private readonly changed: () => void,
  ) {
    this.mark = new PositionMarker(connection.session, connection.features);
  }

  /** mm from home; null if unknown. */
  mm(machine: MachineProfile): { x: number; y: number } | null {
    const share = this.shareOf(machine);
    return this.state && positionFromMotors(machine, this.state.steps1 * share, this.state.steps2 * share);
  }

  /** Whether a board that was connected again still counts from home, because it was not restarted. */
  async isKept(): Promise<boolean> {
    const { mode, isHomed } = await this.mark.markedMode();
    this.microstepMode = mode;
    this.isHomed = isHomed;
    return this.microstepMode !== 0;
  }

  /** Reads the motors' counters after something other than the plan has moved them. `restForS`: board seconds to wait. */
  async readBack(restForS?: number): Promise<void> {
    const { session, features } = this.connection;
    this.foundMidPlot = null;
    await this.untilAtRest(restForS);
    if (!features.hasStepQuery) {
      this.state = null;
      this.changed();
      throw positionUnknown();
    }
    const [steps1, steps2] = parseSteps(await session.query("QS"), this.origin);
    if (features.hasClear) {
      // The accumulators cannot be read. This clears them and adds one tick at the lowest rate, so both are 1.
      await session.send("LT,1,1,0,1,0,3");
      this.state = { steps1, steps2, acc1: 1, acc2: 1 };
    } else {
      await session.send("CS");
      this.origin = [steps1, steps2];
      this.state = { steps1, steps2, acc1: 0, acc2: 0 };
    }
    this.changed();
  }

  /**
   * The same after something that is no plot has moved the motors, if the position was known and can be read. Otherwise
   * forgets it and returns false.
   */
  async readBackOrForget(restForS: number): Promise<boolean> {
    this.mark.noteRun(null);
    if (this.state && this.connection.features.hasStepQuery && !(await this.mark.isGone())) {
      await this.readBack(restForS);
      return true;
    }
    // The next move begins where the carriage comes to rest.
    await this.untilAtRest(restForS);
    await this.forget();
    return false;
  }

  /** Waits until the motors rest: a board that was left during a plot still plays its queue, possibly a long move. */
  async untilAtRest(limitS: number = REST_S * this.connection.waitSpeed): Promise<void> {
    const { session, boardClock } = this.connection;
    const untilS = boardClock.nowS() + limitS;
    for (;;) {
      const moving = /[1-9]/.test(await session.query("QM", 1));
      if (!moving || boardClock.nowS() > untilS) return;
      await delay(boardClock, REST_POLL_S);
    }
  }

  /**
   * Switches the motors on if they are off, or to another microstep mode, which also zeroes their counters.
   * Returns the carriage's position.
   */
  async switchOn(settings: MachineSettings): Promise<BoardState> {
    const { state, microstepMode } = this;
    const { session, features } = this.connection;
    const machine = machineOf(settings);
    const wanted = ebbOf(machine).microstepMode;
    if (state && microstepMode === wanted) return state;
    for (const line of setUpCommands(machine, settings.pen, features.version)) await session.send(line);
    const share = state ? this.shareOf(machine) : 0;
    const [steps1, steps2] = [
      Math.round((state?.steps1 ?? 0) * share),
      Math.round((state?.steps2 ?? 0) * share),
    ];
    this.microstepMode = wanted;
    this.origin = [steps1, steps2];
    if (!state) this.isHomed = false;
    await this.mark.set(wanted, steps1 === 0 && steps2 === 0, this.isHomed);
    this.motorsOn = true;
    this.state = { steps1, steps2, acc1: 0, acc2: 0 };
    this.changed();
    return this.state;
  }

  /** Steps of the machine's microstep mode in one of the board's, which another program may have set. */
  private shareOf(machine: MachineProfile): number {
    // Each mode has half as many steps as the one before.
    return this.microstepMode === 0 ? 1 : 2 ** (this.microstepMode - ebbOf(machine).microstepMode);
  }

  /** Makes the current position home. The motors must be on. */
  async setHome(): Promise<void> {
    const { session, features } = this.connection;
    const { steps1, steps2, acc1, acc2 } = this.state!;
    this.foundMidPlot = null;
    this.isHomed = false;
    if (features.hasStepQuery) {
      await session.send("CS");
      this.origin = [0, 0];
      this.state = { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };
      await this.mark.set(this.microstepMode, true, false);
    } else {
      this.origin = [this.origin[0] - steps1, this.origin[1] - steps2];
      this.state = { steps1: 0, steps2: 0, acc1, acc2 };
    }
    this.changed();
  }

  /** The machine's own switch has found home, and the carriage is there. The motors must be on. */
  async foundHome(settings: MachineSettings): Promise<void> {
    await this.connection.session.send("CS");
    this.origin = [0, 0];
    this.microstepMode = ebbOf(machineOf(settings)).microstepMode;
    this.motorsOn = true;
    this.isHomed = true;
    await this.readBack();
    await this.mark.set(this.microstepMode, true, true);
  }

  /** Switches the motors off, so that the carriage can be moved by hand. */
  async motorsOff(): Promise<void> {
    await this.mark.clear();
    await this.connection.session.send("EM,0,0");
    this.motorsOn = false;
    this.foundMidPlot = null;
    this.state = null;
    this.changed();
  }

  /** Call if the motors were without power or something else moved the carriage: it may be anywhere. */
  async forget(): Promise<void> {
    this.state = null;
    this.foundMidPlot = null;
    this.motorsOn = null;
    await this.mark.clear();
    this.changed();
  }
}

const positionUnknown = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "This firmware cannot report the position of its motors. Set home again, then resume from the stroke.",
  );
