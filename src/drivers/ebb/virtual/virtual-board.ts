/**
 * An EiBotBoard in software: bytes in, bytes out, on a clock; step-exact.
 *
 * Discrete events in board ticks (40 µs): an order ends, a line arrives. Every event happens at its own tick
 * however late the clock calls, so timers of a millisecond cost nothing in exactness; only what depends on
 * the host (when bytes come) depends on the clock.
 *
 *   host ──write──> system buffer ──64-byte packets──> parser ──> queue (1 … 32) ──> motors, pen
 *                   (waits while the parser is blocked by a full queue)
 */
import { PlotwrightError } from "../../../errors.js";
import { firmwareFeatures } from "../protocol/firmware.js";
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineById } from "../../../machines/profiles.js";
import { pctFromServoPos } from "../../../machines/pen.js";
import { TICKS_PER_S } from "../../../units.js";
import type { Clock, Transport } from "../../transport.js";
import { BoardCore, type BoardStatistics } from "./core.js";
import type { DrawnPolyline } from "./drawn-line.js";
import { InputLines } from "./input.js";
import { Interpreter } from "./interpreter.js";
import { VirtualLink } from "./link.js";
import { factoryInputs, inputsAfterReset, supplyReading } from "./queries.js";

export type { BoardStatistics } from "./core.js";
export type { DrawnPolyline } from "./drawn-line.js";

/** Below this the motors do not turn. */
const LEAST_MOTOR_VOLTS = 7;

export interface VirtualBoardOptions {
  readonly clock: Clock;
  /** Default "2.8.1". */
  readonly firmware?: string;
  /** Board seconds a clock second. Infinity: every move is over as soon as it is sent. Default 1. */
  readonly speed?: number;
  /** Default AxiDraw V3. */
  readonly machine?: MachineProfile;
  /** Keep the drawn line. Default true. */
  readonly recordLine?: boolean;
  /** Board time that parsing a command takes. Default 0. */
  readonly parseMs?: number;
  /** Bytes that may wait unparsed before the board stops reading. Default 256. */
  readonly inputBytes?: number;
  /** Bytes that the host's system takes from `transport()` beyond that. Default 4096. */
  readonly systemBytes?: number;
}

export interface VirtualBoardState {
  readonly firmware: string;
  readonly steps1: number;
  readonly steps2: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  /** Where the servo is just now. */
  readonly penPct: number;
  readonly motorsOn: boolean;
  readonly isBusy: boolean;
  /** Orders that wait behind the running one. */
  readonly waitingCount: number;
  /** Board seconds since it was made. */
  readonly boardS: number;
}

export class VirtualBoard {
  readonly firmware: string;
  private readonly clock: Clock;
  private readonly speed: number;
  private readonly machine: MachineProfile;
  private readonly parseTicks: number;
  private readonly inputLimit: number;
  private readonly systemLimit: number;
  private readonly startS: number;
  private readonly input = new InputLines();
  private inputs = factoryInputs();
  private core: BoardCore;
  private interpreter: Interpreter;
  private parserFreeTick = 0;
  private cancelTimer: (() => void) | null = null;
  private isRunning = false;
  private isClosed = false;
  private isFull = false;
  private link: VirtualLink | null = null;
  private ticksPerByte = 0;
  private isMute = false;
  private repliesToLose = 0;
  private refusesNext = false;
  private readonly sendListeners: ((bytes: Uint8Array) => void)[] = [];
  private readonly drainListeners: (() => void)[] = [];
  private readonly changeListeners: (() => void)[] = [];
  private readonly dropListeners: (() => void)[] = [];

  constructor(options: VirtualBoardOptions) {
    const speed = options.speed ?? 1;
    if (!(speed > 0)) throw new RangeError(`speed is ${speed}: expected more than 0`);
    this.clock = options.clock;
    this.firmware = options.firmware ?? "2.8.1";
    this.speed = speed;
    this.machine = options.machine ?? machineById("axidraw-v3");
    this.parseTicks = ((options.parseMs ?? 0) / 1_000) * TICKS_PER_S;
    this.inputLimit = options.inputBytes ?? 256;
    this.systemLimit = options.systemBytes ?? 4_096;
    this.startS = this.clock.nowS();
    this.core = new BoardCore(firmwareFeatures(this.firmware), this.machine, options.recordLine ?? true);
    this.interpreter = this.makeInterpreter();
  }

  // The byte side, for whoever carries the bytes (a pseudo-terminal, a test).

  /** Bytes from the host. They are never refused; mind `accepting` to behave as USB does. */
  receive(bytes: Uint8Array): void {
    this.take(bytes, this.clockTick());
  }

  /** False while so much waits unparsed that the board does not read: stop, and go on at `onDrain`. */
  get accepting(): boolean {
    return this.input.byteCount < this.inputLimit;
  }

  onSend(listener: (bytes: Uint8Array) => void): void {
    this.sendListeners.push(listener);
  }

  /** Called when the board reads again. */
  onDrain(listener: () => void): void {
    this.drainListeners.push(listener);
  }

  /** Called after anything happened: a command, the end of a move. */
  onChange(listener: () => void): void {
    this.changeListeners.push(listener);
  }

  /** Called when the USB line drops: RB, BL, `unplug()`, `resetByPower()`. */
  onDrop(listener: () => void): void {
    this.dropListeners.push(listener);
  }

  /** A host's end of the line. Opening another closes the one before. */
  transport(): Transport {
    this.link?.drop(new PlotwrightError("disconnected", "Another program has opened the virtual board."));
    this.input.clear();
    this.link = new VirtualLink(this.systemLimit, {
      accepting: () => this.accepting,
      nowTick: () => this.clockTick(),
      take: (bytes, tick) => this.take(bytes, tick),
    });
    return this.link;
  }

  // What it has done.

  /** The line drawn so far, mm from home: one polyline from each pen move to the next. */
  drawn(): DrawnPolyline[] {
    this.run();
    return this.core.drawn();
  }

  state(): VirtualBoardState {
    this.run();
    const { core, machine } = this;
    const [steps1, steps2] = core.stepsNow();
    return {
      firmware: this.firmware,
      steps1,
      steps2,
      xMm: xFromMotors(machine, steps1, steps2),
      yMm: yFromMotors(machine, steps1, steps2),
      penUp: core.penUp,
      penPct: pctFromServoPos(machine, core.servoPosition()),
      motorsOn: core.mode1 !== 0 || core.mode2 !== 0,
      isBusy: core.isBusy,
      waitingCount: core.fifo.length,
      boardS: core.nowTick / TICKS_PER_S,
    };
  }

  statistics(): BoardStatistics {
    this.run();
    return this.core.statistics();
  }

  // What may happen to a board.

  pressButton(): void {
    this.inputs.buttonLatched = true;
  }

  holdButton(isDown: boolean): void {
    this.inputs.buttonDown = isDown;
    if (isDown) this.inputs.buttonLatched = true;
  }

  /**
   * 0 = switched off, about 5 = fed by USB alone: the board counts its steps, and the motors stand. Below the threshold
   * set by CU,60 the board remembers it.
   */
  setMotorVolts(volts: number): void {
    const { inputs } = this;
    this.run();
    this.core.setTurnsMotors(volts >= LEAST_MOTOR_VOLTS);
    inputs.motorVolts = volts;
    if (inputs.powerThreshold > 0 && supplyReading(volts) < inputs.powerThreshold) {
      inputs.powerLostLatched = true;
    }
  }

  /** It answers, but its motion stands still: what runs never ends and what waits never begins, until false. */
  setFrozen(isFrozen: boolean): void {
    this.run();
    this.core.setFrozen(isFrozen);
    this.run();
  }

  /** It takes moves and spends their time, but its step counters (and motors) stand still, until false. */
  setMotionless(isMotionless: boolean): void {
    this.run();
    this.core.setMakesSteps(!isMotionless);
    this.run();
  }

  /** Takes everything in and answers nothing, until called with false. */
  setMute(isMute: boolean): void {
    this.isMute = isMute;
    if (!isMute) this.run();
  }

  /** Sends bytes that belong to no answer. */
  sendGarbage(bytes: Uint8Array): void {
    this.sendBytes(bytes);
  }

  loseReplies(count: number): void {
    this.repliesToLose += count;
  }

  /** One letter of the next command is changed on the line, so the board refuses it. */
  refuseNext(): void {
    this.refusesNext = true;
  }

  /** Infinity: as fast as USB. */
  setUsbBytesPerS(bytesPerS: number): void {
    this.ticksPerByte = Number.isFinite(bytesPerS) ? TICKS_PER_S / bytesPerS : 0;
  }

  /** The cable comes out: the line drops, the board (which lives on the motor supply) finishes what it holds. */
  unplug(): void {
    this.dropLine("The virtual board was unplugged.");
  }

  /** The supply fails for a moment: counters and queue are lost, and the line drops. */
  resetByPower(): void {
    this.boot();
    this.dropLine("The virtual board was reset.");
  }

  /** It starts anew (its logic's supply fails for a moment): counters, queue and settings are lost, the line stays. */
  restart(): void {
    this.run();
    this.boot();
    this.run();
  }

  /** For good: its time stands still, and no timer is left that would keep a process alive. */
  close(): void {
    this.isClosed = true;
    this.cancelTimer?.();
    this.cancelTimer = null;
    this.link?.drop();
    this.link = null;
  }

  // Inside.

  private take(bytes: Uint8Array, arrivalTick: number): void {
    this.input.receive(bytes, arrivalTick, this.ticksPerByte);
    if (!this.accepting) this.isFull = true;
    this.run();
  }

  private makeInterpreter(): Interpreter {
    return new Interpreter(this.core, this.inputs, {
      send: (text) => this.reply(text),
      reset: () => this.boot(),
      restart: () => {
        this.boot();
        this.dropLine("The virtual board restarts.");
      },
    });
  }

  /** Boot defaults. The line drawn stays drawn. */
  private boot(): void {
    this.inputs = inputsAfterReset(this.inputs);
    this.core = this.core.rebooted();
    this.interpreter = this.makeInterpreter();
  }

  private dropLine(why: string): void {
    this.input.clear();
    const link = this.link;
    this.link = null;
    link?.drop(new PlotwrightError("disconnected", `${why} Plug it in again or start it again.`));
    for (const listener of this.dropListeners) listener();
  }

  private clockTick(): number {
    if (this.speed === Infinity) return this.core.nowTick;
    return (this.clock.nowS() - this.startS) * this.speed * TICKS_PER_S;
  }

  /** Lets everything happen that is due, in order. */
  private run(): void {
    if (this.isRunning) return;
    this.isRunning = true;
    const untilTick = this.speed === Infinity ? Infinity : this.clockTick();
    let happened = false;
    try {
      for (;;) {
        const tick = this.nextTick();
        if (tick > untilTick || tick === Infinity) break;
        happened = true;
        this.happen(tick);
      }
      if (untilTick !== Infinity) this.core.nowTick = Math.max(this.core.nowTick, untilTick);
    } finally {
      this.isRunning = false;
    }
    this.setTimer();
    if (!happened) return;
    for (const listener of this.changeListeners) listener();
  }

  private nextParseTick(): number {
    if (this.interpreter.isBlocked) return Infinity;
    const arrival = this.input.nextArrivalTick;
    return arrival === Infinity ? Infinity : Math.max(arrival, this.parserFreeTick);
  }

  private nextTick(): number {
    return Math.min(this.core.nextEventTick, this.nextParseTick());
  }

  private happen(tick: number): void {
    const { core } = this;
    const isOrderEnd = core.nextEventTick <= this.nextParseTick();
    core.nowTick = Math.max(core.nowTick, tick);
    if (isOrderEnd) {
      core.finishRunning();
    } else {
      this.parserFreeTick = core.nowTick + this.parseTicks;
      this.interpreter.run(this.takeLine());
    }
    if (this.interpreter.isBlocked) {
      this.interpreter.resume();
      this.parserFreeTick = Math.max(this.parserFreeTick, core.nowTick);
    }
    if (this.isFull && this.accepting) {
      this.isFull = false;
      this.link?.pump();
      for (const listener of this.drainListeners) listener();
    }
  }

  private takeLine(): string {
    const line = this.input.take();
    if (!this.refusesNext || line === "") return line;
    this.refusesNext = false;
    return `#${line.slice(1)}`;
  }

  private setTimer(): void {
    this.cancelTimer?.();
    this.cancelTimer = null;
    const tick = this.nextTick();
    if (tick === Infinity || this.speed === Infinity || this.isClosed) return;
    const delayS = (tick - this.core.nowTick) / (TICKS_PER_S * this.speed);
    this.cancelTimer = this.clock.after(Math.max(0, delayS), () => {
      this.cancelTimer = null;
      this.run();
    });
  }

  private reply(text: string): void {
    if (this.isMute) return;
    if (this.repliesToLose > 0) {
      this.repliesToLose--;
      return;
    }
    this.sendBytes(Uint8Array.from(text, (c) => c.charCodeAt(0)));
  }

  private sendBytes(bytes: Uint8Array): void {
    this.link?.deliver(bytes);
    for (const listener of this.sendListeners) listener(bytes);
  }
}
