/**
 * The line that the virtual board has drawn: positions of both motors, sampled so densely that the straight line between
 * two samples is never farther than a microstep from the true path.
 */
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { ACCUMULATOR_RANGE } from "../../../units.js";
import { DrawnPolylines, type DrawnPolyline } from "../../drawn-polylines.js";
import type { RunningMove } from "../model/orders.js";

/** Max microsteps of the faster motor between samples. */
const SAMPLE_STEPS = 4;

/** Records the drawn line. Times are board ticks. */
export interface LineRecord {
  /** Starts a new polyline: the pen was lifted or lowered, or the counters were reset. */
  begin(penDown: boolean, steps1: number, steps2: number, tick: number): void;
  /** Adds the line of a move's first `ticks` ticks, starting at these step counts. */
  addMove(move: RunningMove, ticks: number, steps1: number, steps2: number, startTick: number): void;
  polylines(tick: number): DrawnPolyline[];
}

/** A position of both motors, steps. */
interface Point {
  readonly m1: number;
  readonly m2: number;
}

export class DrawnLine implements LineRecord {
  private readonly lines = new DrawnPolylines();
  /** The last two points of the current polyline. */
  private last: Point | null = null;
  private beforeLast: Point | null = null;

  constructor(private readonly machine: MachineProfile) {
    this.begin(false, 0, 0);
  }

  begin(penDown: boolean, steps1: number, steps2: number): void {
    this.lines.begin(penDown);
    this.last = this.beforeLast = null;
    this.add({ m1: steps1, m2: steps2 });
  }

  addMove(move: RunningMove, ticks: number, steps1: number, steps2: number): void {
    const { motion1, motion2 } = move;
    const end = Math.min(ticks, Math.max(motion1.ticks, motion2.ticks));
    const sample = (tick: number): void =>
      this.add({
        m1: steps1 + motion1.stateAfterTicks(tick).net,
        m2: steps2 + motion2.stateAfterTicks(tick).net,
      });
    const stride = sampleTicks(move, end);
    for (let tick = stride; tick < end; tick += stride) sample(tick);
    sample(end);
  }

  polylines(): DrawnPolyline[] {
    return this.lines.list();
  }

  /** A point that continues a straight line replaces the last one. */
  private add(point: Point): void {
    const { last, beforeLast, lines } = this;
    if (last?.m1 === point.m1 && last.m2 === point.m2) return;
    const x = xFromMotors(this.machine, point.m1, point.m2);
    const y = yFromMotors(this.machine, point.m1, point.m2);
    if (last && beforeLast && isStraight(beforeLast, last, point)) lines.replaceLast(x, y);
    else {
      lines.add(x, y);
      this.beforeLast = last;
    }
    this.last = point;
  }
}

function isStraight(a: Point, b: Point, c: Point): boolean {
  const [ex, ey] = [b.m1 - a.m1, b.m2 - a.m2];
  const [dx, dy] = [c.m1 - b.m1, c.m2 - b.m2];
  return dx * ey === dy * ex && dx * ex + dy * ey > 0;
}

function sampleTicks(move: RunningMove, ticks: number): number {
  const { motion1, motion2 } = move;
  const middle = ticks >> 1;
  let fastest = 1;
  for (const motion of [motion1, motion2]) {
    for (const tick of [1, middle, Math.min(ticks, motion.ticks)]) {
      fastest = Math.max(fastest, Math.abs(motion.rateDuring(tick)));
    }
  }
  return Math.max(1, Math.floor((SAMPLE_STEPS * ACCUMULATOR_RANGE) / fastest));
}
