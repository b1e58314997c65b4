/**
 * A spring of natural frequency f and damping ratio ζ between the carriage u and the pen x, along one axis.
 *
 *   x″ = ω² (u − x) + 2ζω (u′ − x′)      ω = 2πf
 *
 * While u has constant acceleration a, the difference d = x − u obeys d″ + 2ζω d′ + ω² d = −a, which has an exact
 * solution: a decaying swing around −a/ω². When the carriage's velocity jumps, d′ jumps by the opposite amount.
 */
/** The swing of one axis. */
export class SpringAxis {
  /** x − u, mm, and its rate of change, mm/s. */
  d = 0;
  rate = 0;
  private readonly omega: number;
  private readonly decay: number;
  private readonly swing: number;

  constructor(hz: number, damping: number) {
    this.omega = 2 * Math.PI * hz;
    this.decay = damping * this.omega;
    this.swing = this.omega * Math.sqrt(1 - damping * damping);
  }

  /** Advances by `t` seconds, under constant acceleration of the carriage. */
  advance(t: number, accel: number): void {
    const centre = -accel / (this.omega * this.omega);
    const from = this.d - centre;
    const other = (this.rate + this.decay * from) / this.swing;
    const left = Math.exp(-this.decay * t);
    const [sin, cos] = [Math.sin(this.swing * t), Math.cos(this.swing * t)];
    const d = left * (from * cos + other * sin);
    this.rate = -this.decay * d + left * this.swing * (other * cos - from * sin);
    this.d = centre + d;
  }
}
