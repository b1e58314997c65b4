/** Progress of a plot: translates the position in the current stream into a position in the whole plot. */
import { nextPlace } from "../plan/place-on-plan.js";
import { PlaceTimes } from "../plan/place-times.js";
import {
  newMotionState,
  stateAt,
  type MotionState,
  type Place,
  type Trajectory,
} from "../plan/trajectory.js";
import type { MachineCommands } from "./machine-job.js";

export interface PlotProgress {
  /** Of the whole plot's time, 0 … 1. */
  readonly progress: number;
  readonly elapsedS: number;
  readonly remainingS: number;
  /** Seconds along the first, whole trajectory. */
  readonly planS: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  /** The pen is still on its way up or down. */
  readonly penMoving: boolean;
}

/** A stretch of motion that is or will be streamed, and the plan that it belongs to. */
export interface Part {
  readonly commands: MachineCommands;
  readonly trajectory: Trajectory;
  /** Time of the plot after the end of this stretch: a path to rest ends in the middle of the drawing. */
  readonly afterS: number;
  /** What the next part of the same stream draws after this one; left out: nothing. */
  readonly next?: Place | null;
}

/** Number of past parts to remember: a plan, the path to rest in it, and a change of heights. */
const LEFT_COUNT = 3;

/** `P`: what a driver stores with each part. */
export class RunProgress<P extends Part = Part> {
  latest: PlotProgress | null = null;
  /** The first place that is still to be drawn. */
  place: Place | null = null;

  private parts: P[] = [];
  private part: P | null = null;
  private firstTrajectory: Trajectory | null = null;
  private times: PlaceTimes | null = null;
  /** Underruns of the parts that are over. */
  private doneS = 0;
  /** Underruns of the current part. */
  private partS = 0;
  private partStartS = 0;
  private readonly motion = newMotionState();

  /**
   * What will be streamed are parts of this plan, the one that the page has. `from`: an earlier run drew
   * everything before it.
   */
  isPartOf(whole: Trajectory, times: PlaceTimes, from: Place | null): void {
    this.firstTrajectory = whole;
    this.times = times;
    if (from) this.doneS = times.timeOf(from) ?? 0;
  }

  /** A part that will be streamed. The first part of all is the page's plan too, unless another was reported. */
  add(part: P): void {
    if (!this.firstTrajectory) {
      this.firstTrajectory = part.trajectory;
      this.times = new PlaceTimes(part.trajectory);
    }
    this.parts.push(part);
  }

  /** Older parts are forgotten. */
  knows(commands: MachineCommands): boolean {
    return this.parts.some((part) => part.commands === commands);
  }

  partOf(commands: MachineCommands): P {
    const found = this.parts.find((part) => part.commands === commands);
    if (!found) throw new TypeError("a stream plays that was never announced");
    return found;
  }

  /** Current position of the board. */
  update(at: { readonly stream: MachineCommands; readonly planS: number }): PlotProgress {
    const part = this.partOf(at.stream);
    if (part !== this.part) this.enter(part, at.stream.planS[0]);
    this.partS = Math.max(this.partS, at.planS - this.partStartS);
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
      penMoving: now.penMoving,
    };
    return this.latest;
  }

  /** While held: the plot resumes from another place. Null while the plan's times are unknown. */
  movedTo(place: Place, at: Pick<PlotProgress, "xMm" | "yMm" | "penUp">): PlotProgress | null {
    const doneS = this.times?.timeOf(place) ?? null;
    if (doneS === null || !this.firstTrajectory) return null;
    const { totalS } = this.firstTrajectory;
    this.place = place;
    this.part = null;
    this.partS = 0;
    this.doneS = doneS;
    const { xMm, yMm, penUp } = at;
    const times = { elapsedS: doneS, remainingS: totalS - doneS, planS: doneS };
    this.latest = { progress: doneS / totalS, ...times, xMm, yMm, penUp, penMoving: false };
    return this.latest;
  }

  private enter(part: P, startS: number): void {
    this.doneS += this.partS;
    this.partS = 0;
    this.partStartS = startS;
    this.part = part;
    // A part that was left is never played again. The board may be less far than it seems.
    this.parts = this.parts.slice(Math.max(0, this.parts.indexOf(part) - LEFT_COUNT));
  }

  /** The time of the same place in the first plan. */
  private firstPlanS({ trajectory, afterS }: Part, planS: number, now: MotionState): number {
    if (!this.firstTrajectory || trajectory === this.firstTrajectory) return planS;
    const timeS = now.stroke >= 0 ? this.times!.timeOf(now) : null;
    const leftS = trajectory.totalS - planS + afterS;
    return timeS ?? this.latest?.planS ?? Math.max(0, this.firstTrajectory.totalS - leftS);
  }
}
