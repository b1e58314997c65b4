/** One live drawing, as its sender sees it: takes the messages, and reports. Over whatever connection they come. */
import { PlotwrightError } from "../../src/index.js";
import {
  liveMessageSchema,
  type LiveBegin,
  type LiveMessage,
  type LiveReport,
} from "../../src/schema/index.js";
import { parseWith } from "../parse-with.js";
import { faultOf } from "../planning/messages.js";
import type { LiveJob } from "../queue/live-jobs.js";

/** Time between two reports of the progress. */
const REPORT_MS = 100;

export class LiveSession {
  private live: LiveJob | null = null;
  private isBeginning = false;
  /** Nothing more is taken or reported. */
  private isOver = false;
  private taken = 0;
  /** When the points came that are not drawn: how many there were then. */
  private readonly arrivals: { readonly points: number; readonly atMs: number }[] = [];
  /** Messages that brought neither a point nor the end of a stroke. Of the others there are as many as there is room for. */
  emptyMessages = 0;
  private lastProgress = "";
  private timer: ReturnType<typeof setInterval> | null = null;

  /** `report`: sends to the sender. After "ended" or "error" the connection is to be closed. */
  constructor(
    private readonly begin: (wanted: LiveBegin) => Promise<LiveJob>,
    private readonly report: (report: LiveReport) => void,
  ) {}

  get isDrawing(): boolean {
    return this.live !== null && !this.isOver;
  }

  /** A message, not checked yet. */
  take(message: unknown): void {
    if (this.isOver) return;
    try {
      this.perform(parseWith(liveMessageSchema, message));
    } catch (error) {
      this.fail(error);
    }
  }

  /** A sender that does not answer: the pen is lifted until it does. */
  set isSilent(isSilent: boolean) {
    this.live?.hold(isSilent);
  }

  /** Ends the session with an error, which the sender gets. */
  fail(error: unknown): void {
    if (this.isOver) return;
    this.report({ type: "error", ...faultOf(error) });
    this.close();
  }

  /** The connection has ended. Without `end` before, the sender is lost. */
  close(): void {
    this.isOver = true;
    if (this.timer !== null) clearInterval(this.timer);
    this.live?.senderLost();
  }

  private perform(message: LiveMessage): void {
    if ("begin" in message) return this.start(message.begin);
    if (this.live === null) {
      throw new PlotwrightError("bad-setting", "A live drawing starts with begin. Wait until it has begun.");
    }
    const { strokes } = this.live;
    const { allPoints } = strokes;
    const ends = "penUp" in message && strokes.isOpen;
    if ("lineTo" in message) {
      const points = isPoint(message.lineTo) ? [message.lineTo] : message.lineTo;
      for (const [x, y] of points) this.add(1, () => strokes.lineTo(x, y));
    } else if ("stroke" in message) this.add(message.stroke.length, () => strokes.stroke(message.stroke));
    else if ("penUp" in message) strokes.penUp();
    else if ("undo" in message) {
      const undone = strokes.undo();
      this.forgetArrivals();
      this.report({ type: "undone", ...undone });
      this.progress();
    } else strokes.end();
    if (strokes.allPoints <= allPoints && !ends) this.emptyMessages++;
  }

  private start(wanted: LiveBegin): void {
    if (this.live !== null || this.isBeginning) {
      throw new PlotwrightError("conflict", "This live drawing has begun already.");
    }
    this.isBeginning = true;
    this.begin(wanted).then(
      (live) => this.begun(live),
      (error: unknown) => this.fail(error),
    );
  }

  private begun(live: LiveJob): void {
    this.live = live;
    void live.ended.then((job) => {
      if (this.isOver) return;
      this.progress();
      this.report({ type: "ended", job });
      this.close();
    });
    if (this.isOver) return live.senderLost();
    this.report({ type: "begun", job: live.job, room: live.strokes.roomLeft });
    this.timer = setInterval(() => this.progress(), REPORT_MS);
  }

  /** A stroke that can't be drawn is left out, and the drawing goes on. */
  private add(points: number, add: () => void): void {
    const { strokes } = this.live!;
    if (points > strokes.roomLeft) {
      throw new PlotwrightError(
        "too-large",
        `More points were sent than there was room for (${strokes.roomLeft}). Keep at most "room" points ahead of "taken".`,
      );
    }
    this.taken += points;
    try {
      add();
    } catch (error) {
      if (strokes.hasFailed) return;
      this.report({ type: "refused", ...faultOf(error) });
      return;
    }
    this.arrivals.push({ points: strokes.allPoints, atMs: Date.now() });
  }

  private progress(): void {
    if (this.live === null) return;
    const { strokes, isPaused } = this.live;
    const progress = {
      taken: this.taken,
      room: strokes.roomLeft,
      points: strokes.allPoints,
      drawn: strokes.allDrawn,
      drawnTo: strokes.drawnPlace,
      lagMs: this.measuredLagMs(),
      state: isPaused ? "paused" : strokes.isAllDrawn ? "waiting" : "drawing",
    } as const;
    const text = JSON.stringify(progress);
    if (text === this.lastProgress) return;
    this.lastProgress = text;
    this.report({ type: "progress", ...progress });
  }

  /** How long ago the first point came that is not drawn. */
  private measuredLagMs(): number {
    const { arrivals } = this;
    const { allDrawn, isAllDrawn } = this.live!.strokes;
    const next = arrivals.findIndex(({ points }) => points > allDrawn);
    arrivals.splice(0, next < 0 ? arrivals.length : next);
    // The clock of the computer may be set back.
    return isAllDrawn || arrivals.length === 0 ? 0 : Math.max(0, Math.round(Date.now() - arrivals[0].atMs));
  }

  /** Points that were taken back will not be drawn. */
  private forgetArrivals(): void {
    const { allPoints } = this.live!.strokes;
    while ((this.arrivals.at(-1)?.points ?? 0) > allPoints) this.arrivals.pop();
  }
}

const isPoint = (value: readonly unknown[]): value is readonly [number, number] =>
  typeof value[0] === "number";
