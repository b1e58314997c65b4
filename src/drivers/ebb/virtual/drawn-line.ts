/**
 * The line that the virtual board has drawn: positions of both motors, sampled so densely that the straight line between
 * two samples is never farther than a microstep from the true path.
 */
import { grown } from "../../../geometry/growable.js";
import type { AxisState } from "../model/accumulator.js";
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { ACCUMULATOR_RANGE } from "../../../units.js";
import type { RunningMove } from "../model/orders.js";

/** Max microsteps of the faster motor between samples. */
const SAMPLE_STEPS = 4;

export interface DrawnPolyline {
  readonly penDown: boolean;
  /** mm from home: x, y, x, y … */
  readonly xy: Float64Array;
}

/** Records the drawn line. Times are board ticks. */
export interface LineRecord {
  /** Starts a new polyline: the pen was lifted or lowered, or the counters were reset. */
  begin(penDown: boolean, steps1: number, steps2: number, tick: number): void;
  /** Adds the line of a move's first `ticks` ticks, starting at these step counts. */
  addMove(move: RunningMove, ticks: number, steps1: number, steps2: number, startTick: number): void;
  polylines(tick: number): DrawnPolyline[];
}

export class DrawnLine implements LineRecord {
  private points = new Int32Array(1024);
  private pointCount = 0;
  /** By polyline: its first point, and whether the pen was down. */
  private readonly firsts: number[] = [0];
  private readonly downs: boolean[] = [false];
  private readonly place1: AxisState = { net: 0, acc: 0 };
  private readonly place2: AxisState = { net: 0, acc: 0 };

  constructor(private readonly machine: MachineProfile) {
    this.add(0, 0);
  }

  begin(penDown: boolean, steps1: number, steps2: number): void {
    const isEmpty = this.pointCount - this.firsts[this.firsts.length - 1] < 2;
    if (isEmpty && !this.downs[this.downs.length - 1]) {
      this.pointCount = this.firsts[this.firsts.length - 1]!;
      this.downs[this.downs.length - 1] = penDown;
    } else {
      this.firsts.push(this.pointCount);
      this.downs.push(penDown);
    }
    this.add(steps1, steps2);
  }

  addMove(move: RunningMove, ticks: number, steps1: number, steps2: number): void {
    const end = Math.min(ticks, Math.max(move.motion1.ticks, move.motion2.ticks));
    const stride = sampleTicks(move, end);
    for (let tick = stride; tick < end; tick += stride) this.sample(move, tick, steps1, steps2);
    this.sample(move, end, steps1, steps2);
  }

  polylines(): DrawnPolyline[] {
    const lines: DrawnPolyline[] = [];
    for (let i = 0; i < this.firsts.length; i++) {
      const from = this.firsts[i];
      const to = this.firsts[i + 1] ?? this.pointCount;
      const penDown = this.downs[i];
      if (to - from < 2 && !penDown) continue;
      lines.push({ penDown, xy: this.toMm(from, to) });
    }
    return lines;
  }

  private toMm(from: number, to: number): Float64Array {
    const xy = new Float64Array(2 * (to - from));
    for (let i = from; i < to; i++) {
      const steps1 = this.points[2 * i];
      const steps2 = this.points[2 * i + 1];
      xy[2 * (i - from)] = xFromMotors(this.machine, steps1, steps2);
      xy[2 * (i - from) + 1] = yFromMotors(this.machine, steps1, steps2);
    }
    return xy;
  }

  private sample(move: RunningMove, tick: number, steps1: number, steps2: number): void {
    move.motion1.placeAt(tick, this.place1);
    move.motion2.placeAt(tick, this.place2);
    this.add(steps1 + this.place1.net, steps2 + this.place2.net);
  }

  /** Adds a point. A point that continues a straight line replaces the last one. */
  private add(m1: number, m2: number): void {
    const first = this.firsts[this.firsts.length - 1];
    const n = this.pointCount;
    const p = this.points;
    if (n > first) {
      const dx = m1 - p[2 * n - 2];
      const dy = m2 - p[2 * n - 1];
      if (dx === 0 && dy === 0) return;
      if (n > first + 1) {
        const ex = p[2 * n - 2] - p[2 * n - 4];
        const ey = p[2 * n - 1] - p[2 * n - 3];
        if (dx * ey === dy * ex && dx * ex + dy * ey > 0) {
          p[2 * n - 2] = m1;
          p[2 * n - 1] = m2;
          return;
        }
      }
    }
    if (2 * n + 2 > p.length) this.points = grown(p);
    this.points[2 * n] = m1;
    this.points[2 * n + 1] = m2;
    this.pointCount++;
  }
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
