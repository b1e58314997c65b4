/**
 * A step-exact simulation of an EiBotBoard: bytes in, bytes out, on a clock.
 *
 * The simulation processes events (an order ends, a line arrives) in board ticks of 40 µs. Every event is processed at
 * its own tick, even if the timer fires late, so millisecond timers do not reduce accuracy. Only the arrival of bytes
 * from the host depends on the clock.
 *
 *   host ──write──> system buffer ──64-byte packets──> parser ──> queue (1 … 32) ──> motors, pen
 *                   (waits while the parser is blocked by a full queue)
 */
import { checkObject } from "../../../check-arguments.js";
import { PlotwrightError } from "../../../errors.js";
import { firmwareFeatures } from "../protocol/firmware.js";
import { xFromMotors, yFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineById } from "../../../machines/profiles.js";
import { ebbOf } from "../protocol/ebb-controller.js";
import { commandName, isQuery } from "../protocol/replies.js";
import { pctFromServoPos } from "../protocol/servo-height.js";
import { sFromTicks, TICKS_PER_MS, TICKS_PER_S } from "../../../units.js";
import { asciiBytes } from "../../line-splitter.js";
import type { DrawnPolyline } from "../../drawn-polylines.js";
import { scaledClock, type Clock, type Transport } from "../../transport.js";
import { VirtualLink } from "../../virtual-link.js";
import type { BoardStatistics } from "./board-totals.js";
import { BoardCore } from "./core.js";
import { DrawnLine } from "./drawn-line.js";
import { Gantry, type CarriagePlace } from "./gantry.js";
import { InputLines } from "./input.js";
import { InstantClock } from "./instant-clock.js";
import { Interpreter } from "./interpreter.js";
import { Motors } from "./motors.js";
import { factoryInputs, inputsAfterReset, supplyReading } from "./queries.js";
import { SwingingLine } from "./swinging-line.js";

import type { VirtualBoardOptions, VirtualBoardState } from "./board-options.js";

export type { VirtualBoardOptions, VirtualBoardState } from "./board-options.js";
export type { BoardStatistics } from "./board-totals.js";
export type { VirtualServo } from "./core.js";
export type { DrawnPolyline } from "../../drawn-polylines.js";

/** Where the carriage of a machine that finds home by itself begins. */
const IN_CORNER: CarriagePlace = { xMm: 0, yMm: 0 };
/** The least firmware with limit switches is 3.0.0. */
const HOMING_FIRMWARE = "3.0.3";

const SHORTEST_S = 1e-9;

/** Min supply voltage at which the motors turn. */
const MIN_MOTOR_VOLTS = 7;

/**
 * An EiBotBoard in software, exact to the step: connect to it with `transport()`. It has the queue, the limits and the
 * replies of its firmware version, and can simulate faults.
 */
export class VirtualBoard {
  /** The version that it reports. */
  readonly firmware: string;
  /** The carriage and the switch of a machine that finds home by itself, after its last move; null: another machine. */
  readonly gantry: Gantry | null;
  /** Counts board seconds, for `streamCommands`. At infinite speed, waiting takes no real time. */
  readonly clock: Clock;
  private readonly realClock: Clock;
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
  /** Commands to refuse. */
  private refuseCount = 0;
  private readonly sendListeners: ((bytes: Uint8Array) => void)[] = [];
  private readonly drainListeners: (() => void)[] = [];
  private readonly changeListeners: (() => void)[] = [];
  private readonly dropListeners: (() => void)[] = [];

  constructor(options: VirtualBoardOptions) {
    checkObject(
      "VirtualBoard",
      "the options object",
      options,
      ["clock"],
      "{ clock }, for example { clock: browserClock() }",
    );
    const speed = options.speed ?? 1;
    if (!(speed > 0)) throw new RangeError(`speed is ${speed}: expected more than 0`);
    this.realClock = options.clock;
    this.clock =
      speed === Infinity
        ? new InstantClock(options.clock, {
            nowS: () => this.core.nowTick / TICKS_PER_S,
            wait: (untilS) => (this.core.nowTick = Math.max(this.core.nowTick, untilS * TICKS_PER_S)),
          })
        : scaledClock(options.clock, speed);
    this.machine = options.machine ?? machineById("axidraw-v3");
    const { cornerSwitch } = ebbOf(this.machine);
    this.firmware = options.firmware ?? (cornerSwitch ? HOMING_FIRMWARE : "2.8.1");
    this.speed = speed;
    this.gantry = cornerSwitch ? new Gantry(this.machine, cornerSwitch, IN_CORNER) : null;
    this.parseTicks = (options.parseMs ?? 0) * TICKS_PER_MS;
    this.inputLimit = options.inputBytes ?? 256;
    this.systemLimit = options.systemBytes ?? 4_096;
    this.startS = options.clock.nowS();
    const { recordLine = true, servo = null, springs } = options;
    const line = springs ? new SwingingLine(this.machine, springs) : new DrawnLine(this.machine);
    const known = firmwareFeatures(this.firmware);
    const features = { ...known, idleTicksTimed: options.idleTicksTimed ?? known.idleTicksTimed };
    const motors = new Motors(this.gantry);
    this.core = new BoardCore(features, this.machine, recordLine ? line : null, servo, motors);
    this.interpreter = this.makeInterpreter();
  }

  // Byte interface, for a pseudo-terminal or a test.

  /** Takes bytes from the host, always. Check `accepting` first to behave like USB. */
  receive(bytes: Uint8Array): void {
    this.take(bytes, this.clockTick());
  }

  /** False while the board does not read, because too much input is unparsed. Continue to send at `onDrain`. */
  get accepting(): boolean {
    return this.input.byteCount < this.inputLimit;
  }

  /** Calls `listener` with every chunk that the board sends. */
  onSend(listener: (bytes: Uint8Array) => void): void {
    this.sendListeners.push(listener);
  }

  /** Calls `listener` when the board reads again. */
  onDrain(listener: () => void): void {
    this.drainListeners.push(listener);
  }

  /** Calls `listener` after any event: a command, the end of a move. */
  onChange(listener: () => void): void {
    this.changeListeners.push(listener);
  }

  /** Calls `listener` when the USB connection drops: RB, BL, `unplug()`, `resetByPower()`. */
  onDrop(listener: () => void): void {
    this.dropListeners.push(listener);
  }

  /** Opens the host's end of the connection. Opening another closes the previous one. */
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

  // State and results.

  /** The line drawn so far, mm from home: one polyline between consecutive pen moves. */
  drawn(): DrawnPolyline[] {
    this.run();
    return this.core.drawn();
  }

  /** The current step counters, position, pen and queue. */
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
      motorsOn: core.motors.mode1 !== 0 || core.motors.mode2 !== 0,
      isBusy: core.isBusy,
      waitingCount: core.fifo.length,
      boardS: sFromTicks(core.nowTick),
    };
  }

  /** Counts, distances and underruns since the start. */
  statistics(): BoardStatistics {
    this.run();
    return this.core.statistics();
  }

  // Simulated events and faults.

  /** Presses and releases the PRG button. */
  pressButton(): void {
    this.inputs.buttonLatched = true;
  }

  /** Presses the PRG button, or releases it. */
  holdButton(isDown: boolean): void {
    this.inputs.buttonDown = isDown;
    if (isDown) this.inputs.buttonLatched = true;
  }

  /**
   * Sets the motors' supply. 0: switched off; about 5: powered by USB alone. If the voltage is too low, the board counts
   * steps, but the motors do not turn. A voltage below the threshold set by CU,60 sets the power-lost flag.
   */
  setMotorVolts(volts: number): void {
    const { inputs } = this;
    this.run();
    this.core.setTurnsMotors(volts >= MIN_MOTOR_VOLTS);
    inputs.motorVolts = volts;
    if (inputs.powerThreshold > 0 && supplyReading(volts) < inputs.powerThreshold) {
      inputs.powerLostLatched = true;
    }
  }

  /**
   * While true, the board answers, but its motion is frozen: the running order never ends, and waiting ones never start.
   */
  setFrozen(isFrozen: boolean): void {
    this.run();
    this.core.setFrozen(isFrozen);
    this.run();
  }

  /** While true, moves take their normal time, but the step counters (and motors) do not change. */
  setMotionless(isMotionless: boolean): void {
    this.run();
    this.core.setMakesSteps(!isMotionless);
    this.run();
  }

  /** While true, the board accepts everything and answers nothing. */
  setMute(isMute: boolean): void {
    this.isMute = isMute;
    if (!isMute) this.run();
  }

  /** Sends bytes that belong to no reply. */
  sendGarbage(bytes: Uint8Array): void {
    this.sendBytes(bytes);
  }

  /** The next `count` replies are not sent. */
  loseReplies(count: number): void {
    this.repliesToLose += count;
  }

  /** Corrupts one character of each of the next commands that are no queries, so that the board refuses them. */
  refuseNext(count = 1): void {
    this.refuseCount = count;
  }

  /** Limits the speed of received bytes. Infinity: no limit. */
  setUsbBytesPerS(bytesPerS: number): void {
    this.ticksPerByte = Number.isFinite(bytesPerS) ? TICKS_PER_S / bytesPerS : 0;
  }

  /** Unplugs the cable: the connection drops. The board, powered by the motor supply, finishes its queue. */
  unplug(): void {
    this.dropLine("The virtual board was unplugged.");
  }

  /** The supply fails briefly: counters and queue are lost, and the connection drops. */
  resetByPower(): void {
    this.boot();
    this.dropLine("The virtual board was reset.");
  }

  /** The logic supply fails briefly: counters, queue and settings are lost, but the connection stays open. */
  restart(): void {
    this.run();
    this.boot();
    this.run();
  }

  /** Stops the board permanently: its time stops, and no timer keeps the process alive. */
  close(): void {
    this.isClosed = true;
    this.cancelTimer?.();
    this.cancelTimer = null;
    this.link?.drop();
    this.link = null;
  }

  // Internals.

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

  /** Restores boot defaults. The drawn line is kept. */
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
    return (this.realClock.nowS() - this.startS) * this.speed * TICKS_PER_S;
  }

  /** Processes all events that are due, in order. */
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
    const isEvent = core.nextEventTick <= this.nextParseTick();
    core.nowTick = Math.max(core.nowTick, tick);
    if (isEvent) {
      core.happen();
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
    if (this.refuseCount === 0 || line === "" || isQuery(commandName(line))) return line;
    this.refuseCount--;
    return `#${line.slice(1)}`;
  }

  private setTimer(): void {
    this.cancelTimer?.();
    this.cancelTimer = null;
    const tick = this.nextTick();
    if (tick === Infinity || this.speed === Infinity || this.isClosed) return;
    const delayS = (tick - this.core.nowTick) / (TICKS_PER_S * this.speed);
    // A shorter delay may be lost to rounding, and the time of the timer then never comes.
    this.cancelTimer = this.realClock.after(Math.max(SHORTEST_S, delayS), () => {
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
    this.sendBytes(asciiBytes(text));
  }

  private sendBytes(bytes: Uint8Array): void {
    this.link?.deliver(bytes);
    for (const listener of this.sendListeners) listener(bytes);
  }
}
