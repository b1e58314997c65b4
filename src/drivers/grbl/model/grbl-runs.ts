/** Writes the runs of a plan as Grbl will perform them, and records the lines to send. */
import { motor1FromXy, motor2FromXy, positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { BlockColumns } from "../../../plan/block-columns.js";
import { capSegments, type RunLimits } from "../../../plan/limits.js";
import type { RunPath } from "../../../plan/run-path.js";
import type { RunPlanner } from "../../../plan/run-writer.js";
import { newStraight, writeStraight } from "../../../plan/trapezoid.js";
import { cutArc, extremesOf, sweepOf, type Arc } from "./arc-cut.js";
import { arcsOf, type ArcPath, type FoundArc } from "./arcs.js";
import { feedFor, moveOf, plannedSpeeds2, type Axes, type GrblAxisLimits, type Move } from "./planner.js";

/** A line to send: to a position of the axes, mm. */
export interface SentMove {
  readonly x: number;
  readonly y: number;
  /** Null: straight. */
  readonly arc: Arc | null;
  /** How many straight moves the Grbl makes of it. */
  readonly moveCount: number;
  /** mm/min. */
  readonly feed: number;
  /** Seconds from the plan's start. */
  readonly startS: number;
}

/** A point of a run on whole steps. */
interface Point {
  /** On Grbl's own axes, which may be turned against the page. */
  readonly at: Axes;
  readonly x: number;
  readonly y: number;
  readonly alongMm: number;
}

/** The path of a run on Grbl's own axes, and mm along the drawing at each point. */
interface AxesPath extends ArcPath {
  readonly alongMm: Float64Array;
}

/** Max distance of a point from whole steps of both axes, in steps. */
const ROUNDED_STEPS = Math.SQRT1_2;

export class GrblRuns implements RunPlanner {
  /** By run. */
  readonly runs: SentMove[][] = [];

  /** @param arcToleranceMm null: it takes no arcs */
  constructor(
    private readonly machine: MachineProfile,
    private readonly limits: GrblAxisLimits,
    private readonly queueMoves: number,
    private readonly arcToleranceMm: number | null,
  ) {}

  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    // The controller has its own accelerations, so the path is not planned in a stretched frame.
    capSegments(path, { ...limits, stretchX: 1, stretchY: 1 });
    const axes = this.onAxes(path);
    const arcs = this.arcToleranceMm === null ? [] : this.arcsOf(axes);
    const lines: Omit<SentMove, "startS">[] = [];
    const moves: Move[] = [];
    const points = [this.pointAt(axes, 0)];
    let nextArc = 0;
    for (let i = 0; i < path.segmentCount;) {
      const arc = arcs[nextArc]?.first === i ? arcs[nextArc++] : null;
      const cap = Math.sqrt(path.cap2[i]);
      i = arc?.last ?? i + 1;
      const to = this.pointAt(axes, i);
      const ends = arc ? this.cut(arc, axes, points[points.length - 1], to) : [to];
      const added = ends.filter((end, k) => isApart(end, ends[k - 1] ?? points[points.length - 1]));
      if (added.length === 0) continue;
      const feed = this.feedTo(added, points[points.length - 1], cap);
      for (const end of added) {
        const from = points[points.length - 1];
        moves.push(moveOf(from.at, end.at, feed / 60, this.limits, moves[moves.length - 1] ?? null));
        points.push(end);
      }
      lines.push({ x: to.at[0], y: to.at[1], arc, moveCount: added.length, feed });
    }
    this.runs.push(this.writeMoves(lines, moves, points, out));
    out.addSegments(path.segmentCount);
  }

  /** Beside a line that touches the edge of the machine, an arc would lead beyond it. */
  private arcsOf(axes: AxesPath): FoundArc[] {
    return arcsOf(axes, ROUNDED_STEPS / this.machine.stepsPerMm).filter((arc) => {
      const [from, to] = [this.pointAt(axes, arc.first), this.pointAt(axes, arc.last)];
      return extremesOf(arc, from.at, to.at).every((at) => {
        const { x, y } = this.pointOf(at, 0);
        return x >= 0 && x <= this.machine.widthMm && y >= 0 && y <= this.machine.heightMm;
      });
    });
  }

  private writeMoves(
    lines: readonly Omit<SentMove, "startS">[],
    moves: readonly Move[],
    points: readonly Point[],
    out: BlockColumns,
  ): SentMove[] {
    const speeds2 = plannedSpeeds2(moves, this.queueMoves);
    const straight = newStraight();
    let i = 0;
    return lines.map((line) => {
      const startS = out.clockS;
      for (const end = i + line.moveCount; i < end; i++) {
        const [move, from, to] = [moves[i], points[i], points[i + 1]];
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
      }
      return { ...line, startS };
    });
  }

  /** The profile may limit the speed more than the Grbl itself; of an arc, where it is slowest. */
  private feedTo(ends: readonly Point[], start: Point, cap: number): number {
    const speeds = ends.map(
      (to, k) => moveOf((ends[k - 1] ?? start).at, to.at, feedFor(cap, this.limits), this.limits, null).speed,
    );
    return feedOf(feedFor(Math.min(...speeds), this.limits));
  }

  /** The straight moves that Grbl makes of an arc. Its points divide the drawing as their angles do. */
  private cut(arc: FoundArc, { x, y, alongMm }: AxesPath, from: Point, to: Point): Point[] {
    const { first, last } = arc;
    const sweep = Math.abs(sweepOf(arc, from.at, to.at));
    const angleAt = (k: number): number => {
      const end: Axes = k === last ? to.at : [x[k], y[k], 0];
      return k === first ? 0 : Math.abs(sweepOf(arc, from.at, end));
    };
    const ends = cutArc(arc, from.at, to.at, this.arcToleranceMm ?? 0);
    let k = first;
    let [angle, next] = [0, angleAt(first + 1)];
    return ends.map((end, n) => {
      if (n === ends.length - 1) return to;
      const at = ((n + 1) / ends.length) * sweep;
      while (next < at && k + 2 <= last) [k, angle, next] = [k + 1, next, angleAt(k + 2)];
      const share = (at - angle) / (next - angle);
      return this.pointOf(end, alongMm[k] + share * (alongMm[k + 1] - alongMm[k]));
    });
  }

  private onAxes(path: RunPath): AxesPath {
    const { segmentCount, cap2 } = path;
    const { stepsPerMm } = this.machine;
    const column = (valueAt: (i: number) => number): Float64Array =>
      new Float64Array(segmentCount + 1).map((_, i) => valueAt(i));
    const x = column((i) => motor1FromXy(this.machine, path.x[i], path.y[i]) / stepsPerMm);
    const y = column((i) => motor2FromXy(this.machine, path.x[i], path.y[i]) / stepsPerMm);
    let along = path.startAlong;
    const alongMm = column((i) => (i === 0 ? along : (along += path.drawn[i - 1])));
    const onSteps = (mm: number): number => Math.round(mm * stepsPerMm) / stepsPerMm;
    return { segmentCount, cap2, x, y, stepX: x.map(onSteps), stepY: y.map(onSteps), alongMm };
  }

  private pointAt({ stepX, stepY, alongMm }: AxesPath, i: number): Point {
    return this.pointOf([stepX[i], stepY[i], 0], alongMm[i]);
  }

  private pointOf([atX, atY]: Axes, alongMm: number): Point {
    const { machine } = this;
    const steps1 = Math.round(atX * machine.stepsPerMm);
    const steps2 = Math.round(atY * machine.stepsPerMm);
    const at: Axes = [steps1 / machine.stepsPerMm, steps2 / machine.stepsPerMm, 0];
    return { at, ...positionFromMotors(machine, steps1, steps2), alongMm };
  }
}

const isApart = (a: Point, b: Point): boolean => a.at[0] !== b.at[0] || a.at[1] !== b.at[1];

/** mm/min, as written. Grbl refuses values below 1. */
const feedOf = (speedMmPerS: number): number => Math.max(1, Math.round(60_000 * speedMmPerS) / 1_000);
