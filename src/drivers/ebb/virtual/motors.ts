/**
 * The virtual board's motors: which are on, whether they follow the counted steps, and the limit switch that ends a move.
 */
import { firstWhere } from "../../../geometry/binary-search.js";
import type { Order, RunningMove } from "../model/orders.js";
import type { Gantry } from "./gantry.js";

export class Motors {
  /** EM modes 1 … 5; 0: off. */
  mode1 = 0;
  mode2 = 0;
  /** CU,50: moves switch both motors on. */
  autoEnable = true;
  /** False: steps are counted, but the motors do not turn (no motor supply), so nothing is drawn. */
  isSupplied = true;
  /** Without a gantry: steps that were counted but not made. The carriage is this far behind the counters. */
  missed1 = 0;
  missed2 = 0;
  /** CU,51 and CU,52: the pins of port B at which a limit switch ends all motion, and their levels then. */
  limitMask = 0;
  limitTarget = 0;
  /** A limit switch has ended the motion. Moves are ignored until EM or CU,51,0. */
  limitReached = false;
  private lastMode = 1;

  constructor(
    /** Null: the carriage is always where the motors are. */
    readonly gantry: Gantry | null,
  ) {}

  /** EM. `mode2` null: unchanged. */
  enable(mode1: number, mode2: number | null): void {
    if (mode1 !== 0) this.lastMode = mode1;
    const second = mode2 === 0 ? 0 : this.lastMode;
    this.setModes(mode1, mode2 === null ? this.mode2 : second);
    this.limitReached = false;
  }

  /** A move begins. */
  enableForMove(): void {
    if (this.autoEnable) this.setModes(this.lastMode, this.lastMode);
  }

  switchOff(): void {
    this.setModes(0, 0);
  }

  /** Counts steps. Returns whether the motors make them all. */
  follow(steps1: number, steps2: number): boolean {
    if (this.isSupplied) return this.gantry?.turn(steps1, steps2) ?? true;
    this.missed1 += steps1;
    this.missed2 += steps2;
    return false;
  }

  /** The carriage, in steps: from the corner of a gantry, otherwise from where the counters were zero. */
  carriageAt(steps1: number, steps2: number): readonly [number, number] {
    return this.gantry?.steps ?? [steps1 - this.missed1, steps2 - this.missed2];
  }

  /** The level of a pin of port B; null: nothing is connected to it. */
  portB(pin: number): number | null {
    const { gantry } = this;
    return gantry?.input.port === "B" && gantry.input.pin === pin ? gantry.levelAfter(0, 0) : null;
  }

  /** CU,51. */
  watchLimit(mask: number): void {
    this.limitMask = mask;
    if (mask === 0) this.limitReached = false;
  }

  /** Whether an order is ignored, because a limit switch was reached. */
  ignores({ kind }: Order): boolean {
    this.limitReached ||= this.isAtLimit(0, 0);
    return this.limitReached && kind === "move";
  }

  /**
   * The tick of a move at which the carriage reaches the limit switch; Infinity: it does not. The move takes the carriage
   * to one side only, as when homing.
   */
  limitTickOf({ motion1, motion2, ticks }: RunningMove): number {
    if (this.limitMask === 0) return Infinity;
    const tick = firstWhere(0, ticks + 1, (k) =>
      this.isAtLimit(motion1.stateAfterTicks(k).net, motion2.stateAfterTicks(k).net),
    );
    return tick > ticks ? Infinity : tick;
  }

  /** The same motors after a reset of the board. */
  rebooted(): Motors {
    this.switchOff();
    const fresh = new Motors(this.gantry);
    fresh.isSupplied = this.isSupplied;
    return fresh;
  }

  private setModes(mode1: number, mode2: number): void {
    if (mode1 === this.mode1 && mode2 === this.mode2) return;
    this.mode1 = mode1;
    this.mode2 = mode2;
    this.gantry?.setModes(mode1, mode2);
  }

  private isAtLimit(steps1: number, steps2: number): boolean {
    const { gantry } = this;
    const bit = gantry?.input.port === "B" ? 1 << gantry.input.pin : 0;
    if (!gantry || (this.limitMask & bit) === 0) return false;
    return gantry.levelAfter(steps1, steps2) === ((this.limitTarget & bit) === 0 ? 0 : 1);
  }
}
