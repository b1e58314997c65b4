/**
 * Sends command streams ahead of the board's time (see send-window.ts) instead of waiting for each acknowledgement.
 *
 * A stream can be cut at any unsent command and replaced by another while the board plays what it has received, so a hold,
 * a change of speed or a resume causes no gap. Times are board times on the injected clock: with a virtual board that runs
 * 20 times faster, that clock runs 20 times faster too.
 */
import { commandLine } from "../compile/compile.js";
import type { CommandStream } from "../compile/command-stream.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { parseSteps, waitingCount } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";
import { stuck } from "../../faults.js";
import { delay } from "../../transport.js";
import { endOfLowering } from "./cut-streams.js";
import { MIN_WAKE_S, SendWindow, type CommandTime, type SendOptions } from "./send-window.js";
import type { BoardSession, Outgoing } from "./session.js";
import type { PollTime, StreamOptions, StreamReport } from "./stream-types.js";
import {
  BoardTimeline,
  positionIn,
  type RefusedCommand,
  type StopNotes,
  type StreamPosition,
  type StreamSpan,
} from "./timeline.js";

const STOP_TRIES = 3;
/** Shorter underruns cannot be distinguished from the connection's latency. */
const DRY_S = 0.002;
const IDLE_POLL_S = 0.02;

export class Streamer {
  /** Number of times that the board ran out of commands during a run. */
  underrunCount = 0;
  /** The commands that the board refused. They never ran, but those written after them may have. */
  readonly refused: RefusedCommand[] = [];

  private readonly session: BoardSession;
  private readonly options: SendOptions & StreamOptions;
  private readonly timeline: BoardTimeline;
  private readonly sendWindow: SendWindow;

  private stream: CommandStream | null = null;
  private next = 0;
  /** Board time at second 0 of `stream`. */
  private offsetS = 0;
  /** Commands from `atIndex` on are not written; the streams in `then`, if any, continue from there. */
  private limit: { readonly atIndex: number; readonly then: readonly CommandStream[] } | null = null;
  private unanswered = 0;
  private lastWritten: StreamPosition | null = null;
  private cancelWake: (() => void) | null = null;
  private cancelPoll: (() => void) | null = null;
  private betweenDueS = -Infinity;
  private ending = false;
  private failure: PlotwrightError | null = null;
  /** The board's queue was cleared. */
  private isStopped = false;
  private stop: StopNotes | null = null;
  private settle: { resolve(report: StreamReport): void; reject(error: PlotwrightError): void } | null = null;

  constructor(session: BoardSession, options: StreamOptions) {
    this.session = session;
    this.options = { windowS: 0.3, queueDepth: 1, stuckS: 2, ...options };
    const { clock, queueDepth, stuckS } = this.options;
    this.timeline = new BoardTimeline(clock, queueDepth, stuckS);
    this.sendWindow = new SendWindow(this.options, this.timeline);
  }

  /**
   * Plays a stream to its end, or to a cut without a replacement. Resolves when the board is idle and its
   * step counters have been read. Rejects if a command is refused or the board is lost or stuck.
   */
  play(stream: CommandStream): Promise<StreamReport> {
    if (this.settle) throw new TypeError("a stream is already being played");
    return new Promise((resolve, reject) => {
      this.settle = { resolve, reject };
      this.lastWritten = null;
      this.schedulePoll();
      this.take([stream]);
    });
  }

  /** Index of the first command not written yet. */
  get nextIndex(): number {
    return this.next;
  }

  /** True if other streams are set to follow the current one, without a later cut. */
  get isSwitching(): boolean {
    return this.playing && (this.limit?.then.length ?? 0) > 0;
  }

  /** The stream of the command `nextIndex`. */
  get nextStream(): CommandStream {
    if (!this.stream) throw new TypeError("nothing is being played");
    return this.stream;
  }

  /** Stops writing the stream. Returns the position of the first command that is not sent. */
  cut(): StreamPosition {
    const stream = this.stream;
    if (!stream || !this.playing) throw new TypeError("nothing is being played");
    this.limit = { atIndex: this.next, then: [] };
    // Not at once, so that the caller can replace the stream first.
    this.sleep(0);
    return { stream, commandIndex: this.next, planS: stream.planS[this.next] };
  }

  /**
   * Ends the stream before `atIndex`, or continues there with other streams in sequence. The first must be compiled from
   * the state at that command. Returns false if the command has already been written.
   */
  cutAt(atIndex: number, ...then: readonly CommandStream[]): boolean {
    if (!this.playing || this.next > atIndex) return false;
    this.limit = { atIndex, then };
    this.pump();
    return true;
  }

  /** After a cut: continues with streams compiled from the state at the cut. False if the board has stopped. */
  replace(...then: readonly CommandStream[]): boolean {
    return this.cutAt(this.next, ...then);
  }

  /** True while a stream can still be cut and replaced without a stop. */
  get playing(): boolean {
    return this.settle !== null && !this.ending;
  }

  /** Duration of the sent commands that the board has not executed yet, seconds. */
  inFlightS(): number {
    return Math.max(0, this.timeline.endS - this.timeline.boardS());
  }

  /** Estimated current position of the board. */
  position(): StreamPosition {
    const boardS = this.timeline.boardS();
    const entry = this.timeline.at(boardS);
    return entry ? positionIn(entry, boardS) : this.endOfWritten();
  }

  /** Estimated positions every `stepS` from now, at most `count`, to the end of what is written. None after a stop at once. */
  positionsAhead(stepS: number, count: number): StreamPosition[] {
    return this.isStopped ? [] : this.timeline.positionsAhead(stepS, count);
  }

  /** The end of what the board has acknowledged and plays unless it is stopped; null after a stop at once. */
  receivedPlace(): StreamPosition | null {
    if (this.isStopped) return null;
    const entry = this.timeline.unacknowledged;
    return entry ? positionIn(entry, entry.startS) : this.endOfWritten();
  }

  private endOfWritten(): StreamPosition {
    if (this.lastWritten) {
      const { stream, commandIndex } = this.lastWritten;
      return { stream, commandIndex, planS: stream.planS[commandIndex + 1] };
    }
    if (!this.stream) throw new TypeError("nothing has been played");
    return { stream: this.stream, commandIndex: 0, planS: this.stream.planS[0] };
  }

  /**
   * Makes the board stop at once and clear its queue (ES), which it must not draw later; `play` rejects with `error`.
   * Afterwards `spansAtStop` tells where that was.
   */
  stopAtOnce(error: PlotwrightError): void {
    const stop: StopNotes = { boardS: 0, waitingCount: null };
    this.stop ??= stop;
    this.writeStop(stop);
    this.abandon(error);
  }

  /** Asks for the queue, clears it, and lifts the pen. Repeated if the board refuses it, because of noise on the line. */
  private writeStop(stop: StopNotes, tries = STOP_TRIES): void {
    const { queueDepth, liftLine } = this.options;
    const waitS = this.timeline.longestS();
    const query = queueDepth > 1 ? "QU,6" : "QM";
    stop.boardS = this.timeline.boardS();
    // A lost connection carries no stop.
    this.isStopped ||= this.session.failure === null;
    this.session.write([
      {
        line: query,
        waitS,
        onReply: (error, reply) => (stop.waitingCount = error ? null : waitingCount(query, reply)),
      },
      {
        line: "ES",
        waitS,
        onReply: (error) => {
          if (error && !this.session.failure && tries > 1) this.writeStop(stop, tries - 1);
        },
      },
      ...(liftLine === undefined ? [] : [{ line: liftLine, waitS }]),
    ]);
  }

  /** Where the board may have been at the emergency stop; if it had refused commands, no further than the first one. */
  spansAtStop({ stopEndsTimed }: FirmwareFeatures): readonly StreamSpan[] {
    if (!this.stop) throw new TypeError("nothing was stopped");
    const spans = this.timeline.spansAtStop(this.stop, stopEndsTimed, this.refused);
    if (spans.length > 0) return spans;
    const { stream, planS } = this.refused[0]?.at ?? this.endOfWritten();
    return [{ stream, fromS: planS, toS: planS, estimateS: planS }];
  }

  /** Where the board may have been when it answered a poll. */
  spansAt({ boardS }: PollTime): readonly StreamSpan[] {
    return this.timeline.spansNear(boardS);
  }

  /** Begins the first of these streams; the others follow it. */
  private take([stream, ...then]: readonly CommandStream[]): void {
    this.stream = stream;
    this.next = 0;
    this.offsetS = this.timeline.endS - stream.boardS[0];
    this.limit = then.length > 0 ? { atIndex: stream.count, then } : null;
    this.pump();
  }

  /** Writes the commands that are due, and sleeps until the next is due. */
  private pump(): void {
    this.cancelWake?.();
    this.cancelWake = null;
    const { stream } = this;
    // A reply may arrive after the end.
    if (this.failure || this.ending || !stream || !this.settle) return;
    const boardS = this.timeline.boardS();
    this.timeline.forgetExecuted(boardS);
    const batch: Outgoing[] = [];
    const endIndex = this.limit?.atIndex ?? stream.count;
    while (this.next < endIndex) {
      const end = Math.min(endIndex, endOfLowering(stream, this.next));
      const time = this.timeOf(stream, this.next);
      if (!this.sendWindow.mayWrite(time, end - this.next, boardS, this.unanswered)) break;
      for (; this.next < end; this.next++) {
        batch.push(...this.queriesBefore(stream.boardS[this.next]), this.outgoing(stream, this.next));
      }
    }
    if (batch.length > 0) this.session.write(batch);
    if (this.next < endIndex) this.sleep(this.sendWindow.wakeInS(this.timeOf(stream, this.next), boardS));
    else if (this.limit && this.limit.then.length > 0) this.take(this.limit.then);
    else this.awaitEnd(boardS);
  }

  /** The queries between two commands, if they are due. */
  private queriesBefore(commandS: number): Outgoing[] {
    const { between } = this.options;
    if (!between || this.offsetS + commandS < this.betweenDueS) return [];
    this.betweenDueS = this.offsetS + commandS + between.everyS;
    return this.queries(between.lines);
  }

  private timeOf(stream: CommandStream, index: number): CommandTime {
    return { startS: this.offsetS + stream.boardS[index], endS: this.offsetS + stream.boardS[index + 1] };
  }

  private outgoing(stream: CommandStream, index: number): Outgoing {
    const { startS, endS } = this.timeOf(stream, index);
    const takesTime = endS !== startS;
    const place = { stream, commandIndex: index, planS: stream.planS[index] };
    const waitS = this.timeline.longestS();
    const number = this.timeline.writtenCount;
    const dryS = takesTime ? this.timeline.written(stream, index, startS, endS) : 0;
    if (dryS > DRY_S && this.isSameRun(stream, index)) this.underrunCount++;
    this.unanswered++;
    this.lastWritten = place;
    const onReply: Outgoing["onReply"] = (error) => this.answered(error, { at: place, number, takesTime });
    return { line: commandLine(stream, index), waitS, onReply };
  }

  private isSameRun(stream: CommandStream, index: number): boolean {
    const last = this.lastWritten;
    const run = stream.run[index];
    if (!last || run < 0) return false;
    if (last.stream === stream) return stream.run[last.commandIndex] === run;
    // A stream that replaced another in motion continues the run that was cut.
    return last.stream.run[last.commandIndex] >= 0 && index === 0;
  }

  private answered(error: PlotwrightError | null, command: RefusedCommand): void {
    this.unanswered--;
    if (error && this.session.failure) return this.abandon(error);
    if (error) return this.refuse(command, error);
    if (command.takesTime) this.timeline.acknowledged();
    this.pump();
  }

  /** Stops the plot: everything after a refused command would be drawn in the wrong place. */
  private refuse(command: RefusedCommand, error: PlotwrightError): void {
    this.refused.push(command);
    // More may be refused before the board reads the stop.
    if (!this.failure) this.stopAtOnce(error);
  }

  private sleep(delayS: number): void {
    // A lost connection refuses the commands at once.
    if (this.failure) return;
    this.cancelWake?.();
    this.cancelWake = this.options.clock.after(delayS, () => this.pump());
  }

  private schedulePoll(): void {
    const { poll, clock } = this.options;
    // The last reply may arrive after the end.
    if (!poll || !this.playing) return;
    this.cancelPoll?.();
    this.cancelPoll = clock.after(poll.everyS, () => {
      if (this.playing) this.poll(() => this.schedulePoll());
    });
  }

  /** `done` is called with the reply to the last line, also if it is an error. */
  private poll(done?: () => void): void {
    this.session.write(this.queries(this.options.poll?.lines ?? [], done));
  }

  private queries(lines: readonly string[], done: () => void = () => undefined): Outgoing[] {
    const { clock } = this.options;
    const waitS = this.timeline.longestS();
    const asked: PollTime = { clockS: clock.nowS(), boardS: this.timeline.boardS(), place: this.position() };
    return lines.map((line, i) => ({
      line,
      waitS,
      onReply: (error, reply) => {
        if (!error) this.polled(line, reply, asked, i === 0);
        if (i === lines.length - 1) done();
      },
    }));
  }

  private polled(line: string, reply: string, asked: PollTime, isFirst: boolean): void {
    if (!this.settle) return;
    this.options.onPoll?.(line, reply, asked);
    const waiting = isFirst ? waitingCount(line, reply) : null;
    if (waiting !== null && this.timeline.waiting(waiting, asked.clockS)) {
      this.stopAtOnce(stuck());
    }
    if (!this.failure) this.pump();
  }

  /** Called when everything has been written: sleeps until the last command should be done, then queries the board. */
  private awaitEnd(boardS: number): void {
    if (this.ending) return;
    const leftS = this.timeline.endS - boardS;
    if (this.unanswered > 0 || leftS > 0) {
      // The last replies wake the streamer. The timer does so too, because the time estimate may be wrong.
      if (this.unanswered === 0) this.sleep(Math.max(MIN_WAKE_S, leftS));
      return;
    }
    this.ending = true;
    this.cancelPoll?.();
    void this.finish();
  }

  private async finish(): Promise<void> {
    try {
      await this.untilIdle();
      // The motors' supply may have failed since the last poll. The board answers this one before the report.
      this.poll();
      const report = await this.report();
      this.ending = false;
      const settle = this.settle;
      this.settle = null;
      settle?.resolve(report);
    } catch (error) {
      this.abandon(error instanceof PlotwrightError ? error : internal(error));
    }
  }

  private async untilIdle(): Promise<void> {
    const { clock, stuckS } = this.options;
    const untilS = clock.nowS() + stuckS;
    for (;;) {
      const isLast = clock.nowS() > untilS;
      const fields = (await this.session.query("QM")).split(",");
      if (fields.every((field) => field === "0")) return;
      if (isLast) throw stuck();
      await delay(clock, IDLE_POLL_S);
    }
  }

  private async report(): Promise<StreamReport> {
    const stream = this.stream!;
    const end = this.lastWritten ?? { stream, commandIndex: -1, planS: stream.planS[0] };
    const complete = this.next >= stream.count;
    const steps = await this.readSteps();
    const exact =
      steps === null ||
      end.commandIndex < 0 ||
      (steps[0] === end.stream.steps1[end.commandIndex] && steps[1] === end.stream.steps2[end.commandIndex]);
    return { steps1: steps?.[0] ?? null, steps2: steps?.[1] ?? null, exact, end, complete };
  }

  private async readSteps(): Promise<readonly [number, number] | null> {
    try {
      return parseSteps(await this.session.query("QS"), this.options.origin);
    } catch (error) {
      // Firmware before 2.4.3 does not report step counters.
      if (this.session.failure) throw error;
      return null;
    }
  }

  /** Stops writing and waiting. The board finishes the commands it has received. */
  abandon(error: PlotwrightError): void {
    if (this.failure) return;
    this.failure = error;
    this.cancelWake?.();
    this.cancelPoll?.();
    const settle = this.settle;
    this.settle = null;
    settle?.reject(error);
  }
}

const internal = (cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "internal",
    "Sending commands to the board failed because of an internal error: connect again, set home and plot again.",
    { cause },
  );
