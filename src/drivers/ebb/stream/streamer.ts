/**
 * Sends command streams by a window of board time instead of by acknowledgement.
 *
 * Board, USB and system buffers together always hold about `windowS` of motion (0.8 of it to, for commands of
 * 150 ms, 1.3 times as much), so the board goes on while the host is stalled. The price: on firmware with a queue of one, the board's parser stands blocked behind
 * what was written ahead, and an emergency stop waits for it. Hence a window of 0.3 s, not 3 s. Where the
 * board's own queue is deeper, no more is written than it can take, and a stop is read at once.
 *
 *      executed        executing     waiting in the board      not yet written
 *   ───────────────|───────^──────|────────────────────────|- - - - - - - - - -
 *                  board time now  <------- windowS ------->
 *
 * Time here is board time on the driver's clock: with a virtual board that runs 20 times faster, the clock
 * given in runs 20 times faster too. A stream can be cut at any command and another put in its place while
 * the board plays what it has: so a hold, a change of speed and a resume need no gap.
 */
import { commandLine } from "../compile/compile.js";
import type { CommandStream } from "../compile/command-stream.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { parseSteps, stepsLeft, waitingCount } from "../protocol/replies.js";
import { PlotwrightError } from "../../../errors.js";
import type { BoardSession, Outgoing } from "./session.js";
import { placeOfCounters, placeOfStop, type NumberedPlace, type StopNotes } from "./stop-place.js";
import type { PollTime, RefusedCommand, StreamOptions, StreamReport } from "./stream-types.js";
import { BoardTimeline, type InFlight, type StreamPlace } from "./timeline.js";

/** Wake-ups closer than this are one. */
const MIN_WAKE_S = 0.004;
/** Dryness too short to tell from the line's own delay. */
const DRY_S = 0.002;
const IDLE_POLL_S = 0.02;
/** Of the window: so much motion is always ahead, also where the next command is longer than the rest of it. */
const RESERVE_SHARE = 0.8;

/**
 * Seconds of motion that are ahead of the pen at most, with commands of up to `commandS`: the window, or its reserve
 * and one command, or one command that runs and one that waits.
 */
export const mostAheadS = (windowS: number, commandS: number): number =>
  Math.max(windowS, RESERVE_SHARE * windowS + commandS, 2 * commandS);

export class Streamer {
  /** Times that the board ran dry in the middle of a run. */
  underrunCount = 0;
  /** Seconds that it stood still for that. */
  underrunS = 0;
  /** A command that the board has refused: it never ran, though those written after it may have. */
  refused: RefusedCommand | null = null;

  private readonly session: BoardSession;
  private readonly options: Required<Pick<StreamOptions, "clock" | "windowS" | "queueDepth" | "stuckS">> &
    StreamOptions;
  private readonly timeline: BoardTimeline;

  private stream: CommandStream | null = null;
  private next = 0;
  /** Board time line at `stream`'s second 0. */
  private offsetS = 0;
  /** Nothing from `atIndex` on is written; the streams of `then`, when there are any, go on from there. */
  private limit: { readonly atIndex: number; readonly then: readonly CommandStream[] } | null = null;
  private unanswered = 0;
  private lastWritten: StreamPlace | null = null;
  private cancelWake: (() => void) | null = null;
  private cancelPoll: (() => void) | null = null;
  private ending = false;
  private failure: PlotwrightError | null = null;
  private stop: StopNotes | null = null;
  private settle: { resolve(report: StreamReport): void; reject(error: PlotwrightError): void } | null = null;

  constructor(session: BoardSession, options: StreamOptions) {
    this.session = session;
    this.options = { windowS: 0.3, queueDepth: 1, stuckS: 2, ...options };
    const { clock, queueDepth, stuckS } = this.options;
    this.timeline = new BoardTimeline(clock, queueDepth, stuckS);
  }

  /**
   * Plays a stream to its end, or to a cut that nothing follows: resolves when the board is idle and its
   * step counters have been read. Rejects when a command is refused or the board is lost or stuck.
   */
  play(stream: CommandStream): Promise<StreamReport> {
    if (this.settle) throw new TypeError("a stream is already being played");
    return new Promise((resolve, reject) => {
      this.settle = { resolve, reject };
      this.lastWritten = null;
      this.schedulePoll();
      this.take(stream, []);
    });
  }

  /** The first command not written yet. */
  get nextIndex(): number {
    return this.next;
  }

  /** Other streams follow the present one already, and nothing was cut since. */
  get isGoingOver(): boolean {
    return this.playing && (this.limit?.then.length ?? 0) > 0;
  }

  /** The stream that it belongs to. */
  get nextStream(): CommandStream {
    if (!this.stream) throw new TypeError("nothing is being played");
    return this.stream;
  }

  /** Writes nothing more of the stream. Returns the first command that the board will not get. */
  cut(): StreamPlace {
    const stream = this.stream;
    if (!stream || !this.playing) throw new TypeError("nothing is being played");
    this.limit = { atIndex: this.next, then: [] };
    // Not before the caller has had the chance to put another stream in its place.
    this.sleep(0);
    return { stream, commandIndex: this.next, planS: stream.planS[this.next]! };
  }

  /**
   * Ends the stream before `atIndex`, or goes over to other streams there, one after the other; the first was
   * compiled from the state at that command. False when the command has been written already: too late.
   */
  cutAt(atIndex: number, ...then: readonly CommandStream[]): boolean {
    if (!this.playing || this.next > atIndex) return false;
    this.limit = { atIndex, then };
    this.pump();
    return true;
  }

  /** After a cut: goes on with streams compiled from the state at the cut. False: the board has come to rest. */
  replace(...then: readonly CommandStream[]): boolean {
    return this.cutAt(this.next, ...then);
  }

  /** True while a stream can still be cut and replaced without the board coming to rest. */
  get playing(): boolean {
    return this.settle !== null && !this.ending;
  }

  /** Motion that the board still has to play, seconds. */
  inFlightS(): number {
    return Math.max(0, this.timeline.endS - this.timeline.boardS());
  }

  /** Where the board is now, by its time line. */
  place(): StreamPlace {
    const boardS = this.timeline.boardS();
    const entry = this.timeline.at(boardS);
    if (entry) {
      const share = Math.max(0, (boardS - entry.startS) / (entry.endS - entry.startS));
      const fromS = entry.stream.planS[entry.index]!;
      const toS = entry.stream.planS[entry.index + 1]!;
      return { stream: entry.stream, commandIndex: entry.index, planS: fromS + share * (toS - fromS) };
    }
    if (this.lastWritten) {
      const { stream, commandIndex } = this.lastWritten;
      return { stream, commandIndex, planS: stream.planS[commandIndex + 1]! };
    }
    if (!this.stream) throw new TypeError("nothing has been played");
    return { stream: this.stream, commandIndex: 0, planS: this.stream.planS[0]! };
  }

  /**
   * Tells the board to drop what it has (ES); `play` rejects with `error`. Where it was then, `placeOfStop` tells from the
   * step counters read after this.
   */
  stopAtOnce(error: PlotwrightError): void {
    const query = this.options.queueDepth > 1 ? "QU,6" : "QM";
    const waitS = this.timeline.longestS();
    const stop: StopNotes = { boardS: this.timeline.boardS(), waitingCount: null, stepsLeft: null };
    this.stop ??= stop;
    const note = (line: string, take: (reply: string) => void): Outgoing => ({
      line,
      waitS,
      onReply: (failed, reply) => {
        if (!failed) take(reply);
      },
    });
    this.session.write([
      note(query, (reply) => (stop.waitingCount = waitingCount(query, reply))),
      note("ES", (reply) => (stop.stepsLeft = stepsLeft(reply))),
    ]);
    this.fail(error);
  }

  /** Where the board was when it stopped at once; null when it had nothing to run. */
  placeOfStop(features: FirmwareFeatures, steps1: number, steps2: number): NumberedPlace | null {
    if (!this.stop) throw new TypeError("nothing was stopped");
    const refused = this.refused?.command ?? null;
    return placeOfStop({ ...this.stop, commands: this.timeline.recent(), refused }, features, steps1, steps2);
  }

  /** Where the board was when it answered a poll with these counters; null where its commands do not pass there. */
  placeOfCounters(
    features: FirmwareFeatures,
    steps1: number,
    steps2: number,
    asked: PollTime,
  ): StreamPlace | null {
    return placeOfCounters(this.timeline.recent(), features, steps1, steps2, asked.boardS);
  }

  /** Stops writing and gives up waiting; what the board has is not touched. */
  abandon(error: PlotwrightError): void {
    this.fail(error);
  }

  private take(stream: CommandStream, followers: readonly CommandStream[]): void {
    this.stream = stream;
    this.next = 0;
    this.offsetS = this.timeline.endS - stream.boardS[0]!;
    this.limit = followers.length > 0 ? { atIndex: stream.count, then: followers } : null;
    this.pump();
  }

  private takeNext(then: readonly CommandStream[]): void {
    this.take(then[0]!, then.slice(1));
  }

  /** Writes what is due, and sleeps until more is. */
  private pump(): void {
    this.cancelWake?.();
    this.cancelWake = null;
    const { stream } = this;
    // Without a stream: an answer that comes when the play is over.
    if (this.failure || this.ending || !stream) return;
    const boardS = this.timeline.boardS();
    this.timeline.forgetExecuted(boardS);
    const batch: Outgoing[] = [];
    const endIndex = this.limit?.atIndex ?? stream.count;
    while (this.next < endIndex && this.mayWrite(stream, boardS)) {
      batch.push(this.outgoing(stream, this.next));
      this.next++;
    }
    if (batch.length > 0) this.session.write(batch);
    if (this.next < endIndex) this.sleep(this.wakeInS(stream, boardS));
    else if (this.limit && this.limit.then.length > 0) this.takeNext(this.limit.then);
    else this.awaitEnd(boardS);
  }

  private mayWrite(stream: CommandStream, boardS: number): boolean {
    if (this.options.pacing === "acks") return this.unanswered === 0;
    const waiting = this.timeline.count;
    // One whole command always waits behind the executing one, however long they are.
    if (waiting < 2) return true;
    if (this.options.queueDepth > 1 && waiting >= this.options.queueDepth) return false;
    return this.dueS(stream) <= boardS;
  }

  /**
   * Board time at which the next command is to be written: when it ends within the window, and a long one
   * before what is ahead of it has shrunk to the window's reserve.
   */
  private dueS(stream: CommandStream): number {
    const { windowS } = this.options;
    const startS = this.offsetS + stream.boardS[this.next]!;
    const endS = this.offsetS + stream.boardS[this.next + 1]!;
    return Math.min(endS - windowS, startS - RESERVE_SHARE * windowS);
  }

  /** Until the next command comes into the window, or the executing one ends. */
  private wakeInS(stream: CommandStream, boardS: number): number {
    if (this.options.pacing === "acks") return this.options.stuckS;
    const dueInS = this.dueS(stream) - boardS;
    const executing = this.timeline.first;
    const endsInS = executing ? executing.endS - boardS : 0;
    return Math.max(MIN_WAKE_S, Math.min(dueInS > 0 ? dueInS : endsInS, Math.max(endsInS, 0)));
  }

  private outgoing(stream: CommandStream, index: number): Outgoing {
    const line = commandLine(stream, index);
    const startS = this.offsetS + stream.boardS[index]!;
    const endS = this.offsetS + stream.boardS[index + 1]!;
    this.unanswered++;
    const place = { stream, commandIndex: index, planS: stream.planS[index]! };
    if (endS === startS) {
      this.lastWritten = place;
      return {
        line,
        waitS: this.timeline.longestS(),
        onReply: (error) => this.answered(error, place, false),
      };
    }
    const waitS = this.timeline.longestS();
    const dryS = this.timeline.written(stream, index, startS, endS);
    if (dryS > DRY_S && this.isSameRun(stream, index)) {
      this.underrunCount++;
      this.underrunS += dryS;
    }
    this.lastWritten = place;
    return { line, waitS, onReply: (error) => this.answered(error, place, true) };
  }

  private isSameRun(stream: CommandStream, index: number): boolean {
    const last = this.lastWritten;
    const run = stream.run[index]!;
    if (!last || run < 0) return false;
    if (last.stream === stream) return stream.run[last.commandIndex] === run;
    // A stream that replaced another in motion goes on with the run that was cut.
    return last.stream.run[last.commandIndex]! >= 0 && index === 0;
  }

  private answered(error: PlotwrightError | null, at: StreamPlace, takesTime: boolean): void {
    this.unanswered--;
    if (error) {
      if (this.session.failure) this.fail(error);
      else this.refusedAt(at, error);
      return;
    }
    if (takesTime) this.timeline.acknowledged();
    this.pump();
  }

  /** What follows a refused command would be drawn beside its place. */
  private refusedAt(at: StreamPlace, error: PlotwrightError): void {
    if (this.failure) return;
    const isIt = ({ stream, index }: InFlight): boolean => stream === at.stream && index === at.commandIndex;
    this.refused = { at, command: this.timeline.recent().find(isIt) ?? null };
    this.stopAtOnce(error);
  }

  private sleep(delayS: number): void {
    this.cancelWake?.();
    this.cancelWake = this.options.clock.after(delayS, () => this.pump());
  }

  private schedulePoll(): void {
    const poll = this.options.poll;
    // An answer may come when the play is over: then it is the last.
    if (!poll || !this.playing) return;
    this.cancelPoll?.();
    this.cancelPoll = this.options.clock.after(poll.everyS, () => {
      if (!this.playing) return;
      const waitS = this.timeline.longestS();
      const last = poll.lines.length - 1;
      const asked: PollTime = { boardS: this.timeline.boardS(), place: this.place() };
      this.session.write(
        poll.lines.map((line, i) => ({
          line,
          waitS,
          onReply: (error, reply) => {
            if (!error) this.polled(line, reply, asked, i === 0);
            if (i === last) this.schedulePoll();
          },
        })),
      );
    });
  }

  private polled(line: string, reply: string, asked: PollTime, tellsTime: boolean): void {
    if (!this.playing) return;
    this.options.onPoll?.(line, reply, asked);
    const waiting = tellsTime ? waitingCount(line, reply) : null;
    if (waiting !== null && this.timeline.waiting(waiting)) {
      // What it still holds must not be drawn when it gets on again.
      this.session.write([{ line: "ES" }]);
      this.fail(stuck());
    }
    if (!this.failure) this.pump();
  }

  /** All that there is has been written: sleeps until the last of it should be over, then asks. */
  private awaitEnd(boardS: number): void {
    if (this.ending) return;
    const leftS = this.timeline.endS - boardS;
    if (this.unanswered > 0 || leftS > 0) {
      // The last answers wake us; so does time, for a board whose time we have misjudged.
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
      const report = await this.report();
      this.stream = null;
      this.ending = false;
      const settle = this.settle;
      this.settle = null;
      settle?.resolve(report);
    } catch (error) {
      this.fail(error instanceof PlotwrightError ? error : internal(error));
    }
  }

  private async untilIdle(): Promise<void> {
    const clock = this.options.clock;
    const startS = clock.nowS();
    for (;;) {
      const fields = (await this.session.query("QM")).split(",");
      if (fields.every((field) => field === "0")) return;
      if (clock.nowS() - startS > this.options.stuckS) throw stuck();
      await new Promise<void>((resolve) => void clock.after(IDLE_POLL_S, resolve));
    }
  }

  private async report(): Promise<StreamReport> {
    const stream = this.stream!;
    const end = this.lastWritten ?? { stream, commandIndex: -1, planS: stream.planS[0]! };
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
      const [counter1, counter2] = parseSteps(await this.session.query("QS"));
      const [origin1, origin2] = this.options.origin ?? [0, 0];
      return [counter1 + origin1, counter2 + origin2];
    } catch (error) {
      // Firmware before 2.4.3 has no step counters to ask for.
      if (this.session.failure) throw error;
      return null;
    }
  }

  private fail(error: PlotwrightError): void {
    if (this.failure) return;
    this.failure = error;
    this.cancelWake?.();
    this.cancelPoll?.();
    const settle = this.settle;
    this.settle = null;
    settle?.reject(error);
  }
}

const stuck = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The board answers but does not finish its motion: press its reset button or unplug it, set home and plot again.",
  );

const internal = (cause: unknown): PlotwrightError =>
  new PlotwrightError("internal", "The stream to the board broke off for a reason of our own.", { cause });
