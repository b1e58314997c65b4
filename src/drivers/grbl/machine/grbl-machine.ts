/** One connected Grbl: where its carriage and pen are, and what moves them. A carriage whose place is unknown counts as at home. */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type {
  ConnectOptions,
  ConsoleAnswer,
  FoundMidPlot,
  HeightPart,
  Machine,
  Playback,
  PenBefore,
  PlaybackRequest,
} from "../../driver.js";
import { moveStopped } from "../../faults.js";
import type { MachineSettings, MachineState, PlannedPlot } from "../../machine-job.js";
import { MoveSignal, moveTo } from "../../move-to.js";
import type { Clock } from "../../transport.js";
import { MODES } from "../grbl-file.js";
import { grblCommandsOf, planGrblJob, type GrblCommands } from "../grbl-job.js";
import { findsHome } from "../model/grbl-controller.js";
import { penLiftOf } from "../model/pen-lift.js";
import {
  doorOpen,
  hasRestarted,
  heldError,
  HOME,
  isAtDoor,
  isLocked,
  isSleeping,
  locked,
  needsReset,
  noSwitches,
  NOT_LIFTED,
  type Status,
} from "../protocol.js";
import { endLeft } from "./braking.js";
import { sendTyped } from "./console.js";
import type { GrblMemory } from "./kept-home.js";
import { GrblPlayback } from "./grbl-playback.js";
import { isHeightLost, leftPen } from "./left-pen.js";
import { LineStream } from "./line-stream.js";
import { GrblPen } from "./pen.js";
import { GrblPosition } from "./position.js";
import type { GrblSession } from "./session.js";
import { unlock } from "./unlock.js";

/** Allowance for the connection, the board and this computer. */
const STOP_MS = 30;

export class GrblMachine implements Machine {
  readonly homing = { seekHome: (settings: MachineSettings): Promise<boolean> => this.seekHome(settings) };
  readonly console = { send: (line: string): Promise<ConsoleAnswer> => this.sendLine(line) };
  stopSignal = new MoveSignal();
  motorsOn: boolean | null = null;
  /** What the user should know about it, in words; null: nothing. */
  note: string | null = null;
  /** That of the latest settings. */
  private profile: MachineProfile | null = null;
  private isAsleep = false;
  private isHoming = false;
  /** Only the user may unlock it. */
  private isLocked = false;
  /** What keeps it locked although it was to be unlocked: its door, its emergency stop …; null: nothing. */
  private lockedBy: PlotwrightError | null = null;
  /** Its open door or its emergency stop lets nothing move. */
  private isBarred = false;
  private byHand: LineStream | null = null;
  readonly height: HeightPart;
  private readonly pen: GrblPen;
  private readonly position: GrblPosition;

  constructor(
    readonly session: GrblSession,
    readonly firmware: string,
    private readonly options: ConnectOptions,
  ) {
    const changed = (): void => options.events.changed();
    this.height = this.pen = new GrblPen(session, changed);
    this.position = new GrblPosition(session, this.pen, changed);
  }

  get clock(): Clock {
    return this.options.machineClock;
  }

  get speed(): number {
    return this.options.speed;
  }

  get penUp(): boolean | null {
    return this.pen.isUp;
  }

  get penMoving(): boolean {
    return this.pen.isMoving;
  }

  get foundMidPlot(): FoundMidPlot | null {
    return this.position.foundMidPlot;
  }

  get state(): MachineState | null {
    const { position, profile } = this;
    const { home } = position;
    return this.session.failure || !home || !profile ? null : position.stateFrom(home, profile);
  }

  get memory(): GrblMemory {
    const { pen, isBarred } = this;
    const { home, run } = this.position;
    const foundMidPlot = isBarred ? this.foundMidPlot : undefined;
    return { home, penZeroMm: pen.zeroMm, isHeightUnsure: pen.isUnsure, foundMidPlot, run };
  }

  positionMm(profile: MachineProfile): { x: number; y: number } | null {
    return this.position.inMm(profile);
  }

  /** Stops motion that was left, reads the Grbl's settings, and lifts the pen if it may be on the paper. */
  async readKeptState(settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const { session } = this;
    session.isCutShort = (await endLeft(session)) || session.isCutShort;
    const profile = this.use(settings);
    await session.readSettings();
    this.note = session.settings.slowerThan(profile);
    await session.tryCheck();
    await session.readOffset();
    // Again, because only now the units are known.
    const status = await session.status();
    const isKept = !isLocked(status.state) && this.position.remember(status, before, profile);
    this.pen.isUnsure = !findsHome(profile) && isHeightLost(this.pen.liftOf(profile), before, isKept);
    await this.recovered(status);
    if (this.lockedBy) throw this.lockedBy;
    if (!this.isLocked) await this.liftLeft(status, settings, before);
  }

  async prepareMotors(settings: MachineSettings): Promise<MachineState> {
    const profile = this.use(settings);
    penLiftOf(profile);
    this.session.settings.mustReport(this.firmware);
    // The Grbl locks itself when it is woken, because the carriage may have been pushed. It counts as at home then.
    if (this.isAsleep) await this.recovered(await this.session.reset(), true);
    this.isAsleep = false;
    await this.mustNotBeHeld();
    const { position } = this;
    if (position.home === null) await this.seekHome(settings);
    await this.mustBeUnlocked();
    const home = position.home ?? (await position.homeIsHere());
    this.motorsOn = true;
    this.options.events.changed();
    return position.stateFrom(home, profile);
  }

  async movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    if (this.isAsleep) await this.prepareMotors(settings);
    await this.mustBeUnlocked();
    await this.pen.move(up, settings, heightPct);
  }

  /** Lifts the pen after a fault; returns the error to report. */
  async liftAfter(error: PlotwrightError, settings: MachineSettings): Promise<PlotwrightError> {
    try {
      await this.movePen(true, settings);
      return error;
    } catch (failure) {
      const why = failure instanceof PlotwrightError ? ` ${failure.message}` : "";
      // The pen is lifted when the machine is connected again.
      if (this.session.failure && !this.lockedBy) return error;
      const words = `${error.message}${this.lockedBy ? "" : ` ${NOT_LIFTED}`}${why}`;
      return new PlotwrightError(error.code, words, { cause: error });
    }
  }

  moveTo(xMm: number, yMm: number, settings: MachineSettings): Promise<void> {
    return moveTo(this, planGrblJob, { xMm, yMm }, settings);
  }

  async perform({ commands }: PlannedPlot, settings: MachineSettings): Promise<void> {
    const { stopSignal } = this;
    await this.noteRun(null);
    stopSignal.throwIfAborted();
    const stream = this.stream(grblCommandsOf(commands), (state) => stream.slowDown(heldError(state)));
    this.byHand = stream;
    try {
      await stream.play();
      await this.arrived();
    } catch (error) {
      await this.recover(stream, settings, null);
      throw error instanceof PlotwrightError ? await this.liftAfter(error, settings) : error;
    } finally {
      this.byHand = null;
    }
  }

  /** See `GrblPosition`. */
  async noteRun(run: number | null): Promise<void> {
    if (run !== null) this.pen.isUnsure = false;
    await this.position.noteRun(run);
  }

  /** Called after a job has been played to its end. */
  async arrived(): Promise<void> {
    this.position.machineAt = (await this.session.status()).machineAt;
    // Each layer may have its own height.
    this.pen.setState(true);
    this.options.events.changed();
  }

  /** False if the profile has no switches; nothing moves then. */
  private async seekHome(settings: MachineSettings): Promise<boolean> {
    const { session, stopSignal } = this;
    const profile = machineOf(settings);
    if (!findsHome(profile)) return false;
    if (!session.settings.hasHoming) throw noSwitches();
    // A Z axis is brought to its switch first. Any other pen must not be dragged: the user has asked for the lock to go.
    const needsLift = !this.isLocked || this.pen.liftOf(profile).kind !== "z";
    if (this.isLocked && needsLift) await this.recovered(await session.status(), true);
    this.isAsleep = false;
    if (needsLift) await this.movePen(true, settings);
    stopSignal.throwIfAborted();
    this.isHoming = true;
    try {
      await session.send(HOME);
    } finally {
      this.isHoming = false;
    }
    await this.recovered(await session.status());
    this.pen.foundSwitch();
    await this.position.homeIsHere();
    await this.movePen(true, settings);
    return true;
  }

  async setHome(settings: MachineSettings): Promise<void> {
    await this.prepareMotors(settings);
    await this.position.homeIsHere();
  }

  async motorsOff(): Promise<void> {
    if (!this.isAsleep) await this.session.send("$SLP");
    this.isAsleep = true;
    this.motorsOn = false;
    await this.forgetPosition();
  }

  forgetPosition(): Promise<void> {
    this.position.home = this.position.foundMidPlot = null;
    if (!this.isAsleep && !this.isLocked) this.position.mark().catch(() => undefined);
    this.options.events.changed();
    return Promise.resolve();
  }

  async liftAndFreeMotors(settings: MachineSettings): Promise<void> {
    await this.movePen(true, settings);
    await this.motorsOff();
  }

  async stopAndLift(settings: MachineSettings): Promise<void> {
    this.stopAtOnce();
    await this.recovered(await this.session.reset());
    await this.movePen(true, settings);
  }

  stopAtOnce(): void {
    this.stopSignal.aborted = true;
    this.stopSignal = new MoveSignal();
    this.byHand?.stop(moveStopped());
    if (this.isHoming) this.stopHoming().catch(() => undefined);
  }

  async ping(): Promise<void> {
    await this.session.status();
  }

  emergencyStopMs(): number {
    return STOP_MS;
  }

  private async stopHoming(): Promise<void> {
    await this.forgetPosition();
    await this.recovered(await this.session.reset());
  }

  private async sendLine(line: string): Promise<ConsoleAnswer> {
    const answer = await sendTyped(this.session, line);
    if (answer.note !== null) {
      this.pen.setState(null);
      await this.forgetPosition();
    }
    return answer;
  }

  log(): string {
    return this.session.log.text();
  }

  startPlayback(request: PlaybackRequest): Playback {
    return new GrblPlayback(this, request);
  }

  close(): Promise<void> {
    return this.session.close();
  }

  stream(
    commands: GrblCommands,
    onHeld: (state: string) => void = () => this.options.events.buttonPressed(),
  ): LineStream {
    this.session.settings.mustPerform(commands.lines, this.session.offset, this.position.machineAt);
    this.motorsOn = true;
    this.position.foundMidPlot = null;
    this.pen.setState(null);
    return new LineStream(this.session, commands, this.clock, onHeld);
  }

  /** Call after a play that did not reach its end: Grbl then accepts moves again. `penUp`: as it was at the end. */
  async recover(stream: LineStream, settings: MachineSettings, penUp: boolean | null): Promise<boolean> {
    const status = await stream.cleared();
    if (stream.isBroken) this.position.home = null;
    await this.recovered(status);
    // Its greeting may have been lost.
    if (this.isLocked || !hasRestarted(status)) return true;
    return this.pen.countFrom(penUp, settings);
  }

  /** Without homing, a lock has no other purpose than to be acknowledged. */
  private get mayUnlock(): boolean {
    return this.session.isLockOurs || !this.session.settings.hasHoming;
  }

  /** Call after a reset: restores the modes that the lines need, and takes over the reported position. */
  private async recovered({ state, machineAt }: Status, mayUnlock = this.mayUnlock): Promise<void> {
    this.pen.setState(null);
    this.position.machineAt = machineAt;
    this.isLocked = isLocked(state) && !mayUnlock;
    this.lockedBy = null;
    this.options.events.changed();
    // It takes no lines.
    if (this.isLocked || isAtDoor(state)) return;
    if (isLocked(state)) {
      this.lockedBy = await unlock(this.session);
      this.isLocked = this.lockedBy !== null;
      if (this.isLocked) return;
    }
    // If they are refused, so is the next move.
    await this.session.attempt(MODES);
    await this.position.mark();
  }

  private use(settings: MachineSettings): MachineProfile {
    this.profile = machineOf(settings);
    this.session.findsHome = findsHome(this.profile);
    return this.profile;
  }

  /** Ends a hold that is not ours. Throws if the door is open. */
  private async mustNotBeHeld(): Promise<void> {
    const { state } = await this.session.status();
    if (!needsReset(state)) return;
    if (isSleeping(state)) this.position.home = null;
    const left = await this.session.reset();
    await this.recovered(left);
    if (isAtDoor(left.state)) throw this.stoppedBy(doorOpen());
  }

  /** Throws if the Grbl is still locked; the user may have unlocked it meanwhile. */
  private async mustBeUnlocked(): Promise<void> {
    await this.mustNotBeHeld();
    if (!this.isLocked) return;
    await this.recovered(await this.session.status());
    if (this.lockedBy) throw this.stoppedBy(this.lockedBy);
    if (this.isLocked) throw locked(this.session.findsHome);
  }

  /** Ends the connection, so that it is made again when the door is closed, or its emergency stop is released. */
  private stoppedBy(cause: PlotwrightError): PlotwrightError {
    this.isBarred = true;
    this.session.fail(cause);
    return cause;
  }

  /**
   * Lifts a pen that may have been left on the paper. At the first connection nothing moves if the pen's height is unknown,
   * because it is probably up.
   */
  private async liftLeft(status: Status, settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const { position } = this;
    const lift = this.pen.liftOf(machineOf(settings));
    if (lift.kind === "z" && hasRestarted(status)) {
      // It counts from 0 wherever the pen is, so the pen is lifted by its travel.
      if (!before) return;
      await this.pen.countFrom(before.penUp, settings);
      if (before.penUp === true) this.pen.setState(true);
      else await this.movePen(true, settings);
      return;
    }
    const left = leftPen(lift, status.at[2], this.session.modes, settings.pen, before, position.isInPlot);
    position.foundWith(left.isUp, before);
    if (left.mustLift) await this.movePen(true, settings);
    else if (left.isUp) this.pen.setState(true);
  }
}
