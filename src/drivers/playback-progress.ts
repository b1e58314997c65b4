/** Progress of a plot: translates the position in the current stream into a position in the whole plot. */
import { PositionTimes, nextPosition } from "../position/on-plan.js";
import {
  newMotionState,
  stateAt,
  type MotionState,
  type StrokePosition,
  type Trajectory,
} from "../plan/trajectory.js";
import type { MachineCommands } from "./machine-job.js";

/** The pen at one moment of a plot. */
export interface PenMoment {
  /** Seconds along the first, whole trajectory. */
  readonly planS: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  /** The pen is still on its way up or down. */
  readonly penMoving: boolean;
}

export interface PlotProgress extends PenMoment {
  /** Share of the whole plot's time, 0 … 1. */
  readonly progress: number;
  readonly elapsedS: number;
  readonly remainingS: number;
}

/** Time between two moments that are reported ahead, in real ms. */
export const AHEAD_STEP_MS = 20;

/** A position of the machine in its commands. */
interface CommandPosition {
  readonly stream: MachineCommands;
  /** Seconds along their plan. */
  readonly planS: number;
}

/** A section of motion that is or will be streamed, and its plan. */
export interface PlanPart {
  readonly commands: MachineCommands;
  readonly trajectory: Trajectory;
  /** Time of the plot after the end of this part. Not 0 for a path to rest, which ends in the middle of the drawing. */
  readonly afterS: number;
  /** Where the next part of the same stream begins to draw; left out: no part follows. */
  readonly next?: StrokePosition | null;
}

/** Number of past parts to keep: a plan, the path to rest in it, and a change of heights. */
export const PAST_PARTS = 3;
/** The same for a plan that grows several times while the machine performs what was sent ahead. */
export const PAST_PARTS_GROWING = 40;

/** `P`: what a driver stores with each part. */
export class PlaybackProgress<P extends PlanPart = PlanPart> {
  latest: PlotProgress | null = null;
  /** The first place that is still to be drawn. */
  place: StrokePosition | null = null;

  private parts: P[] = [];
  private part: P | null = null;
  private firstTrajectory: Trajectory | null = null;
  private times: PositionTimes | null = null;
  /** Elapsed time of the finished parts. */
  private doneS = 0;
  /** Elapsed time of the current part. */
  private partS = 0;
  private partStartS = 0;
  private readonly motion = newMotionState();

  constructor(private readonly pastParts = PAST_PARTS) {}

  /**
   * Sets the plan that the page shows; all parts that are streamed belong to it. `from`: an earlier run drew everything
   * before this place.
   */
  setWhole(whole: Trajectory, times: PositionTimes, from: StrokePosition | null): void {
    this.firstTrajectory = whole;
    this.times = times;
    if (from) this.doneS = times.timeOf(from) ?? 0;
  }

  /** Adds a part that will be streamed. Without `setWhole`, the first part is the plan that the page shows. */
  add(part: P): void {
    if (!this.firstTrajectory) {
      this.firstTrajectory = part.trajectory;
      this.times = new PositionTimes(part.trajectory);
    }
    this.parts.push(part);
  }

  /** Forgets a part of which nothing was sent. */
  remove(part: P): void {
    this.parts = this.parts.filter((one) => one !== part);
  }

  /** False for parts long past, which are forgotten. */
  includes(commands: MachineCommands): boolean {
    return this.parts.some((part) => part.commands === commands);
  }

  partOf(commands: MachineCommands): P {
    const found = this.parts.find((part) => part.commands === commands);
    if (!found) throw new TypeError("the playing stream was never added");
    return found;
  }

  /** Computes the progress from the board's current position. */
  update(at: CommandPosition): PlotProgress {
    const part = this.partOf(at.stream);
    if (part !== this.part) this.enter(part, at.stream.planS[0]);
    this.partS = Math.max(this.partS, at.planS - this.partStartS);
    const now = stateAt(part.trajectory, at.planS, this.motion);
    const left =
      now.stroke >= 0
        ? { stroke: now.stroke, alongMm: now.alongMm }
        : nextPosition(part.trajectory, at.planS);
    if (left) this.place = left;
    const elapsedS = this.doneS + this.partS;
    const remainingS = Math.max(0, part.trajectory.totalS - at.planS) + part.afterS;
    const progress = elapsedS + remainingS > 0 ? elapsedS / (elapsedS + remainingS) : 1;
    this.latest = {
      progress: Math.max(progress, this.latest?.progress ?? 0),
      elapsedS,
      remainingS,
      ...this.penAt(part, at.planS, now, this.latest?.planS ?? null),
    };
    return this.latest;
  }

  /** The pen at later positions, in order of time. */
  ahead(positions: readonly CommandPosition[]): PenMoment[] {
    let lastS = this.latest?.planS ?? null;
    return positions.map(({ stream, planS }) => {
      const part = this.partOf(stream);
      const moment = this.penAt(part, planS, stateAt(part.trajectory, planS, this.motion), lastS);
      lastS = moment.planS;
      return moment;
    });
  }

  /** For a held plot that will resume from another place. Null while the plan's times are unknown. */
  movedTo(place: StrokePosition, at: Pick<PlotProgress, "xMm" | "yMm" | "penUp">): PlotProgress | null {
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
    // Finished parts are not played again, but the board may still be in one of the last.
    this.parts = this.parts.slice(Math.max(0, this.parts.indexOf(part) - this.pastParts));
  }

  private penAt(part: P, planS: number, now: MotionState, lastS: number | null): PenMoment {
    return {
      planS: this.firstPlanS(part, planS, now, lastS),
      xMm: now.x,
      yMm: now.y,
      penUp: now.penUp,
      penMoving: now.penMoving,
    };
  }

  /** The time of the same place in the first plan. `lastS`: the one before it, which applies while the pen travels. */
  private firstPlanS(
    { trajectory, afterS }: PlanPart,
    planS: number,
    now: MotionState,
    lastS: number | null,
  ): number {
    if (!this.firstTrajectory || trajectory === this.firstTrajectory) return planS;
    const timeS = now.stroke >= 0 ? this.times!.timeOf(now) : null;
    const leftS = trajectory.totalS - planS + afterS;
    return timeS ?? lastS ?? Math.max(0, this.firstTrajectory.totalS - leftS);
  }
}
