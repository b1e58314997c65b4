/** The pen's servo: slews to its target at a set rate, from the start of one of the board's 24 ms frames on. */
export const FRAME_TICKS = 600;

export class Servo {
  private from: number;
  private target: number;
  private rate = 0;
  private startTick = 0;

  /**
   * @param speed 0.8: it needs a quarter more time than the board's rate says
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

  /** `rate`: change per frame; 0: at once. It starts with the next frame. */
  moveTo(position: number, rate: number, tick: number): void {
    this.from = this.positionAt(tick);
    this.target = position;
    this.rate = rate * this.speed;
    const phase = this.phaseTicks ?? tick;
    this.startTick = phase + FRAME_TICKS * Math.ceil((tick - phase) / FRAME_TICKS);
  }

  positionAt(tick: number): number {
    if (this.rate === 0) return this.target;
    const doneWay = (this.rate * Math.max(0, tick - this.startTick)) / FRAME_TICKS;
    const way = this.target - this.from;
    return Math.abs(way) <= doneWay ? this.target : this.from + Math.sign(way) * doneWay;
  }

  /** Tick at which the frame ends in which it reaches its target. */
  get arrivalTick(): number {
    if (this.rate === 0) return this.startTick;
    return this.startTick + Math.ceil(Math.abs(this.target - this.from) / this.rate) * FRAME_TICKS;
  }

  /** Tick at which it passes a position on its way; Infinity if that is not on its way. */
  passTick(position: number): number {
    const way = this.target - this.from;
    const wayThere = position - this.from;
    if (wayThere * way < 0 || Math.abs(wayThere) > Math.abs(way)) return Infinity;
    return this.rate === 0 ? this.startTick : this.startTick + (Math.abs(wayThere) / this.rate) * FRAME_TICKS;
  }
}
