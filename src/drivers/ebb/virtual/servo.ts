/** The pen's servo: goes to its target at a set rate, as the board's 24 ms frames move it. */
const FRAME_TICKS = 600;

export class Servo {
  private from: number;
  private target: number;
  private rate = 0;
  private startTick = 0;

  constructor(position: number) {
    this.from = position;
    this.target = position;
  }

  /** `rate`: change a frame; 0 = at once. */
  moveTo(position: number, rate: number, tick: number): void {
    this.from = this.positionAt(tick);
    this.target = position;
    this.rate = rate;
    this.startTick = tick;
  }

  positionAt(tick: number): number {
    if (this.rate === 0) return this.target;
    const frames = Math.floor((tick - this.startTick) / FRAME_TICKS);
    const way = this.target - this.from;
    return Math.abs(way) <= frames * this.rate
      ? this.target
      : this.from + Math.sign(way) * Math.max(0, frames) * this.rate;
  }

  /** Tick at which it has reached its target. */
  get arrivalTick(): number {
    if (this.rate === 0) return this.startTick;
    return this.startTick + Math.ceil(Math.abs(this.target - this.from) / this.rate) * FRAME_TICKS;
  }
}
