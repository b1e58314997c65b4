/** A plotter as data: what the compiler and the page need to know about it. */
export interface MachineProfile {
  /** Stored in settings: "axidraw-v3". */
  readonly id: string;
  /** Shown to people: "AxiDraw V3". */
  readonly name: string;
  /** Travel limits, mm from home. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** Microsteps per mm along an axis; on mixed machines along an axis of the carriage, see `motors`. */
  readonly stepsPerMm: number;
  /** "mixed": motor 1 = x + y, motor 2 = x − y (H-bot, CoreXY). "direct": motor 1 = x, motor 2 = y. */
  readonly motors: "mixed" | "direct";
  /** The axis runs opposite to its motor wiring. Left out: it does not. */
  readonly flipX?: boolean | undefined;
  readonly flipY?: boolean | undefined;
  /** x and y are exchanged, because of how the motors are plugged in or how the machine is placed. */
  readonly swapAxes?: boolean | undefined;
  /** What drives the motors and the pen. */
  readonly controller: Controller;
}

/** What drives the motors and the pen. `kind` selects the driver in src/drivers. */
export type Controller = EbbController;

/** EiBotBoard, used by AxiDraw, NextDraw, EggBot and others. */
export interface EbbController {
  readonly kind: "ebb";
  /** 1 = 1/16 steps, 2 = 1/8, 3 = 1/4, 4 = 1/2, 5 = whole steps. */
  readonly microstepMode: 1 | 2 | 3 | 4 | 5;
  /** Servo positions at 0 % and 100 % height, units of 1/12 µs (83.3 ns). */
  readonly servoPosAt0Pct: number;
  readonly servoPosAt100Pct: number;
  /** Servo output: 4 = RB1 (standard), 5 = RB2 (brushless upgrade). */
  readonly servoPin: 4 | 5;
  /** Switches at x = 0 and y = 0. Null or left out: home is where the user places the carriage. */
  readonly homing?: HomingSwitches | null | undefined;
}

export interface HomingSwitches {
  readonly x: SwitchInput;
  readonly y: SwitchInput;
}

/** One input pin of the board. */
export interface SwitchInput {
  readonly port: (typeof INPUT_PORTS)[number];
  /** 0 … 7. */
  readonly pin: number;
  /** The pin's level while the switch is pressed. */
  readonly pressed: 0 | 1;
}

export const INPUT_PORTS = ["A", "B", "C", "D", "E"] as const;
