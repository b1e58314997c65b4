/**
 * The commands sent to the board, and the host's estimate of which one is running.
 *
 * Each command has a start and end in board time. The running one is estimated from the clock, and corrected by the
 * board's replies (a full queue has a free slot when a command ends) and by the number of waiting commands that it
 * reports.
 *
 *    acknowledged ──────────────────────┐   unacknowledged: the queue before them is full
 *    [begun][running][waits in the queue]  [in the system's buffers]
 */
import type { CommandStream } from "../compile/command-stream.js";
import { BoardPace } from "./board-pace.js";
import type { Clock } from "../../transport.js";

/** A position in a stream. */
export interface StreamPlace {
  readonly stream: CommandStream;
  readonly commandIndex: number;
  /** Trajectory seconds of `stream`. */
  readonly planS: number;
}

/** A written command that takes board time and may not be finished yet. */
export interface InFlight {
  readonly number: number;
  readonly startS: number;
  readonly endS: number;
  readonly writtenS: number;
  readonly stream: CommandStream;
  readonly index: number;
}

/** The position in its stream of a command at a board time. */
export function placeIn({ stream, index, startS, endS }: InFlight, boardS: number): StreamPlace {
  const share = Math.min(1, Math.max(0, (boardS - startS) / (endS - startS)));
  const fromS = stream.planS[index];
  return { stream, commandIndex: index, planS: fromS + share * (stream.planS[index + 1] - fromS) };
}

/**
 * If a reply takes longer than this, the board's queue was full. Board seconds.
 */
const WAITED_S = 0.02;
/** How far the estimate of the board's time may be ahead of its acknowledgements. Board seconds. */
const ACK_SLACK_S = 0.05;

/** Number of finished commands to keep: more than fit in a board's queue. */
const FINISHED_COUNT = 64;

export class BoardTimeline {
  /** Board time at which the last written command ends. */
  endS = 0;
  private readonly pace = new BoardPace();
  private flight: InFlight[] = [];
  /** The commands before those in `flight`. */
  private readonly finished: InFlight[] = [];
  private writtenCount = 0;
  private ackedCount = 0;
  /** The number of the command that polls report as executing, and since when. */
  private executing = -1;
  private executingSinceS = 0;

  constructor(
    private readonly clock: Clock,
    private readonly queueDepth: number,
    private readonly stuckS: number,
  ) {}

  /**
   * Estimated board time. If a reply is overdue, the board may not have received that command: then it plays
   * the acknowledged commands and stops there.
   */
  boardS(): number {
    const nowS = this.clock.nowS();
    const estimateS = Math.min(this.pace.boardS(nowS), this.endS);
    const unacked = this.entry(this.ackedCount);
    if (!unacked || nowS - unacked.writtenS < WAITED_S) return estimateS;
    // If command n has no reply because the queue before it is full, command n − depth is the running one.
    const blocked = this.entry(this.ackedCount - this.queueDepth);
    const begunS = blocked ? blocked.startS + ACK_SLACK_S : Infinity;
    return Math.min(estimateS, begunS, unacked.startS);
  }

  /** Number of written commands that may not be finished. */
  get count(): number {
    return this.flight.length;
  }

  get first(): InFlight | undefined {
    return this.flight[0];
  }

  /** The command that runs at a board time; undefined after the last one. */
  at(boardS: number): InFlight | undefined {
    // An overdue reply moves the estimate back, so a command that seemed finished may still be running.
    return this.recent().find((entry) => boardS < entry.endS);
  }

  /** The first command that the board has not acknowledged. */
  get unacknowledged(): InFlight | undefined {
    return this.entry(this.ackedCount);
  }

  /** Max time that the board may take to reply: its queue frees a slot when a command ends. */
  longestS(): number {
    let longestS = 0;
    for (const entry of this.flight) longestS = Math.max(longestS, entry.endS - entry.startS);
    return longestS;
  }

  /** A command that runs in [startS, endS] was written. Returns the underrun before it, seconds. */
  written(stream: CommandStream, index: number, startS: number, endS: number): number {
    const nowS = this.clock.nowS();
    const dryS = this.pace.written(startS, nowS);
    this.flight.push({ number: this.writtenCount, startS, endS, writtenS: nowS, stream, index });
    this.writtenCount++;
    this.endS = endS;
    return dryS;
  }

  /** The next command was acknowledged, so the command that freed its slot in the queue has begun. */
  acknowledged(): void {
    const nowS = this.clock.nowS();
    const entry = this.entry(this.ackedCount);
    const begun = this.entry(this.ackedCount - this.queueDepth);
    this.ackedCount++;
    if (entry && begun) this.pace.acknowledged(begun.startS, nowS, nowS - entry.writtenS > WAITED_S);
  }

  /**
   * The board reports how many commands wait, which bounds its time from both sides. `askedS`: the time of the query.
   * Returns true if the board is stuck.
   */
  waiting(count: number, askedS: number): boolean {
    const nowS = this.clock.nowS();
    const executing = this.entry(this.ackedCount - 1 - count);
    if (!executing) return false;
    this.pace.begun(executing.startS, nowS);
    if (count === 0) return false;
    // A busy host reads the reply late, so only the time of the query is certain.
    this.pace.notEnded(executing.endS, askedS);
    if (executing.number !== this.executing) {
      this.executing = executing.number;
      this.executingSinceS = nowS;
    }
    return askedS - this.executingSinceS > executing.endS - executing.startS + this.stuckS;
  }

  forgetExecuted(boardS: number): void {
    const isOver = ({ endS, number }: InFlight): boolean => endS <= boardS && number < this.ackedCount;
    let count = 0;
    while (count < this.flight.length && isOver(this.flight[count])) count++;
    if (count > 0) this.finished.push(...this.flight.splice(0, count));
    const { finished } = this;
    if (finished.length > 2 * FINISHED_COUNT) finished.splice(0, finished.length - FINISHED_COUNT);
  }

  /** The last commands written: some finished ones, and those in flight. */
  recent(): readonly InFlight[] {
    return [...this.finished, ...this.flight];
  }

  /** One of the last commands written, by its number. */
  private entry(number: number): InFlight | undefined {
    const firstNumber = this.flight[0]?.number ?? this.writtenCount;
    return number < firstNumber
      ? this.finished[this.finished.length - (firstNumber - number)]
      : this.flight[number - firstNumber];
  }
}
