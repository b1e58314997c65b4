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
export interface StreamPosition {
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

/** A part of a stream in which the board was, and an estimate of where; seconds of its plan. */
export interface StreamSpan {
  readonly stream: CommandStream;
  readonly fromS: number;
  readonly toS: number;
  /** It may be before or after the span. */
  readonly estimateS: number;
}

/** A command that the board refused. */
export interface RefusedCommand {
  readonly at: StreamPosition;
  /** The number of the command, or, if it takes no time, of the next one that does. */
  readonly number: number;
  readonly takesTime: boolean;
}

/** Data recorded at an emergency stop (ES). */
export interface StopNotes {
  /** Estimated board time when the stop was sent. */
  boardS: number;
  /** How many commands waited behind the running one just before the stop; null: not reported. */
  waitingCount: number | null;
}

/** The position in its stream of a command at a board time. */
export function positionIn({ stream, index, startS, endS }: InFlight, boardS: number): StreamPosition {
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

/** How far the board may be from the estimate of its time. Board seconds. */
const NEAR_S = 1;

/** Number of finished commands to keep: more than fit in a board's queue. */
const FINISHED_COUNT = 64;

export class BoardTimeline {
  /** Board time at which the last written command ends. */
  endS = 0;
  /** Number of commands written so far: the number of the next one. */
  writtenCount = 0;
  private readonly pace = new BoardPace();
  private flight: InFlight[] = [];
  /** The commands before those in `flight`. */
  private readonly finished: InFlight[] = [];
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

  /** Positions every `stepS` from now, at most `count`, to the end of what is written. */
  positionsAhead(stepS: number, count: number): StreamPosition[] {
    const positions: StreamPosition[] = [];
    const fromS = this.boardS();
    for (let k = 1; k <= count; k++) {
      const entry = this.at(fromS + k * stepS);
      if (!entry) break;
      positions.push(positionIn(entry, fromS + k * stepS));
    }
    return positions;
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

  /**
   * Where an emergency stop (ES) may have stopped the board. All written commands are answered by then.
   *
   *   [ended] [running] [or this] [waiting] [waiting]      the query just before ES reported 2 waiting commands
   *
   * The command before the waiting ones was running at the query. It may have ended before ES; then it was the next one.
   * Firmware 2.7 and 2.8 does not stop, but plays all received commands.
   *
   * Empty if the board certainly was beyond the first refused command. What it drew from there on is offset from the plan.
   */
  spansAtStop(
    { boardS, waitingCount }: StopNotes,
    stopEndsTimed: boolean,
    refused: readonly RefusedCommand[],
  ): StreamSpan[] {
    const isRefused = (number: number): boolean =>
      refused.some((one) => one.takesTime && one.number === number);
    const ran = this.recent().filter(({ number }) => !isRefused(number));
    let running = ran;
    if (!stopEndsTimed) running = ran.slice(-1);
    else if (waitingCount !== null) {
      const first = Math.max(0, ran.length - 1 - waitingCount);
      running = ran.slice(first, first + 2);
    }
    const onPlan = refused.length > 0 ? running.filter(({ number }) => number < refused[0].number) : running;
    return spansOf(onPlan, stopEndsTimed ? boardS : this.endS);
  }

  /** Where the board may have been at about a board time. */
  spansNear(boardS: number): StreamSpan[] {
    const isNear = ({ startS, endS }: InFlight): boolean =>
      endS >= boardS - NEAR_S && startS <= boardS + NEAR_S;
    return spansOf(this.recent().filter(isNear), boardS);
  }

  /** The last commands written: some finished ones, and those in flight. */
  private recent(): readonly InFlight[] {
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

/** Successive commands as parts of their streams. */
function spansOf(commands: readonly InFlight[], boardS: number): StreamSpan[] {
  const spans: StreamSpan[] = [];
  for (let first = 0, end = 0; first < commands.length; first = end) {
    const { stream, index, startS } = commands[first];
    while (end < commands.length && commands[end].stream === stream) end++;
    const last = commands[end - 1];
    const running = commands.slice(first, end).find((command) => boardS < command.endS) ?? last;
    const outsideS = Math.min(0, boardS - startS) + Math.max(0, boardS - last.endS);
    const estimateS = positionIn(running, boardS).planS + outsideS;
    spans.push({ stream, fromS: stream.planS[index], toS: stream.planS[last.index + 1], estimateS });
  }
  return spans;
}
