/**
 * The line that the virtual board has drawn on a machine that swings. The carriage follows the motors, and the pen hangs
 * on a spring in each axis (src/plan/shaping/spring-axis.ts). It continues to swing while the motors rest.
 */
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import type { MachineProfile, Springs } from "../../../machines/profile.js";
import { SpringAxis } from "../../../plan/shaping/spring-axis.js";
import { sFromTicks, stepsPerSFromRate, TICKS_PER_MS } from "../../../units.js";
import { DrawnPolylines, type DrawnPolyline } from "../../drawn-polylines.js";
import type { RunningMove } from "../model/orders.js";
import type { LineRecord } from "./drawn-line.js";

const SAMPLE_TICKS = TICKS_PER_MS;
/** Below this the pen is at rest. */
const REST_MM = 0.001;
const REST_MM_PER_S = 0.1;

export class SwingingLine implements LineRecord {
  private readonly axisX: SpringAxis;
  private readonly axisY: SpringAxis;
  /** The carriage, mm from home. */
  private x = 0;
  private y = 0;
  /** Its velocity at the end of the last move, mm/s. */
  private vx = 0;
  private vy = 0;
  /** The pen is simulated up to here. */
  private tick = 0;
  private readonly lines = new DrawnPolylines();

  constructor(
    private readonly machine: MachineProfile,
    { xHz, yHz, damping }: Springs,
  ) {
    this.axisX = new SpringAxis(xHz, damping);
    this.axisY = new SpringAxis(yHz, damping);
    this.begin(false, 0, 0, 0);
  }

  begin(penDown: boolean, steps1: number, steps2: number, tick: number): void {
    this.rest(tick);
    this.lines.begin(penDown);
    this.addAt(steps1, steps2);
  }

  addMove(move: RunningMove, ticks: number, steps1: number, steps2: number, startTick: number): void {
    this.rest(startTick);
    const end = Math.min(ticks, Math.max(move.motion1.ticks, move.motion2.ticks));
    let [vx, vy] = this.velocity(move, 1);
    this.axisX.rate += this.vx - vx;
    this.axisY.rate += this.vy - vy;
    for (let from = 0; from < end; from += SAMPLE_TICKS) {
      const to = Math.min(end, from + SAMPLE_TICKS);
      const dt = sFromTicks(to - from);
      const [nextVx, nextVy] = this.velocity(move, to);
      this.axisX.advance(dt, (nextVx - vx) / dt);
      this.axisY.advance(dt, (nextVy - vy) / dt);
      [vx, vy] = [nextVx, nextVy];
      this.addAt(
        steps1 + move.motion1.stateAfterTicks(to).net,
        steps2 + move.motion2.stateAfterTicks(to).net,
      );
    }
    [this.vx, this.vy] = [vx, vy];
    this.tick = startTick + end;
  }

  polylines(tick: number): DrawnPolyline[] {
    this.rest(tick);
    return this.lines.list();
  }

  /** Simulates the pen until `tick` while the motors rest. */
  private rest(tick: number): void {
    if (tick <= this.tick) return;
    this.axisX.rate += this.vx;
    this.axisY.rate += this.vy;
    this.vx = this.vy = 0;
    while (this.tick < tick && this.isSwinging) {
      const to = Math.min(tick, this.tick + SAMPLE_TICKS);
      const dt = sFromTicks(to - this.tick);
      this.axisX.advance(dt, 0);
      this.axisY.advance(dt, 0);
      this.tick = to;
      this.add();
    }
    this.tick = tick;
  }

  private get isSwinging(): boolean {
    return [this.axisX, this.axisY].some(
      ({ d, rate }) => Math.abs(d) > REST_MM || Math.abs(rate) > REST_MM_PER_S,
    );
  }

  /** mm/s during a tick of the move; the first tick is 1. */
  private velocity({ motion1, motion2 }: RunningMove, tick: number): [number, number] {
    const steps1 = tick > motion1.ticks ? 0 : stepsPerSFromRate(motion1.rateDuring(tick));
    const steps2 = tick > motion2.ticks ? 0 : stepsPerSFromRate(motion2.rateDuring(tick));
    return [xFromMotors(this.machine, steps1, steps2), yFromMotors(this.machine, steps1, steps2)];
  }

  /** Adds the pen's position with the motors at these counts. */
  private addAt(steps1: number, steps2: number): void {
    this.x = xFromMotors(this.machine, steps1, steps2);
    this.y = yFromMotors(this.machine, steps1, steps2);
    this.add();
  }

  private add(): void {
    this.lines.add(this.x + this.axisX.d, this.y + this.axisY.d);
  }
}
