/** A plotter as data: what the compiler and the page need to know of it. */
export interface MachineProfile {
  readonly id: string;
  readonly name: string;
  /** Travel limits, mm from home. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** Microsteps for one mm along an axis (mixed axes: of the carriage, see `motors`). */
  readonly stepsPerMm: number;
  /** "mixed": motor 1 = x + y, motor 2 = x − y (H-bot, CoreXY). "direct": motor 1 = x, motor 2 = y. */
  readonly motors: "mixed" | "direct";
  /** EM argument: 1 = 1/16 microsteps. */
  readonly microstepMode: 1 | 2 | 3 | 4 | 5;
  /** Servo positions at 0 % and 100 % height, units of 1/12 µs (83.3 ns). */
  readonly servoPosAt0Pct: number;
  readonly servoPosAt100Pct: number;
  /** Servo output: 4 = RB1 (standard), 5 = RB2 (brushless upgrade). */
  readonly servoPin: 4 | 5;
}
