/**
 * The protocol of one Grbl: counts the unanswered characters, matches each `ok` or `error:n` to its line, and detects
 * answers that are missing or doubled.
 *
 * Answers carry no numbers, so one that is lost or doubled shifts all later ones. A check (CHECK) reveals that: its own
 * report comes when all lines before it are read, so exactly those must have been answered then. What is lost at the very
 * end is noticed when the machine rests and still has not answered.
 */
import { PlotwrightError } from "../../../errors.js";
import { silent } from "../../faults.js";
import { LineSession, type LineProtocol } from "../../line-session.js";
import type { SessionLog } from "../../session-log.js";
import { SilenceWatch } from "../../silence-watch.js";
import { delay, type Clock, type Transport } from "../../transport.js";
import { QUEUE_MOVES, type Axes } from "../model/planner.js";
import {
  alarm,
  alarmOf,
  buffersOf,
  CHECK,
  heldError,
  HOME,
  INFO,
  isBuiltForCore,
  isGreeting,
  isHeld,
  isMoving,
  isOldVersion,
  isReport,
  MODES_REPORT,
  NOW,
  offsetOf,
  OLD_QUEUE_MOVES,
  outOfStep,
  refusal,
  boardRestartedError,
  RX_BYTES,
  stateError,
  statusOf,
  unanswered,
  unplaced,
  versionAfter,
  type Status,
} from "../protocol.js";
import { BoardSettings } from "./board-settings.js";
import { isSamePlace } from "./braking.js";
import { askVersion } from "./identify.js";
import { SentLines, type Settle } from "./sent-lines.js";

/** What a job that is being played learns from the session. */
export interface PlayListener {
  /** The board restarted or stopped by itself. Called before the unanswered lines are settled, like `lost`. */
  broken(error: PlotwrightError): void;
  /** The connection is lost. The board goes on with what it has received. */
  lost(error: PlotwrightError): void;
  /** Answers do not fit the lines, so it is unknown which lines were refused. */
  outOfStep(error: PlotwrightError): void;
  /** The board has reported its state, which may be one in which it does not draw. */
  reported(state: string): void;
}

/** Silence after which the board counts as gone, s; its status is polled meanwhile. */
const PATIENCE_S = 3;
/** The same for a machine that says it runs, but whose position does not change: it may be very slow. */
const SLOW_S = 30;
const REFUSED_TRIES = 10;
const LOST_TRIES = 3;
const OFFSET_TRIES = 35;
const POLL_S = 0.2;
/** An Arduino restarts when its port is opened, and does not answer for up to two seconds. */
const IDENTIFY_TRIES = 4;
/** The longest search for switches, s. */
const HOMING_S = 180;
/** Time for the greeting after a reset. */
const HOLD_S = 0.5;

export class GrblSession implements LineProtocol {
  readonly lineEnd = "\n";
  version: string | null = null;
  readonly settings = new BoardSettings();
  /** Set while a job is played. */
  playing: PlayListener | null = null;
  /** The board is locked because `reset` stopped it in motion. */
  isLockOurs = false;
  /** The board knows the command of a check. */
  canCheck = false;
  /** The machine finds home by itself. */
  findsHome = false;
  /** The latest report of the parser's modes, and the first one, from before any reset of ours; "": none has come. */
  modes = "";
  foundModes = "";
  /** It was stopped before it had drawn what an earlier connection had sent. */
  isCutShort = false;
  /** The latest answer with which it has refused a line: "error:20". */
  lastRefusal = "";
  /** Resets that were sent. */
  resetCount = 0;
  /** It has said that it has started. */
  isGreeted = false;
  lastStatus: Status | null = null;

  private buffers = { queueMoves: QUEUE_MOVES, rxBytes: RX_BYTES };
  private hasCore = false;
  private readonly sent = new SentLines();
  /** Work zero in machine coordinates, in the board's units, which may be known only later. Null: not yet reported. */
  private reportedOffset: Axes | null = null;
  private statusWaiters: ((status: Status) => void)[] = [];
  private greetingWaiters: (() => void)[] = [];
  /** The board was reset in motion, but not by us: its greeting follows the alarm that says so. */
  private isGreetingDue = false;
  private failures: ((error: PlotwrightError) => void)[] = [];
  private readonly lines: LineSession;
  private isIdentified = false;
  private resetting: Promise<Status> | null = null;
  /** Notices a board that reports its state, but does not answer its lines. */
  private readonly missing: SilenceWatch;
  /** Its latest report does not say where it is. */
  private isUnplaced = false;
  private progressS = 0;
  private cancelPoll: (() => void) | null = null;

  constructor(
    transport: Transport,
    readonly clock: Clock,
  ) {
    this.missing = new SilenceWatch(clock, () => this.answerMissing());
    this.lines = new LineSession(transport, this, { clock });
  }

  get log(): SessionLog {
    return this.lines.log;
  }

  /** Why the session can no longer be used; null while it is usable. */
  get failure(): PlotwrightError | null {
    return this.lines.failure;
  }

  /** Ends the session because of an error. */
  fail(error: PlotwrightError): void {
    this.lines.fail(error);
  }

  /** Called once, when the connection or the board is lost. */
  onFault(listener: (error: PlotwrightError) => void): void {
    this.lines.onFault(listener);
  }

  /** Resolves with the version. Rejects with `no-board` if another device answers, `board-timeout` if nothing does. */
  async identify(): Promise<string> {
    const version = await this.lines.identify({
      board: "a Grbl",
      tries: IDENTIFY_TRIES,
      attempt: async (index) => {
        const version = await askVersion(this, index > 0);
        this.sent.settleAll(silent(INFO));
        return version;
      },
    });
    this.isIdentified = true;
    return version;
  }

  /** Whether the buffer has room for another line now. */
  hasRoom(line: string): boolean {
    return this.sent.hasRoom(line, this.buffers.rxBytes);
  }

  /** Work zero in machine coordinates, mm. */
  get offset(): Axes {
    const { mmPerUnit } = this.settings;
    const [x, y, z] = this.reportedOffset ?? [0, 0, 0];
    return [x * mmPerUnit, y * mmPerUnit, z * mmPerUnit];
  }

  /** Whether it plans the way of its motors. grblHAL and FluidNC plan that of the carriage. */
  get plansMotors(): boolean {
    return this.hasCore && this.version?.startsWith("Grbl ") === true;
  }

  /** Max accepted moves that are not done. */
  get queueMoves(): number {
    return this.buffers.queueMoves;
  }

  /** Sends one line; `settle` is called once, with its reply or an error. `isLast`: the connection ends without a reply. */
  write(line: string, settle: Settle, isLast = true): void {
    if (this.failure) return settle(this.failure);
    this.sent.add(line, settle, isLast);
    this.lines.writeLines([line]);
    // Not measured from an old reply.
    if (this.sent.count === 1) {
      this.lines.expectWithin(line === HOME ? HOMING_S : PATIENCE_S);
      this.expectAnswer();
    }
    this.poll();
  }

  /** Resolves when the line is accepted; for `G4` when everything before it is done. */
  send(line: string, isLast = true): Promise<void> {
    return new Promise((resolve, reject) =>
      this.write(line, (error) => (error ? reject(error) : resolve()), isLast),
    );
  }

  /**
   * The same for lines that may be sent again if they are refused, as when the connection is disturbed. `lostTries`: how often
   * if they are not answered; then they may have been executed.
   */
  async sendSurely(line: string, lostTries = LOST_TRIES): Promise<void> {
    for (let i = 1; ; i++) {
      try {
        return await this.send(line, i >= lostTries);
      } catch (error) {
        const { code } = error instanceof PlotwrightError ? error : { code: null };
        const mayRepeat = code === "board-error" || (code === "board-timeout" && i < lostTries);
        if (this.failure || !mayRepeat || i === REFUSED_TRIES) throw error;
      }
      // After an error, a grblHAL refuses all lines up to an empty one.
      await this.send("").catch(() => undefined);
    }
  }

  /** The same, also if the board does not know the line. Rejects if the connection is lost. */
  async attempt(line: string): Promise<void> {
    await this.sendSurely(line).catch(() => undefined);
    if (this.failure) throw this.failure;
  }

  /** Reads the Grbl's own settings; it must be at rest. One that does not list them has none. */
  async readSettings(): Promise<void> {
    this.settings.forget();
    await this.attempt("$$");
  }

  /** Asks until it reports its work offset, as it does at least once in 30 reports. One that never does has none. */
  async readOffset(): Promise<void> {
    for (let i = 0; i < OFFSET_TRIES && this.reportedOffset === null; i++) await this.status();
  }

  /** Finds out whether the board knows the command of a check. */
  async tryCheck(): Promise<void> {
    const entryCount = this.log.count;
    await this.attempt(CHECK);
    this.canCheck = this.log.receivedSince(entryCount).some((line) => line.startsWith(MODES_REPORT));
  }

  /** Sends a real-time command. */
  now(byte: string): void {
    if (byte !== NOW.status) this.log.add("sent", byte === NOW.reset ? "(reset)" : byte);
    this.lines.writeText(byte);
  }

  status(): Promise<Status> {
    const why = (): PlotwrightError =>
      this.isUnplaced ? unplaced("with another program") : silent("its status");
    return this.within(why, (resolve) => {
      this.statusWaiters.push(resolve);
      this.now(NOW.status);
      this.poll();
    });
  }

  /** Resets Grbl, which clears its queue. Unanswered lines are settled with `conflict`. */
  reset(): Promise<Status> {
    // One at a time: the greeting after a second reset would look like a restart.
    this.resetting ??= this.resetOnce().finally(() => {
      this.resetting = null;
    });
    return this.resetting;
  }

  close(): Promise<void> {
    return this.lines.close();
  }

  private async resetOnce(): Promise<Status> {
    this.isLockOurs = false;
    this.resetCount++;
    if (this.isGreetingDue) await delay(this.clock, HOLD_S);
    this.isGreetingDue = false;
    const greeted = this.within<void>(
      () => silent("a reset"),
      (resolve) => this.greetingWaiters.push(resolve),
    );
    this.now(NOW.reset);
    await greeted;
    this.sent.settleAll(stopped());
    return this.status();
  }

  /** A board that does not answer counts as lost. */
  private within<T>(why: () => PlotwrightError, begin: (resolve: (value: T) => void) => void): Promise<T> {
    return new Promise((resolve, reject) => {
      if (this.failure) return reject(this.failure);
      const silence = new SilenceWatch(this.clock, () => this.lines.fail(why()));
      silence.expect(PATIENCE_S);
      const failed = (error: PlotwrightError): void => {
        silence.stop();
        reject(error);
      };
      this.failures.push(failed);
      begin((value) => {
        silence.stop();
        this.failures = this.failures.filter((one) => one !== failed);
        resolve(value);
      });
    });
  }

  isRoutine(line: string): boolean {
    return isReport(line);
  }

  take(line: string): void {
    this.lines.expectWithin(this.sent.first?.line === HOME ? HOMING_S : PATIENCE_S);
    this.reportedOffset = offsetOf(line) ?? this.reportedOffset;
    const status = statusOf(line, this.offset, this.settings.mmPerUnit);
    if (status) return this.reported(status);
    this.isUnplaced = isReport(line);
    this.isGreeted ||= isGreeting(line);
    this.takeVersion(versionAfter(line, this.version));
    this.buffers = buffersOf(line) ?? this.buffers;
    this.hasCore ||= isBuiltForCore(line);
    this.settings.take(line);
    const alarmed = alarmOf(line);
    if (line === "ok") this.settleFirst(null);
    // Old versions write words instead of a number.
    else if (line.startsWith("error:")) this.settleFirst(line);
    else if (line.startsWith(MODES_REPORT)) {
      this.modes = line;
      this.foundModes ||= line;
      this.checkReported();
    } else if (alarmed) {
      const { code, isReset } = alarmed;
      const isOurs = isReset && this.greetingWaiters.length > 0;
      this.isLockOurs ||= isOurs;
      this.isGreetingDue = isReset && !isOurs;
      if (!isOurs) this.broken(alarm(code, this, line));
    } else if (isGreeting(line) && this.isGreetingDue) this.isGreetingDue = false;
    else if (isGreeting(line)) {
      const waiters = this.greetingWaiters.splice(0);
      if (waiters.length === 0) this.broken(boardRestartedError(this.findsHome));
      for (const waiter of waiters) waiter();
    }
  }

  private takeVersion(version: string | null): void {
    if (version === null || version === this.version) return;
    this.version = version;
    if (isOldVersion(version)) this.buffers = { queueMoves: OLD_QUEUE_MOVES, rxBytes: RX_BYTES };
  }

  private reported(status: Status): void {
    this.isUnplaced = false;
    const before = this.lastStatus;
    this.lastStatus = status;
    const hasMoved = before === null || !isSamePlace(before, status);
    if (hasMoved) this.progressS = this.clock.nowS();
    const isSlow = isMoving(status.state) && this.clock.nowS() - this.progressS < SLOW_S;
    if (hasMoved || isSlow) this.expectAnswer();
    for (const waiter of this.statusWaiters.splice(0)) waiter(status);
    if (!this.playing || this.resetting) return;
    const error = stateError(status.state, this);
    if (error) this.broken(error);
    else this.playing.reported(status.state);
  }

  private settleFirst(errorReply: string | null): void {
    this.lastRefusal = errorReply ?? this.lastRefusal;
    const first = this.sent.next();
    if (!first) return this.playing?.outOfStep(outOfStep());
    this.progressS = this.clock.nowS();
    this.expectAnswer();
    // The answer was that of another line.
    if (first.line === CHECK && errorReply === null && !first.isReported)
      this.playing?.outOfStep(outOfStep());
    first.settle(errorReply === null ? null : refusal(first.line, errorReply, this.version));
  }

  private checkReported(): void {
    const first = this.sent.first;
    if (first?.line === CHECK) first.isReported = true;
    else this.playing?.outOfStep(outOfStep());
  }

  /** From now on the answer to the first line is due, after the wait that the line asks for. */
  private expectAnswer(): void {
    const first = this.sent.first;
    const isHoming = first?.line === HOME;
    const waitS = isHoming ? HOMING_S : Number(/^G4P([\d.]+)/.exec(first?.line ?? "")?.[1] ?? 0);
    this.missing.expect(first ? PATIENCE_S + waitS : Infinity);
  }

  private answerMissing(): void {
    const first = this.sent.first;
    if (!first || this.resetting || !this.isIdentified) return;
    const state = this.lastStatus?.state ?? "silent";
    const error = isHeld(state) ? heldError(state) : unanswered(first.line, state);
    if (this.playing) this.playing.outOfStep(error);
    else if (first.isLast || this.sent.count > 1 || state !== "Idle") this.lines.fail(error);
    else this.sent.next()?.settle(error);
  }

  private broken(error: PlotwrightError): void {
    if (this.version === null) return;
    // Without a job, the machine would keep a position that is wrong now. Connecting again finds out the board's state.
    if (this.isIdentified && !this.playing) return this.lines.fail(error);
    this.playing?.broken(error);
    this.sent.settleAll(error);
  }

  /**
   * While a reply is missing, asks for the status again and again: Grbl answers that even if a line waits for motion,
   * and one report may be lost.
   */
  private poll(): void {
    const isWaiting =
      (this.sent.count > 0 && this.sent.first?.line !== HOME) || this.statusWaiters.length > 0;
    if (this.failure || this.cancelPoll || !isWaiting) return;
    this.cancelPoll = this.clock.after(POLL_S, () => {
      this.cancelPoll = null;
      if (this.sent.count > 0 || this.statusWaiters.length > 0) this.now(NOW.status);
      this.poll();
    });
  }

  silent(): void {
    if (this.sent.first) this.lines.fail(silent(this.sent.first.line));
  }

  ended(error: PlotwrightError): void {
    this.missing.stop();
    this.cancelPoll?.();
    this.playing?.lost(error);
    this.sent.settleAll(error);
    for (const failed of this.failures.splice(0)) failed(error);
  }
}

const stopped = (): PlotwrightError => new PlotwrightError("conflict", "The machine was stopped.");
