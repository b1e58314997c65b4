/**
 * The sender of a live drawing whose plotter another program has: a server, or the host of a page. It takes strokes as
 * `LiveStrokes` does, and sends them as far as there is room.
 */
import { PlotwrightError } from "../../src/index.js";
import { machineOf } from "../../src/internal.js";
import {
  LIVE_POINTS_MAX,
  type Job,
  type LiveBegin,
  type LiveMessage,
  type LiveProgress,
  type LiveReport,
  type LiveUndone,
} from "../../src/schema/index.js";
import { flat, liveEnded, mustReach, type LivePoints } from "../plotter/live-strokes.js";
import { Waiters } from "../plotter/waiters.js";

/** A connection for one live drawing. */
export interface LiveLink {
  send(message: LiveMessage): void;
  close(): void;
}

/** Opens a connection. `lost`: called when it ends before the last report. */
export type OpenLiveLink = (
  report: (report: LiveReport) => void,
  lost: (error: PlotwrightError) => void,
) => Promise<LiveLink>;

interface Undoing {
  /** Points that were not sent yet. */
  readonly points: number;
  readonly resolve: (undone: LiveUndone) => void;
  readonly reject: (error: Error) => void;
}

interface Queued {
  readonly message: LiveMessage;
  points: number;
  /** Number of the stroke that it belongs to. */
  readonly stroke: number;
}

export class LiveSender {
  /** When it began. */
  readonly job: Job;
  /** Resolves with the job when the drawing has ended: in the history, or interrupted. Rejects if the connection is lost. */
  readonly ended: Promise<Job>;
  /** The latest report; null: there is none yet. */
  progress: LiveProgress | null = null;
  private settle!: { readonly resolve: (job: Job) => void; readonly reject: (error: Error) => void };
  /** What there is no room for yet. */
  private queue: Queued[] = [];
  private sentCount = 0;
  private takenCount = 0;
  private roomAtLast: number;
  /** The last stroke may get more points. */
  private isOpen = false;
  private isEnded = false;
  private strokeCount = 0;
  /** Number of the last stroke of which something is sent. */
  private sentStroke = 0;
  private failure: Error | null = null;
  /** Sends the queue. */
  private timer: ReturnType<typeof setTimeout> | null = null;
  /** Undos that the plotter has not answered. */
  private undoing: Undoing[] = [];
  private readonly waiters = new Waiters();
  private readonly listeners = new Set<(report: LiveReport) => void>();

  private constructor(
    { job, room }: Pick<Extract<LiveReport, { type: "begun" }>, "job" | "room">,
    private readonly link: LiveLink,
  ) {
    this.job = job;
    this.roomAtLast = room;
    this.ended = new Promise((resolve, reject) => {
      this.settle = { resolve, reject };
    });
    this.ended.catch(() => undefined);
  }

  /** Rejects with the reason why the drawing can't begin. */
  static begin(open: OpenLiveLink, wanted: LiveBegin): Promise<LiveSender> {
    return new Promise((resolve, reject) => {
      let sender: LiveSender | null = null;
      let link: LiveLink;
      const take = (report: LiveReport): void => {
        if (report.type === "begun") resolve((sender = new LiveSender(report, link)));
        else if (sender !== null) sender.take(report);
        else if (report.type === "error") reject(new PlotwrightError(report.code, report.message));
      };
      const lost = (error: PlotwrightError): void => (sender === null ? reject(error) : sender.fail(error));
      open(take, lost).then((opened) => {
        link = opened;
        link.send({ begin: wanted });
      }, reject);
    });
  }

  get hasFailed(): boolean {
    return this.failure !== null;
  }

  /** Calls `listener` with each report. The returned function ends that. */
  onReport(listener: (report: LiveReport) => void): () => void {
    this.listeners.add(listener);
    return () => void this.listeners.delete(listener);
  }

  /** Adds a whole stroke. One that grows is complete. Throws `out-of-bounds`, and then adds nothing. */
  stroke(points: LivePoints): void {
    const xy = flat(points);
    this.check(xy);
    const all = Array.from({ length: xy.length / 2 }, (_, i): [number, number] => [xy[2 * i], xy[2 * i + 1]]);
    this.penUp();
    this.strokeCount++;
    if (all.length <= LIVE_POINTS_MAX) return this.add({ stroke: all }, all.length);
    for (const point of all) this.addPoint(point);
    this.isOpen = true;
    this.penUp();
  }

  /** Adds a point to the stroke that grows, or begins one. Throws `out-of-bounds`, and then adds nothing. */
  lineTo(x: number, y: number): void {
    this.check([x, y]);
    if (!this.isOpen) this.strokeCount++;
    this.isOpen = true;
    this.addPoint([x, y]);
  }

  /** The stroke that grows is complete. */
  penUp(): void {
    if (!this.isOpen) return;
    this.isOpen = false;
    this.add({ penUp: true }, 0);
  }

  /** Takes back the last stroke, as far as the plot can still leave it out. What is left of it is complete. */
  undo(): Promise<LiveUndone> {
    this.mustTakeMore();
    this.isOpen = false;
    const mine = this.queue.filter(({ stroke }) => stroke === this.strokeCount);
    this.queue = this.queue.filter(({ stroke }) => stroke !== this.strokeCount);
    const points = mine.reduce((sum, one) => sum + one.points, 0);
    if (this.sentStroke < this.strokeCount && points > 0) {
      this.strokeCount--;
      return Promise.resolve({ takenBack: points, left: 0 });
    }
    return new Promise((resolve, reject) => {
      this.undoing.push({ points, resolve, reject });
      this.add({ undo: true }, 0);
    });
  }

  /** The drawing is complete. */
  end(): void {
    this.mustTakeMore();
    this.penUp();
    this.isEnded = true;
    this.add({ end: true }, 0);
  }

  /** Resolves when there is room for more points. */
  room(): Promise<void> {
    return this.waiters.until(() => this.roomLeft > this.queue.reduce((sum, { points }) => sum + points, 0));
  }

  /** Resolves when everything so far is drawn. */
  idle(): Promise<void> {
    return this.waiters.until(
      () =>
        this.queue.length === 0 &&
        this.takenCount === this.sentCount &&
        (this.sentCount === 0 || this.progress?.state === "waiting"),
    );
  }

  /** Gives up the connection: the plotter then has lost its sender. */
  close(): void {
    const then = this.isEnded ? "Its job is drawn to the end." : "Its job waits.";
    const words = `The connection of this live drawing was closed. ${then}`;
    this.fail(new PlotwrightError("disconnected", words));
    this.link.close();
  }

  private get roomLeft(): number {
    return this.roomAtLast - (this.sentCount - this.takenCount);
  }

  private add(message: LiveMessage, points: number): void {
    this.queue.push({ message, points, stroke: this.strokeCount });
    this.flush();
  }

  /** Points that come together are sent together. */
  private addPoint(point: readonly [number, number]): void {
    const last = this.queue.at(-1);
    const points: [number, number][] = [[point[0], point[1]]];
    if (last !== undefined && last.stroke === this.strokeCount && "lineTo" in last.message) {
      const before = last.message.lineTo as [number, number][];
      if (before.length < LIVE_POINTS_MAX) {
        before.push(...points);
        last.points++;
        return;
      }
    }
    this.queue.push({ message: { lineTo: points }, points: 1, stroke: this.strokeCount });
    this.timer ??= setTimeout(() => this.flush(), 0);
  }

  private flush(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    let count = 0;
    for (const { message, points, stroke } of this.queue) {
      if (points > this.roomLeft) break;
      this.sentCount += points;
      if (points > 0) this.sentStroke = stroke;
      this.link.send(message);
      count++;
    }
    if (count > 0) this.queue.splice(0, count);
    this.waiters.check();
  }

  private take(report: LiveReport): void {
    if (report.type === "progress") {
      this.progress = report;
      this.takenCount = report.taken;
      this.roomAtLast = report.room;
      this.flush();
    } else if (report.type === "undone") {
      const asked = this.undoing.shift();
      asked?.resolve({ takenBack: asked.points + report.takenBack, left: report.left });
    } else if (report.type === "error") this.fail(new PlotwrightError(report.code, report.message));
    else if (report.type === "ended") this.finish(report.job);
    for (const listener of this.listeners) listener(report);
  }

  private finish(job: Job): void {
    const { state, message } = job;
    this.settle.resolve(job);
    this.failure ??= state === "done" ? liveEnded() : endedOtherwise(state, message);
    this.stop(state === "done" ? true : this.failure);
    this.link.close();
  }

  private fail(error: Error): void {
    this.failure ??= error;
    this.settle.reject(this.failure);
    this.stop(this.failure);
  }

  /** Nothing will be sent or answered any more. */
  private stop(how: Error | true): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.queue = [];
    for (const { reject } of this.undoing) reject(this.failure!);
    this.undoing = [];
    this.waiters.end(how);
  }

  private check(xy: ArrayLike<number>): void {
    this.mustTakeMore();
    mustReach(xy, machineOf(this.job.settings));
  }

  private mustTakeMore(): void {
    if (this.failure) throw this.failure;
    if (this.isEnded) throw liveEnded();
  }
}

/** Why a job that is not done takes no more strokes. */
export function endedOtherwise(state: Job["state"], message: string | null): PlotwrightError {
  if (state === "cancelled") return new PlotwrightError("cancelled", "The live drawing was cancelled.");
  return new PlotwrightError(
    state === "failed" ? "board-error" : "disconnected",
    message ?? "The live drawing was interrupted.",
  );
}
