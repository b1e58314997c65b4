/**
 * Where the plotter's pen is between two reports. A report tells where the pen is and where it goes in the next moments,
 * as far as motion was sent to the machine. So the pen is shown on its real path at every frame of the screen, and it
 * rests when the machine has nothing left to do. Times are ms of the page's clock. No DOM.
 */
import { AHEAD_STEP_MS, type PenMoment } from "../../../src/internal.js";
import type { ServerEvent } from "../../../src/schema/index.js";

export type PenReport = Pick<
  Extract<ServerEvent, { type: "progress" }>,
  keyof PenMoment | "atMs" | "heldBackMs" | "ahead"
>;

/** The pen at one moment. */
export interface PenPlace {
  readonly xMm: number;
  readonly yMm: number;
  /** Completely down: neither up nor moving. */
  readonly penDown: boolean;
  /** Time in the job's plan; null outside a plot. */
  readonly planS: number | null;
  /** It will be somewhere else in the next frame. */
  readonly isMoving: boolean;
}

/** The last reports, by which the delay of the connection is measured. */
const REPORTS = 40;
/** A delay that is longer by this belongs to another clock: the server was started again. */
const OTHER_CLOCK_MS = 500;
/** A difference between what was shown and a new report fades with this time constant. */
const FADE_MS = 60;
/** A longer difference is not a correction, but another place. */
const CORRECTION_MM = 20;
const FADED_MM = 0.01;
/** If the plan's time falls by more than this, the plot went back. Less is the rounding of an estimate. */
const WENT_BACK_S = 0.5;

export class PenGlide {
  /** Host's time to page's time, ms, of each of the last reports: the shortest has waited least on its way. */
  private delays: number[] = [];
  /** One place every `AHEAD_STEP_MS` from `fromMs`. */
  private track: readonly PenMoment[] = [];
  private fromMs = 0;
  private isPlot = false;
  /** What was shown minus what the newest report says, at its arrival. */
  private offMm = { x: 0, y: 0, sinceMs: 0 };
  private shownS = -Infinity;

  /** A report of a running plot has arrived. */
  report(report: PenReport, nowMs: number): void {
    const delay = nowMs - report.heldBackMs - report.atMs;
    if (delay > Math.min(...this.delays) + OTHER_CLOCK_MS) this.delays = [];
    this.delays = [...this.delays.slice(1 - REPORTS), delay];
    const fromMs = report.atMs + Math.min(...this.delays);
    this.follow([report, ...report.ahead], fromMs, true, nowMs);
  }

  /** The pen is at rest, or moved by hand. */
  put(place: Omit<PenMoment, "planS">, nowMs: number): void {
    this.follow([{ ...place, planS: 0 }], nowMs, false, nowMs);
  }

  /** The position is unknown. */
  forget(): void {
    this.track = [];
  }

  at(nowMs: number): PenPlace | null {
    const last = this.track.length - 1;
    if (last < 0) return null;
    const steps = Math.min(last, Math.max(0, (nowMs - this.fromMs) / AHEAD_STEP_MS));
    const before = this.track[Math.floor(steps)];
    const after = this.track[Math.ceil(steps)];
    const share = steps % 1;
    const between = (a: number, b: number): number => a + share * (b - a);
    const left = Math.exp(-(nowMs - this.offMm.sinceMs) / FADE_MS);
    const [offX, offY] = [this.offMm.x * left, this.offMm.y * left];
    const planS = between(before.planS, after.planS);
    this.shownS = planS > this.shownS - WENT_BACK_S ? Math.max(planS, this.shownS) : planS;
    return {
      xMm: between(before.xMm, after.xMm) + offX,
      yMm: between(before.yMm, after.yMm) + offY,
      penDown: !before.penUp && !before.penMoving,
      planS: this.isPlot ? this.shownS : null,
      isMoving: steps < last || Math.hypot(offX, offY) > FADED_MM,
    };
  }

  private follow(track: readonly PenMoment[], fromMs: number, isPlot: boolean, nowMs: number): void {
    const shown = this.at(nowMs);
    this.track = track;
    this.fromMs = fromMs;
    if (!isPlot || track.length === 1) this.shownS = -Infinity;
    this.isPlot = isPlot;
    this.offMm = { x: 0, y: 0, sinceMs: nowMs };
    const now = this.at(nowMs);
    if (!shown || !now) return;
    const [x, y] = [shown.xMm - now.xMm, shown.yMm - now.yMm];
    if (Math.hypot(x, y) < CORRECTION_MM) this.offMm = { x, y, sinceMs: nowMs };
  }
}
