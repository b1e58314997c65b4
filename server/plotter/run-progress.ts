/** How far a plot is: translates the place of whatever stream is playing into the terms of the whole plot. */
import {
  stateAt,
  type BoardState,
  type CommandStream,
  type MotionState,
  type Place,
  type StreamPlace,
  type Trajectory,
} from "../../src/index.js";
import { nearestTime, nextPlace, PlaceTimes, SAME_DISTANCE_MM } from "./plan-places.js";
import type { PlotProgress } from "./types.js";

/** A stretch of motion that is or will be streamed, and the plan that it came from. */
export interface Part {
  readonly commands: CommandStream;
  readonly trajectory: Trajectory;
  /** What the board holds before its first command. */
  readonly start: BoardState;
  /** What of the plot still follows its end: a way to rest ends in the middle of the drawing. */
  readonly afterS: number;
  /** What is drawn next after its end, by another part of the same stream; left out: nothing. */
  readonly next?: Place | null;
}

/** An instant of a part's plan. */
export interface Instant {
  readonly part: Part;
  readonly planS: number;
}

/** How far the host's picture of the board's time may be off, s. */
const AROUND_S = 1;
/** Of the parts left behind, these are remembered: a plan, the way to rest in it, and a change of heights. */
const LEFT_COUNT = 3;

export class RunProgress {
  latest: PlotProgress | null = null;
  /** The first place that is still to be drawn. */
  place: Place | null = null;

  private parts: Part[] = [];
  private part: Part | null = null;
  /** When in its plan the board was seen there last. */
  private partPlanS = 0;
  /** Parts that were left not long ago, the latest first, each with when it was. */
  private left: Instant[] = [];
  private firstTrajectory: Trajectory | null = null;
  private times: PlaceTimes | null = null;
  /** Of the parts that are over. */
  private doneS = 0;
  /** Of the part that plays. */
  private partS = 0;
  private partStartS = 0;
  private readonly motion: MotionState = {
    x: 0,
    y: 0,
    vx: 0,
    vy: 0,
    ax: 0,
    ay: 0,
    penUp: true,
    stroke: -1,
    alongMm: 0,
  };

  /**
   * What will be streamed are parts of this plan, which is the one that the page has. `from`: what lies before it
   * was drawn by an earlier run.
   */
  isPartOf(whole: Trajectory, times: PlaceTimes, from: Place | null): void {
    this.firstTrajectory = whole;
    this.times = times;
    if (from) this.doneS = times.timeOf(from) ?? 0;
  }

  /** A part that will be streamed; the first of all is the plan that the page has too, where that was not told. */
  add(part: Part): void {
    if (!this.firstTrajectory) {
      this.firstTrajectory = part.trajectory;
      this.times = new PlaceTimes(part.trajectory);
    }
    this.parts.push(part);
  }

  partOf(commands: CommandStream): Part {
    const found = this.parts.find((part) => part.commands === commands);
    if (!found) throw new TypeError("a stream plays that was never announced");
    return found;
  }

  /**
   * Where in which plan the board stands that was stopped at once at `x`, `y` when it seemed to be at `at`: it has
   * not got as far as the host believed, perhaps not to that part.
   */
  nearest(at: StreamPlace, x: number, y: number): Instant {
    let best: Instant | null = null;
    let bestMm = Infinity;
    for (const { part, planS } of this.around(at)) {
      const nearS = nearestTime(part.trajectory, planS, AROUND_S, x, y);
      const there = stateAt(part.trajectory, nearS, this.motion);
      const mm = Math.hypot(there.x - x, there.y - y);
      if (mm > bestMm - SAME_DISTANCE_MM) continue;
      best = { part, planS: nearS };
      bestMm = mm;
    }
    return best ?? { part: this.partOf(at.stream), planS: at.planS };
  }

  /** The part where it seems to be first, then those before and after it. */
  private around(at: StreamPlace): Instant[] {
    const seems = this.parts.findIndex((part) => part.commands === at.stream);
    const instants = this.parts.map((part, i): Instant => {
      const { planS, count } = part.commands;
      if (i === seems) return { part, planS: at.planS };
      if (part === this.part) return { part, planS: this.partPlanS };
      return { part, planS: planS[i < seems ? count : 0]! };
    });
    return [...instants.slice(seems, seems + 1), ...instants.filter((_, i) => i !== seems), ...this.left];
  }

  /** Where the board is now. */
  update(at: StreamPlace): PlotProgress {
    const part = this.partOf(at.stream);
    if (part !== this.part) this.enter(part, at.stream.planS[0]!);
    this.partS = Math.max(this.partS, at.planS - this.partStartS);
    this.partPlanS = at.planS;
    const now = stateAt(part.trajectory, at.planS, this.motion);
    const left =
      now.stroke >= 0 ? { stroke: now.stroke, alongMm: now.alongMm } : nextPlace(part.trajectory, at.planS);
    if (left) this.place = left;
    const elapsedS = this.doneS + this.partS;
    const remainingS = Math.max(0, part.trajectory.totalS - at.planS) + part.afterS;
    const progress = elapsedS + remainingS > 0 ? elapsedS / (elapsedS + remainingS) : 1;
    this.latest = {
      progress: Math.max(progress, this.latest?.progress ?? 0),
      elapsedS,
      remainingS,
      planS: this.firstPlanS(part, at.planS, now),
      xMm: now.x,
      yMm: now.y,
      penUp: now.penUp,
    };
    return this.latest;
  }

  private enter(part: Part, startS: number): void {
    this.doneS += this.partS;
    this.partS = 0;
    this.partStartS = startS;
    if (this.part) {
      this.left = [{ part: this.part, planS: this.partPlanS }, ...this.left].slice(0, LEFT_COUNT);
    }
    this.part = part;
    // What has been left is never played again.
    this.parts = this.parts.slice(this.parts.indexOf(part));
  }

  /** The same place's time in the first plan. */
  private firstPlanS({ trajectory, afterS }: Part, planS: number, now: MotionState): number {
    if (!this.firstTrajectory || trajectory === this.firstTrajectory) return planS;
    const timeS = now.stroke >= 0 ? this.times!.timeOf(now) : null;
    const leftS = trajectory.totalS - planS + afterS;
    return timeS ?? this.latest?.planS ?? Math.max(0, this.firstTrajectory.totalS - leftS);
  }
}
