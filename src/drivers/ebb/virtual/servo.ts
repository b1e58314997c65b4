/** The pen's servo: moves to its target at a set rate, starting with one of the board's 24 ms frames. */
export const FRAME_TICKS = 600;

export class Servo {
  private from: number;
  private target: number;
  private rate = 0;
  private startTick = 0;

  /**
   * @param speed share of the commanded rate: with 0.8 a move takes 1.25 times as long
   * @param phaseTicks when its frames begin; null: with every command
   */
  constructor(
    position: number,
    private readonly speed = 1,
    private readonly phaseTicks: number | null = null,
  ) {
    this.from = position;
    this.target = position;
  }

  /** Moves with the next frame. `rate`: change per frame; 0: at once. */
  moveTo(position: number, rate: number, tick: number): void {
    this.from = this.positionAt(tick);
    this.target = position;
    this.rate = rate * this.speed;
    const phase = this.phaseTicks ?? tick;
    this.startTick = phase + FRAME_TICKS * Math.ceil((tick - phase) / FRAME_TICKS);
  }

  positionAt(tick: number): number {
    if (this.rate === 0) return this.target;
    const moved = (this.rate * Math.max(0, tick - this.startTick)) / FRAME_TICKS;
    const distance = this.target - this.from;
    return Math.abs(distance) <= moved ? this.target : this.from + Math.sign(distance) * moved;
  }

  /** End of the frame in which the servo reaches its target. */
  get arrivalTick(): number {
    if (this.rate === 0) return this.startTick;
    return this.startTick + Math.ceil(Math.abs(this.target - this.from) / this.rate) * FRAME_TICKS;
  }

  /** Tick at which the servo passes a position during the current move; Infinity if it does not. */
  passTick(position: number): number {
    const whole = this.target - this.from;
    const part = position - this.from;
    if (part * whole < 0 || Math.abs(part) > Math.abs(whole)) return Infinity;
    return this.rate === 0 ? this.startTick : this.startTick + (Math.abs(part) / this.rate) * FRAME_TICKS;
  }
}
