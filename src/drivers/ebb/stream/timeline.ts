/**
 * What the board has been given and where it is on its way through it: the host's picture of board time.
 *
 * Commands that take time follow one another on the board's time line. Which of them runs now is estimated from
 * the clock, and put right by what the board lets us know: its answers (a full queue frees a place when a command
 * ends) and, when asked, how many commands still wait.
 *
 *    acknowledged ──────────────────────┐   unacknowledged: the queue before them is full
 *    [begun][running][waits in the queue]  [in the system's buffers]
 */
import type { CommandStream } from "../compile/command-stream.js";
import { BoardPace } from "./board-pace.js";
import type { Clock } from "../../transport.js";

/** Where in which stream the board is. */
export interface StreamPlace {
  readonly stream: CommandStream;
  readonly commandIndex: number;
  /** Trajectory seconds of `stream`. */
  readonly planS: number;
}

/** A command that takes board time, written and not yet known to be over. */
export interface InFlight {
  readonly number: number;
  readonly startS: number;
  readonly endS: number;
  readonly writtenS: number;
  readonly stream: CommandStream;
  readonly index: number;
}

/** An answer later than this after the write means that the board's queue was full. Board seconds. */
const WAITED_S = 0.02;
/** How long an estimate of the board's time may be ahead of what it acknowledges. */
const ACK_SLACK_S = 0.05;

/** Commands remembered that should be over: some more than a board can still have. */
const KEPT_COUNT = 64;

export class BoardTimeline {
  /** Where the last command written ends. */
  endS = 0;
  private readonly pace = new BoardPace();
  private flight: InFlight[] = [];
  /** Those before them. */
  private readonly over: InFlight[] = [];
  private writtenCount = 0;
  private ackedCount = 0;
  /** The command that polls find executing, and since when. */
  private executing = -1;
  private executingSinceS = 0;

  constructor(
    private readonly clock: Clock,
    private readonly queueDepth: number,
    private readonly stuckS: number,
  ) {}

  /**
   * Estimated board time. Where an answer is overdue, the board may not have got that command at all: then it plays
   * what it has acknowledged and stops there.
   */
  boardS(): number {
    const nowS = this.clock.nowS();
    const estimateS = Math.min(this.pace.boardS(nowS), this.endS);
    const unacked = this.entry(this.ackedCount);
    if (!unacked || nowS - unacked.writtenS < WAITED_S) return estimateS;
    // Number n without an answer may also mean that the queue before it is full: n − depth has not begun.
    const blocked = this.entry(this.ackedCount - this.queueDepth);
    const begunS = blocked ? blocked.startS + ACK_SLACK_S : Infinity;
    return Math.min(estimateS, begunS, unacked.startS);
  }

  /** Commands written and not known to be over. */
  get count(): number {
    return this.flight.length;
  }

  get first(): InFlight | undefined {
    return this.flight[0];
  }

  /** The command under way at a board time; undefined after the last one. */
  at(boardS: number): InFlight | undefined {
    // An overdue answer takes the estimate back: what seemed to be over may not be.
    return this.recent().find((entry) => boardS < entry.endS);
  }

  /** The longest that the board can rightly keep silent: its queue frees a place when a command ends. */
  longestS(): number {
    let longestS = 0;
    for (const entry of this.flight) longestS = Math.max(longestS, entry.endS - entry.startS);
    return longestS;
  }

  /** A command is written that runs in [startS, endS]. Returns how long the board has stood dry before it, s. */
  written(stream: CommandStream, index: number, startS: number, endS: number): number {
    const nowS = this.clock.nowS();
    const dryS = this.pace.written(startS, nowS);
    this.flight.push({ number: this.writtenCount, startS, endS, writtenS: nowS, stream, index });
    this.writtenCount++;
    this.endS = endS;
    return dryS;
  }

  /** The next command is acknowledged: the one that left its place in the queue has begun. */
  acknowledged(): void {
    const nowS = this.clock.nowS();
    const entry = this.entry(this.ackedCount);
    const begun = this.entry(this.ackedCount - this.queueDepth);
    this.ackedCount++;
    if (entry && begun) this.pace.acknowledged(begun.startS, nowS, nowS - entry.writtenS > WAITED_S);
  }

  /** The board says how many commands wait: that puts the time line right from both sides. True: it is stuck. */
  waiting(count: number): boolean {
    const nowS = this.clock.nowS();
    const executing = this.entry(this.ackedCount - 1 - count);
    if (!executing) return false;
    this.pace.begun(executing.startS, nowS);
    if (count === 0) return false;
    this.pace.notEnded(executing.endS, nowS);
    if (executing.number !== this.executing) {
      this.executing = executing.number;
      this.executingSinceS = nowS;
    }
    return nowS - this.executingSinceS > executing.endS - executing.startS + this.stuckS;
  }

  forgetExecuted(boardS: number): void {
    const isOver = ({ endS, number }: InFlight): boolean => endS <= boardS && number < this.ackedCount;
    let over = 0;
    while (over < this.flight.length && isOver(this.flight[over]!)) over++;
    if (over > 0) this.over.push(...this.flight.splice(0, over));
    if (this.over.length > 2 * KEPT_COUNT) this.over.splice(0, this.over.length - KEPT_COUNT);
  }

  /** The commands written last, those in flight and some that should be over. */
  recent(): readonly InFlight[] {
    return [...this.over, ...this.flight];
  }

  /** One of the commands written last, by its number. */
  private entry(number: number): InFlight | undefined {
    const firstNumber = this.flight[0]?.number ?? this.writtenCount;
    return number < firstNumber
      ? this.over[this.over.length - (firstNumber - number)]
      : this.flight[number - firstNumber];
  }
}
