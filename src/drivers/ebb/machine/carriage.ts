/**
 * The carriage and pen of one connected board: their position, and the operations that move them.
 *
 * Positions are absolute steps from home. The board's counters start at 0 whenever its motors are switched on; `origin`
 * is the position at that moment. An AxiDraw has no limit switches: home is where the carriage is when the motors are
 * switched on after it was moved by hand.
 */
import { PlotwrightError } from "../../../errors.js";
import { placeFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import { sFromTicks } from "../../../units.js";
import type { MachineEvents, PenBefore, SupplyState } from "../../driver.js";
import { boardRestarted, moveStopped, powerFailed, powerLost, stuck } from "../../faults.js";
import type { MachineSettings, PlannedPlot } from "../../machine-job.js";
import { delay } from "../../transport.js";
import { streamOf, type BoardState } from "../compile/command-stream.js";
import { planEbbMoveTo } from "../compile/ebb-job.js";
import { MAX_TICKS } from "../compile/leg.js";
import { penCommand, penMoveOf, penSetUpCommands, setUpCommands } from "../protocol/commands.js";
import { ebbOf, STANDARD_PIN } from "../protocol/ebb-controller.js";
import { queueDepthOf } from "../protocol/firmware.js";
import { parseSteps } from "../protocol/replies.js";
import { boardStateBefore } from "../stream/cut-streams.js";
import type { StreamReport } from "../stream/stream-types.js";
import { maxAheadS, Streamer } from "../stream/streamer.js";
import { AdvanceWatch } from "./advance-watch.js";
import { CertainPlace, type CertainAt } from "./certain-place.js";
import type { Connection } from "./connection.js";
import { PlaceMark } from "./place-mark.js";
import {
  isButtonPressed,
  isPowerLow,
  MotorSupply,
  pollLines,
  SUPPLY_LINES,
  SupplyPolls,
} from "./readings.js";

/** Allowance for the connection, the board and this computer. */
const ANSWER_MS = 30;
/** Interval at which the board's button and queue are polled during a plot. */
const POLL_S = 0.25;
/** The same for the supply, if the board does not notice its failures by itself. */
const SUPPLY_S = 0.05;
/** Tolerated overrun of the planned time, seconds of this computer. */
const STUCK_S = 2;
/** How long a newly connected board may keep moving. */
const STILL_S = 2;

/** The board begins, and so ends, this much after the command was written. */
const SETTLE_S = 0.02;
/** Time for a servo to move from end to end and settle. */
const SERVO_MS = 400;

export class Carriage {
  penUp: boolean | null = null;
  penMoving = false;
  motorsOn: boolean | null = null;
  /** The pen of a board that was left in the middle of a plot, as found when connecting; null after the first move. */
  left: { readonly penUp: boolean } | null = null;
  /** Underruns of all streams on this connection. */
  underrunCount = 0;

  stopCount = 0;
  private playing: Streamer | null = null;
  private hasRestarted = false;
  private origin: readonly [number, number] = [0, 0];
  /** The board's state from which the next stream is compiled. */
  state: BoardState | null = null;
  /** The motors' microsteps while their position is known. */
  private microstepMode = 0;
  private readonly mark: PlaceMark;
  readonly motorSupply: MotorSupply;
  private readonly queueDepth: number;

  constructor(
    readonly connection: Connection,
    private readonly events: MachineEvents,
  ) {
    const { session, features } = connection;
    this.mark = new PlaceMark(session, features);
    this.motorSupply = new MotorSupply(session, features, (state) => this.events.supplyRead(state));
    this.queueDepth = queueDepthOf(features);
  }

  /** Called after connecting. A board that was not restarted still has the position in its counters. */
  async takeOver(settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const { features } = this.connection;
    if (features.hasStepQuery) await this.untilStill();
    const reportsPen = ebbOf(machineOf(settings)).servoPin === STANDARD_PIN;
    const penUp = reportsPen ? await this.liftWhereLeft() : before?.penUp === true;
    if (!reportsPen && before !== null && !penUp) await this.movePen(true, settings);
    // Before `configure`, which begins a new watch.
    if (features.hasSupplyLatch && (await this.motorSupply.hasFailed())) await this.mark.clear();
    await this.configure();
    this.microstepMode = await this.mark.markedMode();
    if (this.microstepMode !== 0) {
      // The board does not report such a pen, and an earlier program may have left it on the paper.
      if (!reportsPen && before === null) await this.movePen(true, settings);
      await this.findPlace();
      this.motorsOn = true;
    }
    // A carriage at home may have been brought there by hand since the plot, so its place says nothing about the plot.
    const isHome = this.state?.steps1 === 0 && this.state.steps2 === 0;
    if (this.state && !(penUp && isHome)) this.left = { penUp };
  }

  /** Sets what the board forgets when it restarts. */
  private async configure(): Promise<void> {
    const { session, features } = this.connection;
    if (this.queueDepth > 1) await session.send(`CU,4,${this.queueDepth}`);
    if (features.hasSupplyLatch) await this.motorSupply.watch();
  }

  /**
   * Lifts a pen that was left on the paper, where it would bleed. The board still has the plot's up height. Returns
   * whether the pen was up.
   */
  private async liftWhereLeft(): Promise<boolean> {
    const { session } = this.connection;
    const penUp = Number(await session.query("QP")) === 1;
    if (!penUp) await session.send(`SP,1,${SERVO_MS}`, SERVO_MS / 1000);
    return penUp;
  }

  /** Reads back the motors' position after something other than the plan has moved them. */
  async findPlace(stillS?: number): Promise<void> {
    const { session, features } = this.connection;
    this.left = null;
    await this.untilStill(stillS);
    if (!features.hasStepQuery) {
      this.state = null;
      this.events.changed();
      throw placeUnknown();
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
    this.events.changed();
  }

  /**
   * The same if the position was known and can be read; otherwise forgets it and returns false. `stillS`: board seconds
   * to wait for rest.
   */
  async findPlaceAgain(stillS: number): Promise<boolean> {
    if (this.state && this.connection.features.hasStepQuery && !(await this.mark.isGone())) {
      await this.findPlace(stillS);
      return true;
    }
    // The next move begins where the carriage comes to rest.
    await this.untilStill(stillS);
    await this.forgetPlace();
    return false;
  }

  /** Waits until the motors rest: a board that was left during a plot still plays its queue, possibly a long move. */
  private async untilStill(limitS: number = STILL_S * this.connection.waitSpeed): Promise<void> {
    const { session, boardClock } = this.connection;
    const untilS = boardClock.nowS() + limitS;
    for (;;) {
      const moving = /[1-9]/.test(await session.query("QM", 1));
      if (!moving || boardClock.nowS() > untilS) return;
      await delay(boardClock, 0.05);
    }
  }

  /**
   * Switches the motors on if they are off, or to another microstep mode, which also zeroes their counters.
   * Returns the carriage's position.
   */
  async ready(settings: MachineSettings): Promise<BoardState> {
    const machine = machineOf(settings);
    const { state, microstepMode } = this;
    const wanted = ebbOf(machine).microstepMode;
    // It may have restarted, or its supply may have failed, while it was at rest, when nothing is polled.
    if (state && (await this.mark.isGone())) return this.placeLost(boardRestarted(), settings);
    const { session, features } = this.connection;
    // Asked also while the position is unknown: a failure before this does not concern the motion after it.
    const supply = features.hasSupplyLatch ? await this.motorSupply.state() : "good";
    const why = supply === "low" ? powerLost() : powerFailed();
    if (state && supply !== "good") return this.placeLost(why, settings);
    if (state && microstepMode === wanted) return state;
    for (const line of setUpCommands(machine, settings.pen, features.version)) await session.send(line);
    // Each mode has half as many steps as the one before.
    const share = state ? 2 ** (microstepMode - wanted) : 0;
    const [steps1, steps2] = [
      Math.round((state?.steps1 ?? 0) * share),
      Math.round((state?.steps2 ?? 0) * share),
    ];
    this.microstepMode = wanted;
    this.origin = [steps1, steps2];
    await this.mark.set(wanted, steps1 === 0 && steps2 === 0);
    this.motorsOn = true;
    this.state = { steps1, steps2, acc1: 0, acc2: 0 };
    this.events.changed();
    return this.state;
  }

  /** mm from home; null if unknown. */
  place(machine: MachineProfile): { x: number; y: number } | null {
    return this.state ? placeFromMotors(machine, this.state.steps1, this.state.steps2) : null;
  }

  /**
   * How long the motors may keep running after an emergency stop. A board with a queue of one command reads nothing
   * while the queue is full, so it plays everything that was sent ahead before it reads the stop.
   */
  emergencyStopMs({ sendAheadMs }: MachineSettings): number {
    if (this.queueDepth > 1) return ANSWER_MS;
    const windowS = sendAheadMs / 1_000 + (this.connection.boardClock.latenessS?.() ?? 0);
    return Math.round(1_000 * maxAheadS(windowS, sFromTicks(MAX_TICKS))) + ANSWER_MS;
  }

  /** For the log that users send with a report. */
  noteEmergencyStop(settings: MachineSettings): void {
    const { session, features } = this.connection;
    const takesMs = this.emergencyStopMs(settings);
    session.log.add("note", `emergency stop: takes up to ${takesMs} ms on firmware ${features.version}`);
  }

  /** `certain` is called with each place that the board certainly reached with its motors powered. */
  streamer(settings: MachineSettings, certain: (at: CertainAt) => void = () => undefined): Streamer {
    const { session, features, boardClock, speed, waitSpeed } = this.connection;
    const watch = new AdvanceWatch(boardClock, waitSpeed);
    const lines = pollLines(features, this.mark.query);
    const lastLine = lines[lines.length - 1];
    const places = new CertainPlace(features, this.origin, lastLine);
    const supply = new SupplyPolls(session, features, lastLine);
    const streamer = new Streamer(session, {
      clock: boardClock,
      windowS: (settings.sendAheadMs / 1_000) * speed,
      queueDepth: this.queueDepth,
      poll: { lines, everyS: POLL_S * speed },
      between: features.hasSupplyLatch ? undefined : { lines: SUPPLY_LINES, everyS: SUPPLY_S * speed },
      stuckS: STUCK_S * waitSpeed,
      liftLine: penCommand(machineOf(settings), penMoveOf(settings.pen, true), 0),
      origin: this.origin,
      onPoll: (line, reply, asked) => {
        const failure = supply.answered(line, reply);
        if (line === this.mark.query && Number(reply) === 0) void this.checkRestart(streamer);
        else {
          const at = places.answered(line, reply, asked, streamer);
          if (at && !failure) certain(at);
        }
        if (failure === "failed") this.events.supplyRead(failure);
        if (line !== "QS") this.polled(line, reply);
        else if (streamer.playing && watch.isStalled(reply, asked, streamer.place()))
          streamer.stopAtOnce(stuck());
      },
    });
    return streamer;
  }

  /** Call when a poll reports that the mark is gone. */
  private async checkRestart(streamer: Streamer): Promise<void> {
    const isGone = await this.mark.isGone().catch(() => false);
    if (!isGone || !streamer.playing) return;
    this.hasRestarted = true;
    streamer.stopAtOnce(boardRestarted());
  }

  /** After the position is lost: lifts the pen and switches the motors off, so that the carriage can be pushed home. */
  async release(settings: MachineSettings): Promise<void> {
    await this.untilStill();
    await this.configure();
    await this.movePen(true, settings);
    await this.motorsOff();
  }

  private async placeLost(why: PlotwrightError, settings: MachineSettings): Promise<never> {
    this.state = null;
    await this.release(settings).catch(() => undefined);
    throw why;
  }

  /** Plays a plan on a streamer of this carriage, to its end or to a cut. */
  async play(streamer: Streamer, plot: PlannedPlot, settings: MachineSettings): Promise<StreamReport> {
    const start = this.state!;
    this.left = null;
    this.motorsOn = true;
    this.penUp = null;
    this.playing = streamer;
    try {
      const report = await streamer.play(streamOf(plot.commands));
      this.state = boardStateBefore(report.end.stream, report.end.commandIndex + 1, start);
      if (!report.exact) this.misplaced(report);
      return report;
    } catch (error) {
      if (!canFindPlace(streamer, error)) this.state = null;
      else if (this.state && (await this.mark.isGone().catch(() => false))) this.hasRestarted = true;
      if (!this.hasRestarted) throw error;
      this.hasRestarted = false;
      return await this.placeLost(boardRestarted(), settings);
    } finally {
      this.playing = null;
      this.underrunCount += streamer.underrunCount;
      this.events.changed();
    }
  }

  /** Lifts the pen and moves in a straight line to a position, at travel speed. */
  async moveTo(x: number, y: number, settings: MachineSettings): Promise<void> {
    const machine = machineOf(settings);
    const { stopCount } = this;
    await this.ready(settings);
    if (this.penUp !== true) await this.movePen(true, settings);
    // A stop before the carriage moves has no stream to stop.
    if (this.stopCount !== stopCount) throw moveStopped();
    const from = this.place(machine)!;
    const { version } = this.connection.features;
    const job = planEbbMoveTo(from, { x, y }, settings, machine, version, this.state!);
    const { trajectory } = job;
    if (trajectory.blockCount > 0) await this.perform({ trajectory, commands: job.commands() }, settings);
  }

  async perform(plot: PlannedPlot, settings: MachineSettings): Promise<void> {
    const streamer = this.streamer(settings);
    try {
      await this.play(streamer, plot, settings);
    } catch (error) {
      if (this.state && canFindPlace(streamer, error)) await this.findPlace();
      throw error;
    }
    this.penIs(true);
  }

  /** Clears the board's queue. The current move rejects with `conflict`, and the position is read back. */
  stopAtOnce(): void {
    this.stopCount++;
    this.playing?.stopAtOnce(moveStopped());
  }

  /** Before the connection is closed during motion: stops and lifts the pen. */
  async stopAndLift(settings: MachineSettings): Promise<void> {
    this.stopAtOnce();
    await this.untilStill();
    await this.movePen(true, settings);
  }

  /** Lifts or lowers the pen outside a plot; resolves when it has arrived. */
  async movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    const { session, boardClock } = this.connection;
    const machine = machineOf(settings);
    const pct = heightPct ?? (up ? settings.pen.upPct : settings.pen.downPct);
    const pen = { ...settings.pen, ...(up ? { upPct: pct } : { downPct: pct }) };
    const move = penMoveOf(pen, up);
    this.penIs(up, true);
    try {
      for (const line of penSetUpCommands(machine, pen)) await session.send(line);
      await session.send(penCommand(machine, move), move.timeMs / 1000);
      await delay(boardClock, move.timeMs / 1000 + SETTLE_S);
    } catch (error) {
      this.penIs(null);
      throw error;
    }
    this.penIs(up);
  }

  /** Moves to a raw position, 1/12 µs, as fast as the servo can; whether that is up or down is then unknown. */
  async moveServo(pos: number, settings: MachineSettings): Promise<void> {
    const { session, boardClock } = this.connection;
    await session.send(`S2,${pos},${ebbOf(machineOf(settings)).servoPin},0,${SERVO_MS}`, SERVO_MS / 1000);
    await delay(boardClock, SERVO_MS / 1000 + SETTLE_S);
    this.penIs(null);
  }

  /** Null: something else has moved the pen. */
  penIs(up: boolean | null, isMoving = false): void {
    this.penUp = up;
    this.penMoving = isMoving;
    this.events.changed();
  }

  /** Switches the motors off, so that the carriage can be moved by hand. Its position is then unknown. */
  async motorsOff(): Promise<void> {
    await this.mark.clear();
    await this.connection.session.send("EM,0,0");
    this.motorsOn = false;
    this.left = null;
    this.state = null;
    this.events.changed();
  }

  /** Makes the current position home. */
  async setHome(settings: MachineSettings): Promise<void> {
    await this.ready(settings);
    const { session, features } = this.connection;
    const { steps1, steps2, acc1, acc2 } = this.state!;
    this.left = null;
    if (features.hasStepQuery) {
      await session.send("CS");
      this.origin = [0, 0];
      this.state = { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };
      await this.mark.set(this.microstepMode, true);
    } else {
      this.origin = [this.origin[0] - steps1, this.origin[1] - steps2];
      this.state = { steps1: 0, steps2: 0, acc1, acc2 };
    }
    this.events.changed();
  }

  /** Call if the motors were without power or something else moved the carriage: it may be anywhere. */
  async forgetPlace(): Promise<void> {
    this.state = null;
    this.left = null;
    this.motorsOn = null;
    await this.mark.clear();
    this.events.changed();
  }

  supply(): Promise<SupplyState> {
    return this.motorSupply.state();
  }

  /** Handles the answers that arrive while a stream plays. */
  private polled(line: string, reply: string): void {
    if (isButtonPressed(line, reply)) this.events.buttonPressed();
    if (line === "QC") this.events.supplyRead(isPowerLow(line, reply) ? "low" : "good");
  }

  private misplaced(report: StreamReport): never {
    const end = report.end;
    const expected = `${end.stream.steps1[end.commandIndex]}, ${end.stream.steps2[end.commandIndex]}`;
    throw new PlotwrightError(
      "board-error",
      `The board's motors are at ${report.steps1}, ${report.steps2} steps instead of ${expected}: it was reset ` +
        "or moved by another program. Set home again before the next plot.",
    );
  }
}

/**
 * True if the motion ended early but the counters still give the position: it was stopped on purpose, or a
 * command was refused.
 */
const canFindPlace = (streamer: Streamer, error: unknown): boolean =>
  streamer.refused.length > 0 || (error instanceof PlotwrightError && error.code === "conflict");

const placeUnknown = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "This firmware cannot report the position of its motors. Set home again, then resume from the stroke.",
  );
