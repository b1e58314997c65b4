/** Writes the runs of a plan as Grbl will perform them, and records the moves to send. */
import { motor1FromXy, motor2FromXy, positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { BlockColumns } from "../../../plan/block-columns.js";
import { capSegments, type RunLimits } from "../../../plan/limits.js";
import type { RunPath } from "../../../plan/run-path.js";
import type { RunPlanner } from "../../../plan/run-writer.js";
import { newStraight, writeStraight } from "../../../plan/trapezoid.js";
import { moveOf, plannedSpeeds2, type Axes, type GrblAxisLimits, type Move } from "./planner.js";

/** A line to send: to a position of the axes, mm. */
export interface SentMove {
  readonly x: number;
  readonly y: number;
  /** mm/min. */
  readonly feed: number;
  /** Seconds from the plan's start. */
  readonly startS: number;
}

/** A point of a run on whole steps. */
interface Point {
  readonly steps1: number;
  readonly steps2: number;
  readonly x: number;
  readonly y: number;
  readonly alongMm: number;
}

export class GrblRuns implements RunPlanner {
  /** By run. */
  readonly runs: SentMove[][] = [];

  constructor(
    private readonly machine: MachineProfile,
    private readonly limits: GrblAxisLimits,
    private readonly queueMoves: number,
  ) {}

  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    // The controller has its own accelerations, so the path is not planned in a stretched frame.
    capSegments(path, { ...limits, stretchX: 1, stretchY: 1 });
    const sent: SentMove[] = [];
    this.runs.push(sent);
    const points = [this.pointAt(path, 0, path.startAlong)];
    const moves: Move[] = [];
    const feeds: number[] = [];
    let alongMm = path.startAlong;
    for (let i = 0; i < path.segmentCount; i++) {
      alongMm += path.drawn[i];
      const from = points[points.length - 1];
      const to = this.pointAt(path, i + 1, alongMm);
      if (to.steps1 === from.steps1 && to.steps2 === from.steps2) continue;
      const before = moves[moves.length - 1] ?? null;
      const moveAt = (feed: number): Move =>
        moveOf(this.axesAt(from), this.axesAt(to), feed / 60, this.limits, before);
      // The profile may limit the speed more than the Grbl itself.
      const feed = feedOf(moveAt(60 * Math.sqrt(path.cap2[i])).speed);
      moves.push(moveAt(feed));
      feeds.push(feed);
      points.push(to);
    }
    const speeds2 = plannedSpeeds2(moves, this.queueMoves);
    const straight = newStraight();
    moves.forEach((move, i) => {
      const [from, to] = [points[i], points[i + 1]];
      const [x, y] = this.axesAt(to);
      sent.push({ x, y, feed: feeds[i], startS: out.clockS });
      straight.x = from.x;
      straight.y = from.y;
      straight.ux = (to.x - from.x) / move.lengthMm;
      straight.uy = (to.y - from.y) / move.lengthMm;
      straight.length = move.lengthMm;
      straight.v0 = Math.sqrt(speeds2[i]);
      straight.v1 = Math.sqrt(speeds2[i + 1]);
      straight.cap2 = move.speed ** 2;
      straight.alongMm = from.alongMm;
      straight.alongPerMm = (to.alongMm - from.alongMm) / move.lengthMm;
      writeStraight(straight, move.accel, out);
    });
    out.addSegments(path.segmentCount);
  }

  /** Grbl's own axes, which may be turned against the page. */
  private axesAt({ steps1, steps2 }: Point): Axes {
    const { stepsPerMm } = this.machine;
    return [steps1 / stepsPerMm, steps2 / stepsPerMm, 0];
  }

  private pointAt({ x, y }: RunPath, i: number, alongMm: number): Point {
    const steps1 = Math.round(motor1FromXy(this.machine, x[i], y[i]));
    const steps2 = Math.round(motor2FromXy(this.machine, x[i], y[i]));
    return { steps1, steps2, ...positionFromMotors(this.machine, steps1, steps2), alongMm };
  }
}

/** mm/min, as written. Grbl refuses values below 1. */
const feedOf = (speedMmPerS: number): number => Math.max(1, Math.round(60_000 * speedMmPerS) / 1_000);
