/** Plays the lines of one job: sends as many ahead as fit into Grbl's buffer. */
import { PlotwrightError } from "../../../errors.js";
import { delay, type Clock } from "../../transport.js";
import type { GrblCommands } from "../grbl-job.js";
import { NOW, type Status } from "../protocol.js";
import type { GrblSession } from "./session.js";

/** Interval of status queries while waiting for rest, s. */
const POLL_S = 0.05;
const REST_TRIES = 200;

export class LineStream {
  /** Index of the next line to send. */
  private next = 0;
  private answeredCount = 0;
  /** Nothing more is sent. */
  isOver = false;
  /** Grbl restarted or stopped by itself, so its position is lost. */
  isBroken = false;
  private isSettled = false;
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
  ) {
    this.known = { planS: commands.planS[0], clockS: clock.nowS() };
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
        this.session.onBreak = null;
        if (error) reject(error);
        else resolve();
      };
      this.session.onBreak = (error) => {
        this.isBroken = true;
        this.settle(error);
      };
      this.feed();
    });
  }

  /** Estimated position, seconds along the plan: no further than the accepted lines. */
  get planS(): number {
    const { planS } = this.commands;
    const nowS = this.known.planS + (this.stopS ?? this.clock.nowS()) - this.known.clockS;
    return Math.min(
      Math.max(nowS, planS[Math.max(0, this.answeredCount - this.session.queueMoves)]),
      this.takenS,
    );
  }

  /** Bounds of the position, seconds along the plan. */
  get boundsS(): readonly [fromS: number, toS: number] {
    const { planS, count } = this.commands;
    const from = Math.max(0, this.answeredCount - this.session.queueMoves - 1);
    return [Math.max(planS[from], this.known.planS), planS[Math.min(count, this.answeredCount + 2)]];
  }

  /** Slows down along the path, then clears Grbl's queue. `play` rejects with the error. */
  slowDown(error: PlotwrightError): void {
    if (this.isOver) return;
    this.isOver = true;
    this.stopS = this.clock.nowS();
    this.session.now(NOW.hold);
    // Without an answer, clearing the queue fails too.
    void this.rest()
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

  private get takenS(): number {
    return this.commands.planS[this.answeredCount];
  }

  private async rest(): Promise<void> {
    for (let i = 0; i < REST_TRIES && !this.clearing; i++) {
      const { state } = await this.session.status();
      if (state === "Hold:0" || state === "Idle" || state.startsWith("Alarm")) return;
      await delay(this.clock, POLL_S);
    }
  }

  private feed(): void {
    const { lines, count } = this.commands;
    while (!this.isOver && this.next < count && this.session.hasRoom(lines[this.next])) {
      const index = this.next++;
      this.session.write(lines[index], (error) => this.answered(index, error));
    }
  }

  private answered(index: number, error: PlotwrightError | null): void {
    // The line was refused, since all other errors come after `onBreak`. Grbl would execute the lines after it.
    if (error) return this.slowDown(error);
    this.answeredCount = index + 1;
    // The reply to a wait comes when the wait and everything before it are done.
    if (this.commands.lines[index].startsWith("G4")) {
      this.known = { planS: this.takenS, clockS: this.clock.nowS() };
    }
    if (this.isOver) return;
    if (this.answeredCount === this.commands.count) this.settle(null);
    else this.feed();
  }
}
