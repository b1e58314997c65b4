/** The fields of a machine profile for its EiBotBoard. */
import { PlotwrightError } from "../../../errors.js";
import { checkController, checkProfile } from "../../../machines/check-profile.js";
import type { Controller, ControllerFields, MachineProfile } from "../../../machines/profile.js";

/** EiBotBoard, used by AxiDraw, NextDraw, EggBot and others. */
export interface EbbController extends Controller {
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
  /** One switch at x = 0 and a stop at y = 0, as a NextDraw has: the machine finds home with both. */
  readonly cornerSwitch?: SwitchInput | null | undefined;
}

/** The standard servo output: the only one that SP moves. */
export const STANDARD_PIN = 4;

export interface HomingSwitches {
  readonly x: SwitchInput;
  readonly y: SwitchInput;
}

/** One input pin of the board. */
export interface SwitchInput {
  readonly port: "A" | "B" | "C" | "D" | "E";
  /** 0 … 7. */
  readonly pin: number;
  /** The pin's level while the switch is pressed. */
  readonly pressed: 0 | 1;
}

/** The board stores servo positions in 16 bits. */
const servoPos = {
  kind: "number",
  min: 1,
  max: 65_535,
  isWhole: true,
  unit: "1/12 µs",
  step: 10,
  digits: 0,
} as const;

const SWITCH_INPUT = {
  kind: "group",
  fields: {
    port: { kind: "one-of", values: ["A", "B", "C", "D", "E"] },
    pin: {
      kind: "number",
      label: "Pin",
      about: "pin of the port",
      default: 0,
      min: 0,
      max: 7,
      isWhole: true,
      unit: "",
      step: 1,
    },
    pressed: { kind: "one-of", values: [0, 1] },
  },
} as const;

export const EBB_FIELDS = {
  microstepMode: { kind: "one-of", values: [1, 2, 3, 4, 5] },
  servoPosAt0Pct: {
    ...servoPos,
    label: "Servo at 0 %",
    about: "the servo's lowest position",
    default: 7_500,
  },
  servoPosAt100Pct: {
    ...servoPos,
    label: "Servo at 100 %",
    about: "the servo's highest position",
    default: 28_000,
  },
  servoPin: { kind: "one-of", values: [4, 5] },
  homing: { kind: "group", isOptional: true, fields: { x: SWITCH_INPUT, y: SWITCH_INPUT } },
  cornerSwitch: { kind: "group", isOptional: true, fields: SWITCH_INPUT.fields },
} as const satisfies ControllerFields;

/** The machine's controller as this driver's own. Throws `bad-setting` for a machine of another driver. */
export function ebbOf({ name, controller }: MachineProfile): EbbController {
  if (controller.kind === "ebb") return controller as EbbController;
  throw new PlotwrightError(
    "bad-setting",
    `${name} is not driven by an EiBotBoard: its profile says "${controller.kind}". Choose another machine, or plan with planJob, which knows every controller.`,
  );
}

/**
 * Whether the machine finds home by itself. In a mirrored frame its corner is not at 0, 0, so home is then set by hand.
 */
export function findsHome(machine: MachineProfile): boolean {
  const { homing, cornerSwitch } = ebbOf(machine);
  return Boolean(homing) || (Boolean(cornerSwitch) && !machine.flipX && !machine.flipY);
}

/** @throws PlotwrightError "bad-setting" for a machine of another driver, and for a missing or invalid field */
export function checkEbbProfile(machine: MachineProfile): void {
  checkProfile(machine);
  ebbOf(machine);
  checkController(machine, EBB_FIELDS);
}
