/**
 * The virtual board without its parser: motors, pen and motion queue, as events in ticks.
 *
 * One order runs and up to `fifoDepth` wait. A waiting order begins exactly when the previous one ends. An
 * order that arrives later begins on arrival, and if the pen was moving, the gap is an underrun.
 */
import { compareFirmware, type FirmwareFeatures } from "../protocol/firmware.js";
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import { penServoOf } from "../../../machines/pen-servo.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { stepsPerSFromRate, TICKS_PER_MS } from "../../../units.js";
import type { DrawnPolyline } from "../../drawn-polylines.js";
import { ebbOf, STANDARD_PIN } from "../protocol/ebb-controller.js";
import { pctFromServoPos, servoPosFromPct } from "../protocol/servo-height.js";
import { BoardTotals, MAX_JOINED_TICKS, type BoardStatistics } from "./board-totals.js";
import type { LineRecord } from "./drawn-line.js";
import type { Motors } from "./motors.js";
import { isTimed, RunningMove, type Order } from "../model/orders.js";
import { Servo } from "./servo.js";

const BOOT_SERVO_UP = 22_565;
const BOOT_SERVO_DOWN = 15_302;
const BOOT_SERVO_RATE = 400;

/** How the simulated servo differs from that of the machine's profile. */
export interface VirtualServo {
  /** Share of its speed: with 0.8 a move takes 1.25 times as long. Default 1. */
  readonly speed?: number;
  /** When its frames begin, ms. Default: with every command. */
  readonly framePhaseMs?: number;
  /**
   * Height at which the tip touches the paper, percent of the servo's range. Default: the tip touches halfway
   * down and leaves the paper at the start of a lift.
   */
  readonly contactPct?: number;
}

interface Running {
  readonly order: Order;
  readonly startTick: number;
  readonly endTick: number;
  readonly move: RunningMove | null;
}

export class BoardCore {
  /** Board time in ticks of 40 µs. May be fractional, because commands arrive at any time. */
  nowTick = 0;
  steps1 = 0;
  steps2 = 0;
  acc1 = 0;
  acc2 = 0;
  /** The pen state that the board reports; it only tracks the standard output. */
  penUp = true;
  fifoDepth = 1;
  servoUp = BOOT_SERVO_UP;
  servoDown = BOOT_SERVO_DOWN;
  servoRateUp = BOOT_SERVO_RATE;
  servoRateDown = BOOT_SERVO_RATE;
  servoUsed = false;
  readonly fifo: Order[] = [];
  /** The tip is clear of the paper. */
  private isLifted = true;
  /** When the tip touches or leaves the paper next; Infinity: not before the next pen command. */
  private contactTick = Infinity;
  private running: Running | null = null;
  readonly servo: Servo;
  /** When the running move reaches the limit switch; Infinity: it does not. */
  private limitTick = Infinity;
  /** When the motion froze (a simulated fault); null while it runs. */
  private frozenTick: number | null = null;
  /** False: moves take their time but make no steps (a simulated fault). */
  private makesSteps = true;
  /** End tick and end rates of the last move; null if any other order came after it. */
  private lastMove: { endTick: number; v1: number; v2: number } | null = null;

  constructor(
    readonly features: FirmwareFeatures,
    readonly machine: MachineProfile,
    /** Null: the line is not recorded. */
    private readonly line: LineRecord | null,
    /** Null: the tip touches and leaves the paper with the command. */
    private readonly servoOptions: VirtualServo | null,
    readonly motors: Motors,
    private readonly totals = new BoardTotals(),
  ) {
    const { speed, framePhaseMs } = servoOptions ?? {};
    const phaseTicks = framePhaseMs === undefined ? null : framePhaseMs * TICKS_PER_MS;
    // The board moves only the standard output when it starts. On the other one, the first move may be up or down.
    const isStandard = ebbOf(machine).servoPin === STANDARD_PIN;
    const atBoot = isStandard ? BOOT_SERVO_UP : servoPosFromPct(machine, 50);
    const unitsPerPct = Math.abs(servoPosFromPct(machine, 100) - servoPosFromPct(machine, 0)) / 100;
    this.servo = new Servo(atBoot, penServoOf(machine), unitsPerPct, speed, phaseTicks);
  }

  /** The firmware is this version or a newer one. */
  isFrom(version: string): boolean {
    return compareFirmware(this.features.version, version) >= 0;
  }

  get isBusy(): boolean {
    return this.running !== null;
  }

  get hasRoom(): boolean {
    return this.running === null || this.fifo.length < this.fifoDepth;
  }

  /**
   * Tick at which the running order ends, or the tip touches or leaves the paper during it. Infinity if nothing runs or
   * the order never ends. Contacts while nothing runs draw nothing; they are applied when the next order begins.
   */
  get nextEventTick(): number {
    if (this.running === null || this.frozenTick !== null) return Infinity;
    return Math.min(this.running.endTick, this.contactTick, this.limitTick);
  }

  /** The event of `nextEventTick`. */
  happen(): void {
    const { running } = this;
    if (running === null) return;
    if (this.limitTick <= Math.min(running.endTick, this.contactTick)) {
      this.reachLimit();
      return;
    }
    if (this.contactTick <= running.endTick) {
      this.changeContact();
      return;
    }
    this.settle(running, running.endTick);
    this.running = null;
    this.startNext();
  }

  /** Freezes the running order: it neither moves nor ends. When unfrozen it continues where it was. */
  setFrozen(isFrozen: boolean): void {
    if (isFrozen === (this.frozenTick !== null)) return;
    if (isFrozen) {
      this.frozenTick = this.nowTick;
      return;
    }
    const { running } = this;
    if (running !== null) {
      const standstill = this.nowTick - this.motionTick;
      const { startTick, endTick } = running;
      this.running = { ...running, startTick: startTick + standstill, endTick: endTick + standstill };
    }
    this.frozenTick = null;
  }

  /** Sets whether moves make steps. */
  setMakesSteps(makesSteps: boolean): void {
    this.splitRunning();
    this.makesSteps = makesSteps;
  }

  /** Sets whether the motors follow the counted steps. Steps that they miss displace the rest of the line. */
  setTurnsMotors(turnsMotors: boolean): void {
    if (turnsMotors === this.motors.isSupplied) return;
    this.splitRunning();
    this.motors.isSupplied = turnsMotors;
    this.beginLine();
  }

  /** A new polyline begins where the carriage is. */
  private beginLine(): void {
    const [steps1, steps2] = this.stepsNow();
    this.line?.begin(!this.isLifted, ...this.motors.carriageAt(steps1, steps2), this.nowTick);
  }

  /** The current tick for the running order; stands still while frozen. */
  private get motionTick(): number {
    return this.frozenTick === null
      ? this.nowTick
      : Math.max(this.frozenTick, this.running?.startTick ?? this.frozenTick);
  }

  /** Call when the running move or the limit switches have changed. */
  findLimit(): void {
    const { running } = this;
    this.limitTick = running?.move ? running.startTick + this.motors.limitTickOf(running.move) : Infinity;
  }

  private reachLimit(): void {
    this.settle(this.running!, this.limitTick);
    this.running = null;
    this.fifo.length = 0;
    this.lastMove = null;
    this.limitTick = Infinity;
    this.motors.limitReached = true;
  }

  enqueue(order: Order): void {
    if (this.motors.ignores(order)) return;
    if (this.running === null) this.start(order);
    else this.fifo.push(order);
  }

  private startNext(): void {
    const next = this.fifo.shift();
    if (next !== undefined) this.start(next);
  }

  /** ES. Returns whether moves were dropped, and the steps of the first waiting one and those left of the running one. */
  stop(): { hit: boolean; waiting: [number, number]; left: [number, number] } {
    const running = this.running;
    const { arithmetic, stopEndsTimed } = this.features;
    // Before firmware 3, pen moves and delays continue.
    const isStoppable = (order: Order): boolean =>
      arithmetic === "signed" || (order.kind === "move" && (stopEndsTimed || !isTimed(order)));
    const waiting = this.fifo.find((order) => order.kind === "move" && isStoppable(order));
    let hit = waiting !== undefined;
    let left: [number, number] = [0, 0];
    if (running !== null && isStoppable(running.order)) {
      hit ||= running.move !== null;
      left = this.stepsLeft(running);
      this.settle(running, this.motionTick);
      this.running = null;
      this.limitTick = Infinity;
    }
    this.fifo.splice(0, this.fifo.length, ...this.fifo.filter((order) => !isStoppable(order)));
    this.lastMove = null;
    if (this.running === null) this.startNext();
    const stepsOf = (axis: "axis1" | "axis2"): number => {
      const steps = waiting?.kind === "move" ? waiting[axis].steps : 0;
      return Number.isFinite(steps) ? steps : 0;
    };
    return { hit, waiting: [stepsOf("axis1"), stepsOf("axis2")], left };
  }

  /** The current step counters. */
  stepsNow(): [number, number] {
    const { running } = this;
    if (running === null || running.move === null || !this.makesSteps) return [this.steps1, this.steps2];
    const tick = Math.floor(this.motionTick - running.startTick);
    const { motion1, motion2 } = running.move;
    return [this.steps1 + motion1.stateAfterTicks(tick).net, this.steps2 + motion2.stateAfterTicks(tick).net];
  }

  /** CS, and EM on every firmware. The running move continues. */
  clearSteps(clearAccumulators: boolean): void {
    this.splitRunning(() => {
      this.steps1 = this.steps2 = 0;
      this.motors.missed1 = this.motors.missed2 = 0;
      if (clearAccumulators) this.acc1 = this.acc2 = 0;
    });
    this.line?.begin(!this.isLifted, ...this.motors.carriageAt(0, 0), this.nowTick);
  }

  motorsMoving(): [boolean, boolean] {
    const running = this.running;
    if (running === null || running.move === null) return [false, false];
    const tick = this.motionTick - running.startTick;
    // The firmware stores a timed move's ticks in motor 1's step field, so only that motor's flag is set.
    if (isTimed(running.move.order)) return [true, false];
    return [tick < running.move.motion1.ticks, tick < running.move.motion2.ticks];
  }

  servoPosition(): number {
    return this.servo.positionAt(this.nowTick);
  }

  /** Moves the pen; `up`: whether the board treats this as a lift. */
  movePen(position: number, rate: number, up: boolean): void {
    const { servo, nowTick, machine } = this;
    if (this.contactTick <= nowTick) this.changeContact();
    this.totals.addPenSpeed(servo.moveTo(position, rate, nowTick));
    this.servoUsed = true;
    const contactPct = this.servoOptions?.contactPct;
    const touches = contactPct === undefined ? !up : pctFromServoPos(machine, position) <= contactPct;
    this.contactTick = Infinity;
    if (touches !== this.isLifted) return;
    if (contactPct !== undefined) this.contactTick = servo.passTick(servoPosFromPct(machine, contactPct));
    else this.contactTick = touches && this.servoOptions ? servo.halfwayTick : nowTick;
    if (this.contactTick <= nowTick) this.changeContact();
  }

  /** A servo of the second output: a move to where it is changes nothing. */
  private isUpward(position: number): boolean {
    const from = this.servoPosition();
    return position === from ? this.isLifted : position > from;
  }

  /** The tip touches or leaves the paper: a stroke begins or ends. */
  private changeContact(): void {
    this.contactTick = Infinity;
    this.splitRunning();
    this.isLifted = !this.isLifted;
    this.totals.penMoveCount++;
    this.beginLine();
  }

  enableMotors(mode1: number, mode2: number | null): void {
    this.motors.enable(mode1, mode2);
    this.clearSteps(this.features.enableClearsAccumulators);
  }

  /**
   * The same board after a reset: boot defaults; queue and counters are lost, time and drawn line are kept.
   */
  rebooted(): BoardCore {
    const running = this.running;
    if (running !== null) this.settle(running, this.motionTick);
    this.running = null;
    const { features, machine, line, servoOptions, motors, totals } = this;
    const fresh = new BoardCore(features, machine, line, servoOptions, motors.rebooted(), totals);
    fresh.nowTick = this.nowTick;
    fresh.line?.begin(false, ...fresh.motors.carriageAt(0, 0), fresh.nowTick);
    return fresh;
  }

  /** The line drawn so far, including the running move. */
  drawn(): DrawnPolyline[] {
    // The line is sampled when an order ends, so the finished part of a running order is settled first.
    this.splitRunning();
    return this.line?.polylines(this.nowTick) ?? [];
  }

  statistics(): BoardStatistics {
    return this.totals.statistics();
  }

  private start(order: Order): void {
    if (order.kind === "move") {
      this.startMove(RunningMove.begin(order, this.features, this.acc1, this.acc2));
      return;
    }
    const { lastMove } = this;
    this.lastMove = null;
    let ticks = 1;
    if (order.kind === "servo") {
      // A pen command between two moves stops the motors for one tick, which does not count as an underrun.
      if (order.ticks <= 1 && lastMove) this.lastMove = { ...lastMove, endTick: lastMove.endTick + 1 };
      if (order.movesPen) {
        this.movePen(order.position, order.rate, order.penUp ?? this.isUpward(order.position));
      }
      if (order.penUp !== null) this.penUp = order.penUp;
      ticks = Math.max(1, order.ticks);
    } else if (order.kind === "enable") {
      this.enableMotors(order.mode1, order.mode2);
    } else {
      ticks = Math.max(1, order.ticks);
    }
    this.running = { order, startTick: this.nowTick, endTick: this.nowTick + ticks, move: null };
  }

  private startMove(move: RunningMove): void {
    this.motors.enableForMove();
    this.totals.addMove(move, this.servo.arrivalTick > this.nowTick + 1);
    this.noteJoint(move);
    const { order, ticks } = move;
    this.running = { order, startTick: this.nowTick, endTick: this.nowTick + ticks, move };
    this.findLimit();
  }

  /** Counts the gap and the velocity jump between the last move and this one. */
  private noteJoint(move: RunningMove): void {
    const { lastMove } = this;
    const gapTicks = lastMove === null ? 0 : this.nowTick - lastMove.endTick;
    if (lastMove !== null) this.totals.addGap(gapTicks, this.speedMmPerS(lastMove.v1, lastMove.v2));
    const before = gapTicks > MAX_JOINED_TICKS ? null : lastMove;
    const v1 = move.motion1.rateDuring(1) - (before?.v1 ?? 0);
    const v2 = move.motion2.rateDuring(1) - (before?.v2 ?? 0);
    this.totals.addJump(this.speedMmPerS(v1, v2));
  }

  private speedMmPerS(rate1: number, rate2: number): number {
    return this.lengthMm(stepsPerSFromRate(rate1), stepsPerSFromRate(rate2));
  }

  private lengthMm(steps1: number, steps2: number): number {
    return Math.hypot(xFromMotors(this.machine, steps1, steps2), yFromMotors(this.machine, steps1, steps2));
  }

  /** Applies what a running order has done up to `tick`. */
  private settle(running: Running, tick: number): void {
    const { move } = running;
    // At large tick values, the floating-point difference may not equal the move's whole ticks.
    const isOver = move !== null && tick >= running.endTick;
    const ticks = isOver ? move.ticks : Math.max(0, Math.min(tick, running.endTick) - running.startTick);
    this.totals.busyTicks += ticks;
    if (move === null) return;
    this.totals.movingTicks += ticks;
    if (!this.makesSteps) {
      this.lastMove = null;
      return;
    }
    const done = Math.floor(ticks);
    const place1 = move.motion1.stateAfterTicks(done);
    const place2 = move.motion2.stateAfterTicks(done);
    const { motors } = this;
    const [from1, from2] = motors.carriageAt(this.steps1, this.steps2);
    const follows = motors.follow(place1.net, place2.net);
    if (follows) this.line?.addMove(move, done, from1, from2, running.startTick);
    this.steps1 += place1.net;
    this.steps2 += place2.net;
    if (!follows) this.line?.begin(!this.isLifted, ...motors.carriageAt(this.steps1, this.steps2), tick);
    this.acc1 = place1.acc;
    this.acc2 = place2.acc;
    const pathMm = this.lengthMm(place1.net, place2.net);
    if (this.isLifted) this.totals.travelMm += pathMm;
    else this.totals.drawnMm += pathMm;
    this.lastMove = {
      endTick: tick,
      v1: lastRate(move.motion1, done),
      v2: lastRate(move.motion2, done),
    };
  }

  /** Applies what a running move has done, calls `change`, and continues with the rest of the move. */
  private splitRunning(change: () => void = () => undefined): void {
    const { running } = this;
    if (running === null || running.move === null) {
      change();
      return;
    }
    const tick = this.motionTick;
    this.settle(running, tick);
    change();
    const done = Math.floor(tick - running.startTick);
    const rest = running.move.restAfter(done, this.acc1, this.acc2);
    const startTick = running.startTick + done;
    this.running = { order: rest.order, startTick, endTick: startTick + rest.ticks, move: rest };
    this.findLimit();
  }

  private stepsLeft(running: Running): [number, number] {
    const { move, order } = running;
    if (move === null || order.kind !== "move" || isTimed(order)) return [0, 0];
    const tick = Math.floor(this.motionTick - running.startTick);
    return [
      order.axis1.steps - move.motion1.stepsMadeAfter(tick),
      order.axis2.steps - move.motion2.stepsMadeAfter(tick),
    ];
  }
}

const lastRate = (motion: RunningMove["motion1"], ticks: number): number =>
  motion.rateDuring(Math.min(ticks, motion.ticks));
