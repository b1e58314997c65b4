/**
 * The carriage of a simulated machine with one switch, which may be elsewhere than the step counters say. Native axes, mm
 * from the corner: motor 1 turns x + y, motor 2 turns x − y.
 *
 *      y ┌───────────┐      both motors on    the carriage follows them as far as the stops
 *        │           │      one on, one off   it moves diagonally to a stop, then along it; the free motor is dragged
 *      0 └───────────┘ x    a motor goes on   its rotor jumps to the nearest position that fits the driver's phase
 *        0: pressed here and to the left; the stop is behind it
 */
import type { MachineProfile } from "../../../machines/profile.js";
import { ebbOf, type SwitchInput } from "../protocol/ebb-controller.js";

/** The stops are this far behind the travel limits; the one at y = 0 is exactly there. */
const BEHIND_MM = 2;
/** A driver's phase repeats after four whole steps, here in 1/16 steps. */
const CYCLE = 4 * 16;
/** Tolerances for positions computed from steps. */
const TOUCH_MM = 1e-6;
const SAME_STEPS = 1e-3;

/** "absent": not plugged in, which reads as pressed. "stuck": it never reads as pressed. */
export type SwitchCondition = "good" | "absent" | "stuck";

export interface CarriagePlace {
  readonly xMm: number;
  readonly yMm: number;
}

interface Motor {
  isOn: boolean;
  /** What its driver was told to make, 1/16 steps. */
  phase: number;
  /** Where its magnets pull the rotor to, 1/16 steps from the corner. A stop may keep the rotor from there. */
  pulledTo: number;
}

export class Gantry {
  switchCondition: SwitchCondition = "good";
  /** Something is in the way: the carriage gets no further left than this. */
  obstacleMm = -Infinity;
  private readonly motor1: Motor = { isOn: false, phase: 0, pulledTo: 0 };
  private readonly motor2: Motor = { isOn: false, phase: 0, pulledTo: 0 };
  /** 1/16 steps in a step of the present mode, and in one of the profile's. */
  private perStep = 1;
  private readonly perOwnStep: number;
  /** 1/16 steps. */
  private readonly perMm: number;

  constructor(
    private readonly machine: MachineProfile,
    readonly input: SwitchInput,
    private place: CarriagePlace,
  ) {
    this.perOwnStep = 2 ** (ebbOf(machine).microstepMode - 1);
    this.perMm = machine.stepsPerMm * this.perOwnStep;
  }

  get carriage(): CarriagePlace {
    return this.place;
  }

  /** The motors' positions, counted from the corner in steps of the machine's profile. */
  get steps(): readonly [number, number] {
    const [at1, at2] = this.motorsAt(this.place);
    return [at1 / this.perOwnStep, at2 / this.perOwnStep];
  }

  /** Puts the carriage there by hand. The phases of the drivers are then by chance. */
  push(place: CarriagePlace, phase1 = 0, phase2 = 0): void {
    this.place = place;
    this.motor1.phase = phase1;
    this.motor2.phase = phase2;
  }

  /** Switches the motors on or off. `modes`: 1 … 5, 0: off. A rotor may jump. */
  setModes(mode1: number, mode2: number): void {
    const mode = mode1 || mode2;
    if (mode !== 0) this.perStep = 2 ** (mode - 1);
    const [at1, at2] = this.motorsAt(this.place);
    this.setOn(this.motor1, mode1 !== 0, at1);
    this.setOn(this.motor2, mode2 !== 0, at2);
    this.place = this.placeAfter(0, 0);
  }

  /** Makes steps. Returns whether the rotors made them all: not if a motor is off or at a stop. */
  turn(steps1: number, steps2: number): boolean {
    const [before1, before2] = this.motorsAt(this.place);
    this.place = this.placeAfter(steps1, steps2);
    const [at1, at2] = this.motorsAt(this.place);
    this.step(this.motor1, steps1, at1);
    this.step(this.motor2, steps2, at2);
    const { perStep } = this;
    return Math.hypot(at1 - before1 - steps1 * perStep, at2 - before2 - steps2 * perStep) < SAME_STEPS;
  }

  /** The level of the switch's pin when that many steps have been made. */
  levelAfter(steps1: number, steps2: number): number {
    if (this.switchCondition !== "good") return this.switchCondition === "absent" ? 1 : 0;
    const isPressed = this.placeAfter(steps1, steps2).xMm <= TOUCH_MM;
    return isPressed ? this.input.pressed : 1 - this.input.pressed;
  }

  private setOn(motor: Motor, isOn: boolean, at: number): void {
    if (isOn && !motor.isOn) {
      motor.pulledTo = motor.phase + CYCLE * Math.round((at - motor.phase) / CYCLE);
    }
    motor.isOn = isOn;
  }

  /** A rotor that is kept back by more than half a cycle slips by whole cycles. */
  private step(motor: Motor, steps: number, at: number): void {
    motor.phase += steps * this.perStep;
    motor.pulledTo += steps * this.perStep;
    motor.pulledTo -= CYCLE * Math.round((motor.pulledTo - at) / CYCLE);
  }

  private placeAfter(steps1: number, steps2: number): CarriagePlace {
    const { motor1, motor2, perStep } = this;
    const [at1, at2] = this.motorsAt(this.place);
    const to1 = motor1.pulledTo + steps1 * perStep;
    const to2 = motor2.pulledTo + steps2 * perStep;
    if (motor1.isOn && motor2.isOn) return this.stopped(to1, to2);
    if (motor1.isOn) return this.dragged(to1, at2, 1);
    if (motor2.isOn) return this.dragged(at1, to2, -1);
    return this.place;
  }

  private stopped(at1: number, at2: number): CarriagePlace {
    const { minX, maxX, minY, maxY } = this.stops();
    const { xMm, yMm } = this.placeOf(at1, at2);
    return { xMm: clamp(xMm, minX, maxX), yMm: clamp(yMm, minY, maxY) };
  }

  /** One motor is on and turns x + `sign` y. What a stop keeps one axis from, the other one moves. */
  private dragged(at1: number, at2: number, sign: 1 | -1): CarriagePlace {
    const { minX, maxX, minY, maxY } = this.stops();
    const { xMm, yMm } = this.placeOf(at1, at2);
    const sum = xMm + sign * yMm;
    const x = clamp(sum - sign * clamp(yMm, minY, maxY), minX, maxX);
    return { xMm: x, yMm: clamp(sign * (sum - x), minY, maxY) };
  }

  private stops(): { minX: number; maxX: number; minY: number; maxY: number } {
    const { widthMm, heightMm } = this.machine;
    return {
      minX: Math.max(-BEHIND_MM, Math.min(this.obstacleMm, this.place.xMm)),
      maxX: widthMm + BEHIND_MM,
      minY: 0,
      maxY: heightMm + BEHIND_MM,
    };
  }

  private motorsAt({ xMm, yMm }: CarriagePlace): readonly [number, number] {
    return [(xMm + yMm) * this.perMm, (xMm - yMm) * this.perMm];
  }

  private placeOf(at1: number, at2: number): CarriagePlace {
    return { xMm: (at1 + at2) / 2 / this.perMm, yMm: (at1 - at2) / 2 / this.perMm };
  }
}

const clamp = (value: number, min: number, max: number): number => Math.min(max, Math.max(min, value));
