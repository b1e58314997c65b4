/** The pen's servo: moves to its target in the time that the machine's servo takes, starting with one of the board's frames. */
import { servoTime } from "../../../machines/pen-servo.js";
import type { PenServo } from "../../../machines/profile.js";
import { TICKS_PER_MS, TICKS_PER_S } from "../../../units.js";

/** Frames when a board starts: 8 channels of 3 ms. */
const BOOT_CHANNELS = 8;
const BOOT_SLOT_MS = 3;

export class Servo {
  /** Set by SC,8 and SC,9. A frame has one slot for each channel; the board changes the signal once per frame. */
  channels = BOOT_CHANNELS;
  slotMs = BOOT_SLOT_MS;
  private from: number;
  private target: number;
  private startTick = 0;
  private moveTicks = 0;

  /**
   * @param servo how the machine's servo moves, and how many units of position are one percent of its range
   * @param speed share of its speed: with 0.8 a move takes 1.25 times as long
   * @param phaseTicks when its frames begin; null: with every command
   */
  constructor(
    position: number,
    private readonly servo: PenServo,
    private readonly unitsPerPct: number,
    private readonly speed = 1,
    private readonly phaseTicks: number | null = null,
  ) {
    this.from = position;
    this.target = position;
  }

  private get frameTicks(): number {
    return Math.max(1, this.channels * this.slotMs * TICKS_PER_MS);
  }

  /** Moves with the next frame. `rate`: change per frame; 0: at once. Returns the speed of its signal, percent per second. */
  moveTo(position: number, rate: number, tick: number): number {
    const { frameTicks, unitsPerPct } = this;
    this.from = this.positionAt(tick);
    this.target = position;
    const ratePctPerS = rate === 0 ? Infinity : (rate / unitsPerPct) * (TICKS_PER_S / frameTicks);
    const distancePct = Math.abs(position - this.from) / unitsPerPct;
    this.moveTicks = (servoTime(this.servo, distancePct, ratePctPerS) / this.speed) * TICKS_PER_S;
    const phase = this.phaseTicks ?? tick;
    this.startTick = phase + frameTicks * Math.ceil((tick - phase) / frameTicks);
    return ratePctPerS;
  }

  positionAt(tick: number): number {
    const share = this.moveTicks === 0 ? 1 : (tick - this.startTick) / this.moveTicks;
    return this.from + Math.min(1, Math.max(0, share)) * (this.target - this.from);
  }

  /** When the servo reaches its target. */
  get arrivalTick(): number {
    return this.startTick + this.moveTicks;
  }

  /** When it has gone half of its way. */
  get halfwayTick(): number {
    return this.startTick + this.moveTicks / 2;
  }

  /** Tick at which the servo passes a position during the current move; Infinity if it does not. */
  passTick(position: number): number {
    const whole = this.target - this.from;
    const part = position - this.from;
    if (part * whole < 0 || Math.abs(part) > Math.abs(whole)) return Infinity;
    return whole === 0 ? this.startTick : this.startTick + (part / whole) * this.moveTicks;
  }
}
