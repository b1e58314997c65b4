/** The values of the board's replies to queries, as each firmware formats them. */
import type { BoardCore } from "./core.js";

/** State outside the motion queue that queries report. */
export interface BoardInputs {
  buttonLatched: boolean;
  buttonDown: boolean;
  motorVolts: number;
  powerLostLatched: boolean;
  powerThreshold: number;
  name: string;
  nodeCount: number;
  readonly layer: Uint8Array;
}

const MOTOR_SUPPLY_VOLTS = 9.1;

/** A board that has never been used. */
export const factoryInputs = (): BoardInputs => ({
  buttonLatched: false,
  buttonDown: false,
  motorVolts: MOTOR_SUPPLY_VOLTS,
  powerLostLatched: false,
  powerThreshold: 0,
  name: "",
  nodeCount: 0,
  layer: new Uint8Array(32),
});

/** The state after a reset, which keeps the name in flash memory and the inputs from outside the board. */
export const inputsAfterReset = ({ name, motorVolts, buttonDown }: BoardInputs): BoardInputs => ({
  ...factoryInputs(),
  name,
  motorVolts,
  buttonDown,
});

export class BoardQueries {
  constructor(
    private readonly core: BoardCore,
    private readonly inputs: BoardInputs,
  ) {}

  versionText(): string {
    return `EBBv13_and_above EB Firmware Version ${this.core.features.version}`;
  }

  motorsText(): string {
    const { core } = this;
    const flags = [core.isBusy, ...core.motorsMoving()];
    if (this.core.isFrom("2.4.4")) flags.push(core.fifo.length > 0);
    return flags.map(Number).join(",");
  }

  generalText(): string {
    const { core, inputs } = this;
    const [moving1, moving2] = core.motorsMoving();
    let bits = 0;
    if (core.fifo.length > 0) bits |= 1;
    if (moving2) bits |= 2;
    if (moving1) bits |= 4;
    if (core.isBusy) bits |= 8;
    if (core.penUp) bits |= 16;
    if (inputs.buttonLatched) bits |= 32;
    if (core.isFrom("3.0.0") && inputs.powerLostLatched) bits |= 64;
    if (core.motors.limitReached) bits |= 128;
    inputs.buttonLatched = false;
    inputs.powerLostLatched =
      inputs.powerThreshold > 0 && supplyReading(inputs.motorVolts) < inputs.powerThreshold;
    return bits.toString(16).toUpperCase().padStart(2, "0");
  }

  takeButton(): string {
    const pressed = this.inputs.buttonLatched || this.inputs.buttonDown;
    this.inputs.buttonLatched = false;
    return pressed ? "1" : "0";
  }

  currentText(): string {
    const CURRENT_SETTING = 394;
    return [CURRENT_SETTING, supplyReading(this.inputs.motorVolts)].map((n) => this.padded(n, 4)).join(",");
  }

  microstepText(): string {
    const divisor = (mode: number): number => (mode === 0 ? 0 : 2 ** (5 - mode));
    return `${divisor(this.core.motors.mode1)},${divisor(this.core.motors.mode2)}`;
  }

  /** Firmware before 3.0 pads numbers with zeros. */
  padded(value: number, digits: number): string {
    return this.core.isFrom("3.0.0") ? `${value}` : `${value}`.padStart(digits, "0");
  }
}

/** A/D reading of the motor supply: behind a diode and a divider of 9.2; 1023 = 3.3 V. */
export function supplyReading(volts: number): number {
  return Math.max(0, Math.min(1_023, Math.round((((volts - 0.3) / 9.2) * 1_023) / 3.3)));
}
