/** One connected Grbl: where its carriage and pen are, and what moves them. A carriage whose place is unknown counts as at home. */
import { PlotwrightError } from "../../../errors.js";
import { positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import { servoTime } from "../../../machines/pen-servo.js";
import { waitOf } from "../../../plan/pen/pen-times.js";
import type {
  ConnectOptions,
  ConsoleAnswer,
  Machine,
  Playback,
  PenBefore,
  PlaybackRequest,
} from "../../driver.js";
import { moveStopped } from "../../faults.js";
import type { MachineSettings, MachineState, PlannedPlot } from "../../machine-job.js";
import { MoveSignal, moveTo } from "../../move-to.js";
import type { Clock } from "../../transport.js";
import { grblCommandsOf, MODES, planGrblJob, SYNC, type GrblCommands, type GrblState } from "../grbl-job.js";
import { findsHome } from "../model/grbl-controller.js";
import { penLiftOf, waitLine, type PenLift } from "../model/pen-lift.js";
import { difference, type Axes } from "../model/planner.js";
import { HOME, isLocked, locked, noSwitches, NOT_LIFTED, servoSignalOf, type Status } from "../protocol.js";
import { whyRefused } from "../console-lines.js";
import { homeByMark, homeMark, type GrblMemory } from "./kept-home.js";
import { GrblPlayback } from "./grbl-playback.js";
import { LineStream } from "./line-stream.js";
import type { GrblSession } from "./session.js";

/** Allowance for the connection, the board and this computer. */
const STOP_MS = 30;
/** Share of the pen's travel below its lowest height up to which a height counts as one of the pen's. */
const BELOW = 0.25;
/** A share of the pen's travel from which the pen counts as up. */
const UP = 0.99;
const WHOLE_PCT = 100;

export class GrblMachine implements Machine {
  readonly homing = { seekHome: (settings: MachineSettings): Promise<boolean> => this.seekHome(settings) };
  readonly console = { send: (line: string): Promise<ConsoleAnswer> => this.sendLine(line) };
  stopSignal = new MoveSignal();
  penUp: boolean | null = null;
  penMoving = false;
  motorsOn: boolean | null = null;
  /** What the user should know about it, in words; null: nothing. */
  note: string | null = null;
  /** Where the pen is or goes to, percent; null: unknown. */
  private heightPct: number | null = null;
  foundMidPlot: { readonly penUp: boolean } | null = null;
  /**
   * Home in machine coordinates, mm; null: unknown. It is kept here and not in the Grbl, whose work offsets are the user's.
   */
  private home: Axes | null = null;
  /** Where the profile's Z is 0, in machine coordinates; null: where the Grbl's own is. */
  private penZeroMm: number | null = null;
  /** Where it rested last, in machine coordinates. */
  private machineAt: Axes = [0, 0, 0];
  /** That of the latest settings. */
  private profile: MachineProfile | null = null;
  private isAsleep = false;
  private isHoming = false;
  /** Only the user may unlock it. */
  private isLocked = false;
  private byHand: LineStream | null = null;

  constructor(
    readonly session: GrblSession,
    readonly firmware: string,
    private readonly options: ConnectOptions,
  ) {}

  get clock(): Clock {
    return this.options.machineClock;
  }

  get speed(): number {
    return this.options.speed;
  }

  get state(): MachineState | null {
    const { home, profile } = this;
    return this.session.failure || !home || !profile ? null : this.stateFrom(home, profile);
  }

  get memory(): GrblMemory {
    return { home: this.home, penZeroMm: this.penZeroMm };
  }

  positionMm(profile: MachineProfile): { x: number; y: number } | null {
    const { stepsPerMm } = profile;
    if (!this.home) return null;
    const [x, y] = difference(this.machineAt, this.home);
    return positionFromMotors(profile, x * stepsPerMm, y * stepsPerMm);
  }

  /** Stops motion that was left, reads the Grbl's settings, and lifts the pen if it may be on the paper. */
  async readKeptState(settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const { session } = this;
    const { state } = await session.status();
    if (state !== "Idle" && !isLocked(state)) {
      await session.brake();
      await session.reset();
    }
    const profile = machineOf(settings);
    this.use(profile);
    await session.readSettings();
    this.note = session.settings.slowerThan(profile);
    await session.tryCheck();
    await session.readOffset();
    // Again, because only now the units are known.
    const status = await session.status();
    if (!isLocked(status.state)) this.remember(status, before, profile);
    await this.recovered(status);
    if (!this.isLocked) await this.liftLeft(status, settings, before);
  }

  async prepareMotors(settings: MachineSettings): Promise<MachineState> {
    const profile = machineOf(settings);
    this.use(profile);
    penLiftOf(profile);
    // The Grbl locks itself when it is woken, because the carriage may have been pushed. It counts as at home then.
    if (this.isAsleep) await this.recovered(await this.session.reset(), true);
    this.isAsleep = false;
    if (this.home === null) await this.seekHome(settings);
    await this.mustBeUnlocked();
    const home = this.home ?? (await this.homeIsHere());
    this.motorsOn = true;
    this.options.events.changed();
    return this.stateFrom(home, profile);
  }

  async movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    const profile = machineOf(settings);
    const { upPct, downPct, extraLiftMs, extraDropMs } = settings.pen;
    const pct = heightPct ?? (up ? upPct : downPct);
    const lift = this.liftOf(profile);
    if (this.isAsleep) await this.prepareMotors(settings);
    await this.mustBeUnlocked();
    const byPct = this.heightPct === null ? WHOLE_PCT : Math.abs(pct - this.heightPct);
    const { liftPctPerS, dropPctPerS } = lift.servo;
    const servoS = waitOf(
      servoTime(lift.servo, byPct, up ? liftPctPerS : dropPctPerS),
      up ? extraLiftMs : extraDropMs,
    );
    const lines = [SYNC, ...lift.lines(up, pct), waitLine(lift.waitS(servoS))];
    this.session.settings.mustPerform(lines, this.session.offset);
    this.penUp = up;
    this.heightPct = pct;
    this.penMoving = true;
    this.options.events.changed();
    try {
      for (const line of lines) await this.session.sendSurely(line);
    } catch (error) {
      this.penUp = this.heightPct = null;
      throw error;
    } finally {
      this.penMoving = false;
      this.options.events.changed();
    }
  }

  /** Lifts the pen after a fault; returns the error to report. */
  async liftAfter(error: PlotwrightError, settings: MachineSettings): Promise<PlotwrightError> {
    try {
      await this.movePen(true, settings);
      return error;
    } catch (failure) {
      // The pen is lifted when the machine is connected again.
      if (this.session.failure) return error;
      const why = failure instanceof PlotwrightError ? ` ${failure.message}` : "";
      return new PlotwrightError(error.code, `${error.message} ${NOT_LIFTED}${why}`, { cause: error });
    }
  }

  moveTo(xMm: number, yMm: number, settings: MachineSettings): Promise<void> {
    return moveTo(this, planGrblJob, { xMm, yMm }, settings);
  }

  async perform({ commands }: PlannedPlot, settings: MachineSettings): Promise<void> {
    const stream = this.stream(grblCommandsOf(commands));
    this.byHand = stream;
    try {
      await stream.play();
      await this.arrived();
    } catch (error) {
      await this.recover(stream, settings, false);
      throw error instanceof PlotwrightError ? await this.liftAfter(error, settings) : error;
    } finally {
      this.byHand = null;
    }
  }

  /** Called after a job has been played to its end. */
  async arrived(): Promise<void> {
    this.machineAt = (await this.session.status()).machineAt;
    this.penUp = true;
    // Each layer may have its own.
    this.heightPct = null;
    this.options.events.changed();
  }

  /** False if the profile has no switches; nothing moves then. */
  private async seekHome(settings: MachineSettings): Promise<boolean> {
    const { session, stopSignal } = this;
    const profile = machineOf(settings);
    if (!findsHome(profile)) return false;
    if (!session.settings.hasHoming) throw noSwitches();
    // A Z axis is brought to its switch first. Any other pen must not be dragged: the user has asked for the lock to go.
    const needsLift = !this.isLocked || this.liftOf(profile).kind !== "z";
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
    // Z counts from its switch again.
    this.penZeroMm = null;
    await this.homeIsHere();
    await this.movePen(true, settings);
    return true;
  }

  async setHome(settings: MachineSettings): Promise<void> {
    await this.prepareMotors(settings);
    await this.homeIsHere();
  }

  async motorsOff(): Promise<void> {
    if (!this.isAsleep) await this.session.send("$SLP");
    this.isAsleep = true;
    this.motorsOn = false;
    await this.forgetPosition();
  }

  forgetPosition(): Promise<void> {
    this.home = this.foundMidPlot = null;
    if (!this.isAsleep) this.markHome().catch(() => undefined);
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
    const why = whyRefused(line);
    if (why) throw new PlotwrightError("bad-setting", `${JSON.stringify(line)} was not sent: ${why}.`);
    const { log } = this.session;
    const entryCount = log.count;
    let refused = false;
    await this.session.send(line).catch((error: unknown) => {
      // An error reply is among the received lines.
      if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
      refused = true;
    });
    const replies = log.receivedSince(entryCount);
    if (/^\$(\d+=|RST)/i.test(line)) await this.session.readSettings();
    if (line.startsWith("$") && !/^\$J/i.test(line)) return { replies, refused, note: null };
    await this.session.send(SYNC).catch(() => undefined);
    this.penUp = this.heightPct = null;
    await this.forgetPosition();
    return {
      replies,
      refused,
      note: "The machine may have moved, so its position is unknown. The next move starts from here as home.",
    };
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

  stream(commands: GrblCommands): LineStream {
    this.session.settings.mustPerform(commands.lines, this.session.offset);
    this.motorsOn = true;
    this.penUp = this.heightPct = this.foundMidPlot = null;
    return new LineStream(this.session, commands, this.clock, () => this.options.events.buttonPressed());
  }

  /**
   * Call after a play that did not reach its end: Grbl then accepts moves again. `penUp`: the pen was certainly up.
   */
  async recover(stream: LineStream, settings: MachineSettings, penUp: boolean): Promise<void> {
    const status = await stream.cleared();
    if (stream.isBroken) this.home = null;
    await this.recovered(status);
    // Its greeting may have been lost.
    if (!this.isLocked && hasRestarted(status)) await this.setHeight(penUp, settings);
  }

  /** Without homing, a lock has no other purpose than to be acknowledged. */
  private get mayUnlock(): boolean {
    return this.session.isLockOurs || !this.session.settings.hasHoming;
  }

  /** Call after a reset: restores the modes that the lines need, and takes over the reported position. */
  private async recovered({ state, machineAt }: Status, mayUnlock = this.mayUnlock): Promise<void> {
    this.penUp = this.heightPct = null;
    this.machineAt = machineAt;
    this.isLocked = isLocked(state) && !mayUnlock;
    this.options.events.changed();
    if (this.isLocked) return;
    // If they are refused, so is the next move.
    if (isLocked(state)) await this.session.attempt("$X");
    await this.session.attempt(MODES);
    await this.markHome();
  }

  /** Tells a later process where home is, as far as that is possible. */
  private markHome(): Promise<void> {
    return this.session.attempt(homeMark(this.penZeroMm === null ? this.home : null, this.session.settings));
  }

  private use(profile: MachineProfile): void {
    this.profile = profile;
    this.session.findsHome = findsHome(profile);
  }

  /** Throws if the Grbl is still locked; the user may have unlocked it meanwhile. */
  private async mustBeUnlocked(): Promise<void> {
    if (!this.isLocked) return;
    await this.recovered(await this.session.status());
    if (this.isLocked) throw locked(this.session.findsHome);
  }

  /**
   * Lifts a pen that may have been left on the paper. At the first connection nothing moves if the pen's height is unknown,
   * because it is probably up.
   */
  private async liftLeft(status: Status, settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const lift = this.liftOf(machineOf(settings));
    const { upPct, downPct } = settings.pen;
    if (lift.kind === "z" && hasRestarted(status)) {
      // It counts from 0 wherever the pen is, so the pen is lifted by its travel.
      if (!before) return;
      const penUp = before.penUp === true;
      await this.setHeight(penUp, settings);
      if (penUp) this.penUp = true;
      else await this.movePen(true, settings);
      return;
    }
    const pct = this.keptHeightPct(lift, status);
    const share = pct === null ? null : (pct - downPct) / (upPct - downPct);
    if (this.home) this.foundMidPlot = { penUp: share === null ? before?.penUp === true : share > UP };
    if (share !== null && share > UP) this.penUp = true;
    else if (before || (share !== null && (lift.kind === "servo" || share > -BELOW))) {
      await this.movePen(true, settings);
    }
  }

  /** The pen's height that a Grbl still has from before it was connected; null: it has none. */
  private keptHeightPct(lift: PenLift, { at }: Status): number | null {
    if (lift.kind === "z") return lift.pctOf(at[2]);
    const signal = lift.kind === "servo" ? servoSignalOf(this.session.modes) : null;
    return signal === null ? null : lift.pctOf(signal);
  }

  /** After a restart: the pen's current height is that of a pen that is up, or down. */
  private async setHeight(penUp: boolean, settings: MachineSettings): Promise<void> {
    const lift = penLiftOf(machineOf(settings));
    if (lift.kind !== "z") return;
    const { upPct, downPct } = settings.pen;
    this.penZeroMm = (await this.session.status()).machineAt[2] - lift.valueAt(penUp ? upPct : downPct);
  }

  private liftOf(profile: MachineProfile): PenLift {
    return penLiftOf(profile, this.session.settings.limitsFor(profile), this.zeroFrom(this.home)[2]);
  }

  /** Home and the pen's zero in work coordinates. */
  private zeroFrom(home: Axes | null): Axes {
    const { offset } = this.session;
    const [x, y] = home ?? offset;
    return difference([x, y, this.penZeroMm ?? offset[2]], offset);
  }

  private stateFrom(home: Axes, profile: MachineProfile): GrblState {
    return {
      at: difference(this.machineAt, home),
      zero: this.zeroFrom(home),
      limits: this.session.settings.limitsFor(profile),
      queueMoves: this.session.queueMoves,
    };
  }

  /** A Grbl that was not restarted still counts from the same place. */
  private remember(status: Status, before: PenBefore | null, profile: MachineProfile): void {
    const { foundModes, settings } = this.session;
    const marked = homeByMark(foundModes, status.machineAt, profile, settings);
    const memory = hasRestarted(status) ? null : (before?.memory as GrblMemory | null | undefined);
    this.penZeroMm = memory?.penZeroMm ?? null;
    this.home = memory?.home ?? marked;
    this.machineAt = status.machineAt;
    this.options.events.changed();
  }

  private async homeIsHere(): Promise<Axes> {
    const { machineAt } = await this.session.status();
    this.home = this.machineAt = machineAt;
    this.foundMidPlot = null;
    await this.markHome();
    this.options.events.changed();
    return machineAt;
  }
}

/** Machine coordinates begin at 0 with each start. */
const hasRestarted = ({ machineAt }: Status): boolean => machineAt.every((mm) => mm === 0);
