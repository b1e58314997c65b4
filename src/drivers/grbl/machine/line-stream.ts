/**
 * Plays the lines of one job: sends as many ahead as fit into Grbl's buffer, and a check after each run, so that a lost
 * or doubled answer is found while little of the drawing depends on it.
 */
import { PlotwrightError } from "../../../errors.js";
import type { Clock } from "../../transport.js";
import { SYNC, type GrblCommands } from "../grbl-job.js";
import { MAX_SLICES } from "../model/planner.js";
import { CHECK, isChecking, isHeld, isJogging, otherProgram, type Status } from "../protocol.js";
import { brake } from "./braking.js";
import type { GrblSession } from "./session.js";

/**
 * What may be sent before it is accepted, s: the less of it, the more certain is the place if the connection ends. A large
 * buffer would hold minutes.
 */
const AHEAD_S = 1;

export class LineStream {
  /** Index of the next line to send. */
  private next = 0;
  private answeredCount = 0;
  /** This many lines were sent before the check that is due; 0: none is due. */
  private checkDue = 0;
  /** The last time up to which everything is certainly done, seconds along the plan. */
  private certainS: number;
  /** The same at the last report of a state in which it draws: a Grbl that only checks lines answers them, too. */
  private provenS: number;
  /** Seconds along the plan from which lines may not have been executed; null: all were, as far as they are answered. */
  missedS: number | null = null;
  /** The line that Grbl refused; -1: none. */
  private refused = -1;
  /** Nothing more is sent. */
  isOver = false;
  /** Grbl restarted or stopped by itself, so its position is lost. */
  isBroken = false;
  /** Another program has moved the carriage, so that its place says nothing about the plan. */
  wasMoved = false;
  private isSettled = false;
  /** `receivedS` when the connection was lost, after which nothing can be stopped. */
  private receivedAtLossS: number | null | undefined = undefined;
  private clearing: Promise<Status> | null = null;
  /** When a stop was requested: the plan's time hardly advances during the braking. */
  private stopS: number | null = null;
  /** The last time at which the position on the plan was known exactly. */
  private known: { readonly planS: number; readonly clockS: number };
  private settle: (error: PlotwrightError | null) => void = () => undefined;

  constructor(
    private readonly session: GrblSession,
    private readonly commands: GrblCommands,
    /** Counts the machine's seconds. */
    private readonly clock: Clock,
    /** A button of the machine, its door or another program holds it. */
    private readonly onHeld: (state: string) => void,
  ) {
    this.certainS = this.provenS = commands.planS[0];
    this.known = { planS: this.certainS, clockS: clock.nowS() };
  }

  /**
   * Resolves when everything is done. Rejects with the error passed to `slowDown`, `stop` or `abandon`, or with the
   * Grbl's error.
   */
  play(): Promise<void> {
    return new Promise((resolve, reject) => {
      this.settle = (error) => {
        if (this.isSettled) return;
        this.isOver = this.isSettled = true;
        this.session.playing = null;
        if (error) reject(error);
        else resolve();
      };
      this.session.playing = {
        broken: (error) => {
          this.isBroken = true;
          this.settle(error);
        },
        lost: (error) => {
          this.receivedAtLossS = this.receivedS;
          this.settle(error);
        },
        outOfStep: (error) => this.miss(this.certainS, error),
        reported: (state) => this.reported(state),
      };
      this.feed();
    });
  }

  /** Estimated position, seconds along the plan: no further than the accepted lines. */
  get planS(): number {
    const { planS } = this.commands;
    const nowS = this.known.planS + (this.stopS ?? this.clock.nowS()) - this.known.clockS;
    return Math.min(Math.max(nowS, planS[this.firstUndone(this.session.queueMoves)]), this.reachedS);
  }

  /** Estimated positions every `stepS` from now, at most `count`, no further than the accepted lines. None once it stops. */
  timesAhead(stepS: number, count: number): number[] {
    const fromS = this.planS;
    const steps = this.isOver ? 0 : Math.min(count, Math.floor((this.reachedS - fromS) / stepS));
    return Array.from({ length: steps }, (_, k) => fromS + (k + 1) * stepS);
  }

  /**
   * What the Grbl draws even if nothing more is sent, seconds along the plan; null once it may be stopped before, or some of it
   * is unsure.
   */
  get receivedS(): number | null {
    if (this.receivedAtLossS !== undefined) return this.receivedAtLossS;
    return this.clearing || this.stopS !== null || this.missedS !== null || this.isBroken
      ? null
      : this.takenS;
  }

  /** What will have been sent at most after `withinS` more seconds, seconds along the plan. */
  sentS(withinS: number): number {
    const { planS, moveCounts, count } = this.commands;
    const drawnS = this.planS + withinS;
    let line = this.firstUndone(this.session.queueMoves);
    while (line < count && planS[line + 1] <= drawnS) line++;
    for (let left = this.session.queueMoves; line < count && left > 0; left -= moveCounts[line - 1]) line++;
    let next = line;
    while (next < count && !isFarAhead(planS, line, next)) next++;
    return planS[next];
  }

  /** Bounds of the position, seconds along the plan. */
  get boundsS(): readonly [fromS: number, toS: number] {
    const { planS, count } = this.commands;
    // Which lines were executed after a missed one is unknown.
    if (this.missedS !== null) return [this.certainS, planS[this.next]];
    const from = this.firstUndone(this.session.queueMoves + MAX_SLICES + 1);
    return [Math.max(planS[from], this.known.planS), planS[Math.min(count, this.answeredCount + 2)]];
  }

  /**
   * The ends of the straight line that replaces a refused line and those up to the next straight one, seconds along the plan.
   * Arcs between them are refused too, because they begin elsewhere.
   */
  get shortCutS(): readonly [fromS: number, toS: number] | null {
    const { planS, count, moveCounts } = this.commands;
    if (this.refused < 0) return null;
    let next = this.refused + 1;
    while (next < count && moveCounts[next] > 1) next++;
    return [planS[this.refused], planS[Math.min(count, next + 1)]];
  }

  /** Slows down along the path, then clears Grbl's queue. `play` rejects with the error. */
  slowDown(error: PlotwrightError): void {
    if (this.isOver) return;
    this.isOver = true;
    this.stopS = this.clock.nowS();
    // Without an answer, clearing the queue fails too.
    void brake(this.session)
      .catch(() => undefined)
      .then(() => this.stop(error));
  }

  /** Stops at once, also while it slows down. `play` rejects with the error. */
  stop(error: PlotwrightError): void {
    if (this.isSettled) return;
    void this.cleared()
      .catch(() => undefined)
      .then(() => this.settle(error));
  }

  /** Stops at once, and `play` rejects without waiting for an answer. */
  abandon(error: PlotwrightError): void {
    this.cleared().catch(() => undefined);
    this.settle(error);
  }

  /** Clears Grbl's queue if that is not yet done. */
  cleared(): Promise<Status> {
    this.isOver = true;
    this.stopS ??= this.clock.nowS();
    this.clearing ??= this.session.reset();
    return this.clearing;
  }

  private reported(state: string): void {
    if (isChecking(state)) {
      this.certainS = this.missedS = this.provenS;
      return this.slowDown(otherProgram(state));
    }
    this.provenS = this.certainS;
    if (isJogging(state)) {
      this.wasMoved = true;
      this.miss(this.certainS, otherProgram(state));
    } else if (isHeld(state) && !this.isOver) this.onHeld(state);
  }

  private get takenS(): number {
    return this.commands.planS[this.answeredCount];
  }

  /** An arc is accepted only when most of it is drawn. */
  private get reachedS(): number {
    const { planS, moveCounts } = this.commands;
    const line = this.answeredCount;
    return planS[line < this.next && moveCounts[line] > 1 ? line + 1 : line];
  }

  /** The first accepted line that may not be done if the Grbl keeps that many moves. */
  private firstUndone(moveCount: number): number {
    let line = this.answeredCount;
    for (let left = moveCount; line > 0 && left > 0; left -= this.commands.moveCounts[line]) line--;
    return line;
  }

  private feed(): void {
    const { lines, count } = this.commands;
    while (!this.isOver) {
      const end = this.checkDue;
      if (end === 0 && this.next === count) return;
      if (end === 0 && isFarAhead(this.commands.planS, this.answeredCount, this.next)) return;
      const line = end > 0 ? CHECK : lines[this.next];
      if (!this.session.hasRoom(line)) return;
      if (end > 0) {
        this.checkDue = 0;
        this.session.write(line, (error) => this.checked(end, error));
      } else {
        const index = this.next++;
        const isDue = line === SYNC || this.next === count;
        if (isDue && this.session.canCheck) this.checkDue = this.next;
        this.session.write(line, (error) => this.answered(index, error));
      }
    }
  }

  private answered(index: number, error: PlotwrightError | null): void {
    // The line was refused, since all other errors come after `broken`. Grbl would execute the lines after it.
    if (error) {
      if (!this.isOver) this.refused = index;
      return this.miss(this.commands.planS[index], error);
    }
    this.answeredCount = index + 1;
    if (this.session.canCheck) {
      if (!this.isOver) this.feed();
    } else this.done(this.answeredCount);
  }

  /** The answer to a check: the lines before `end` were all answered. */
  private checked(end: number, error: PlotwrightError | null): void {
    if (error) return this.miss(this.certainS, error);
    if (this.missedS === null) this.done(end);
  }

  /** The lines before `end` are accepted, and no answer is missing. */
  private done(end: number): void {
    const { planS, count, lines } = this.commands;
    // The reply to a wait comes when the wait and everything before it are done.
    if (lines[end - 1].startsWith("G4")) {
      this.certainS = planS[end];
      this.known = { planS: this.certainS, clockS: this.clock.nowS() };
    }
    if (this.isOver) return;
    if (end === count) this.finish();
    else this.feed();
  }

  /** Its last report shows whether it has drawn. */
  private finish(): void {
    const finished = (): void => {
      if (!this.isOver) this.settle(null);
    };
    // Without an answer the connection is lost, which settles it.
    this.session.status().then(finished, () => undefined);
  }

  /** Lines from `planS` on may not have been executed. */
  private miss(planS: number, error: PlotwrightError): void {
    if (this.isOver) return;
    this.missedS = planS;
    this.slowDown(error);
  }
}

/** Whether enough is sent ahead before the line `next`. At least one line always waits behind the first. */
const isFarAhead = (planS: ArrayLike<number>, answeredCount: number, next: number): boolean =>
  next > answeredCount + 1 && planS[next] - planS[answeredCount] >= AHEAD_S;
