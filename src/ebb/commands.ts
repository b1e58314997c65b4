/**
 * Command lines of the EiBotBoard: those a plot begins and ends with, and a writer for the stream between.
 */
import { servoPosFromPct } from "../machines/pen.js";
import type { MachineProfile } from "../machines/profile.js";
import type { PenSettings } from "../plan/settings.js";
import { firmwareFeatures } from "./firmware.js";

/** The servo goes its way in this part of the wait for it; the rest lets it come to rest. */
const SERVO_PART_OF_WAIT = 0.65;
const SERVO_FRAME_MS = 24;
/** The standard servo's output: the only one that SP moves. */
const STANDARD_PIN = 4;

/** Before the first plot after connecting: motors on (which zeroes the step counters), pen heights and speeds. */
export function setUpCommands(machine: MachineProfile, pen: PenSettings, firmware: string): string[] {
  const features = firmwareFeatures(firmware);
  const lines = [`EM,${machine.microstepMode},${machine.microstepMode}`];
  // Older boards keep their accumulators through EM: CS makes them known.
  if (!features.enableClearsAccumulators && features.hasStepQuery) lines.push("CS");
  return [...lines, ...penSetUpCommands(machine, pen)];
}

/** After the last plot: motors off, so that the carriage can be moved by hand. */
export const closingCommands = (): string[] => ["EM,0,0"];

/** Heights and speeds of the pen; they hold for every SP that follows. Empty where S2 moves the pen. */
export function penSetUpCommands(machine: MachineProfile, pen: PenSettings): string[] {
  if (machine.servoPin !== STANDARD_PIN) return [];
  const up = servoPosFromPct(machine, pen.upPct);
  const down = servoPosFromPct(machine, pen.downPct);
  return [
    `SC,4,${up}`,
    `SC,5,${down}`,
    `SC,11,${servoRate(up - down, pen.liftMs)}`,
    `SC,12,${servoRate(up - down, pen.dropMs)}`,
  ];
}

/** One pen move to a height, holding the queue for `waitMs`. Heights of SP come from `penSetUpCommands`. */
export function penCommand(
  machine: MachineProfile,
  up: boolean,
  heightPct: number,
  wayPct: number,
  waitMs: number,
): string {
  const delayMs = Math.max(0, Math.min(MAX_DELAY_MS, Math.round(waitMs)));
  if (machine.servoPin === STANDARD_PIN) return `SP,${up ? 1 : 0},${delayMs}`;
  const position = servoPosFromPct(machine, heightPct);
  const way = servoPosFromPct(machine, wayPct) - servoPosFromPct(machine, 0);
  return `S2,${position},${machine.servoPin},${servoRate(way, waitMs)},${delayMs}`;
}

/** The longest delay that SP and S2 take. */
export const MAX_DELAY_MS = 65_535;

/** Change of servo position a 24 ms frame that is done with the way in good time. */
function servoRate(way: number, waitMs: number): number {
  const frames = Math.max(1, Math.floor((waitMs * SERVO_PART_OF_WAIT) / SERVO_FRAME_MS));
  return Math.max(1, Math.min(MAX_DELAY_MS, Math.ceil(Math.abs(way) / frames)));
}

const CR = 13;
const COMMA = 44;
const MINUS = 45;
const ZERO = 48;

/** Writes command lines into one growing block of ASCII. */
export class CommandText {
  private bytes: Uint8Array = new Uint8Array(1 << 12);
  private length = 0;
  private readonly digits = new Uint8Array(16);

  get byteCount(): number {
    return this.length;
  }

  /** A whole line, without its end. */
  line(text: string): void {
    this.name(text);
    this.end();
  }

  name(text: string): void {
    this.reserve(text.length);
    for (let i = 0; i < text.length; i++) this.bytes[this.length++] = text.charCodeAt(i);
  }

  /** A comma and a whole number. */
  number(value: number): void {
    this.reserve(18);
    this.bytes[this.length++] = COMMA;
    let rest = value;
    if (rest < 0) {
      this.bytes[this.length++] = MINUS;
      rest = -rest;
    }
    let count = 0;
    do {
      const next = Math.floor(rest / 10);
      this.digits[count++] = ZERO + (rest - 10 * next);
      rest = next;
    } while (rest > 0);
    while (count > 0) this.bytes[this.length++] = this.digits[--count]!;
  }

  end(): void {
    this.reserve(1);
    this.bytes[this.length++] = CR;
  }

  finish(): Uint8Array {
    return this.bytes.slice(0, this.length);
  }

  private reserve(count: number): void {
    if (this.length + count <= this.bytes.length) return;
    const grown = new Uint8Array(2 * this.bytes.length + count);
    grown.set(this.bytes);
    this.bytes = grown;
  }
}
