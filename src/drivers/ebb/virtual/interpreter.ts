/**
 * The board's commands: a table of handlers by name, and the replies.
 *
 * A command is answered when it is queued or, if it acts at once, done. A command that has to wait (for room in the
 * queue, or in the case of CU,4 and HM for the motors to stop) blocks all later ones, as in the board's parser.
 */
import { ebbOf, STANDARD_PIN } from "../protocol/ebb-controller.js";
import { commandName, MAX_LINE_BYTES, replyShape } from "../protocol/replies.js";
import type { BoardCore } from "./core.js";
import { MotionCommands } from "../model/motion-commands.js";
import type { Order } from "../model/orders.js";
import { BoardFault, invalidValue, Parameters } from "../model/parameters.js";
import { BoardQueries, type BoardInputs } from "./queries.js";
import { TICKS_PER_MS } from "../../../units.js";

const MS16 = 65_535;
/** Max of SC,8. */
const MAX_SERVO_CHANNELS = 24;

/** The effect of a parsed command. */
interface Action {
  /** Orders for the queue, each added as soon as there is room. */
  readonly orders?: readonly Order[];
  /** Called when the motion queue is empty. Returns further orders. */
  readonly whenIdle?: () => readonly Order[];
  /** The values of the reply, read when the command is answered. */
  readonly values?: () => string;
  /** No reply at all. */
  readonly isSilent?: boolean;
  /** The reply is exactly this text. */
  readonly raw?: string;
  /** Called after the reply. */
  readonly then?: () => void;
}

/** Nothing is returned for a command that acted at once and is answered without values. */
type Handler = (parameters: Parameters) => Action | void;

interface InterpreterHooks {
  readonly send: (text: string) => void;
  /** R: restores boot defaults; the USB connection stays open. */
  readonly reset: () => void;
  /** RB, BL: the USB connection drops. */
  readonly restart: () => void;
}

export class Interpreter {
  // Settings of the board that last until a reset.
  private hasFutureSyntax = false;
  private sendsOk = true;
  private isTestMode = false;
  private readonly motion: MotionCommands;
  private readonly queries: BoardQueries;
  private readonly handlers: ReadonlyMap<string, Handler>;
  private blocked: { name: string; action: Action; orders: Order[]; extra: boolean } | null = null;

  constructor(
    private readonly core: BoardCore,
    private readonly inputs: BoardInputs,
    private readonly hooks: InterpreterHooks,
  ) {
    this.motion = new MotionCommands(core.features, () => this.isTestMode);
    this.queries = new BoardQueries(core, inputs);
    this.handlers = this.commands();
  }

  /** True while a command waits for room or for the motors to stop. Nothing else is parsed meanwhile. */
  get isBlocked(): boolean {
    return this.blocked !== null;
  }

  /** Parses and executes one line (without its line end). */
  run(line: string): void {
    if (line.length > MAX_LINE_BYTES) {
      this.sendError("", new BoardFault(3, "Err: RX Buffer overrun"));
      return;
    }
    const name = commandName(line);
    const handler = this.handlers.get(name);
    try {
      if (handler === undefined) throw unknownCommand(name);
      const parameters = new Parameters(line.slice(name.length));
      const action = handler(parameters) ?? {};
      this.blocked = { name, action, orders: [...(action.orders ?? [])], extra: parameters.hasMore };
      this.resume();
    } catch (error) {
      if (!(error instanceof BoardFault)) throw error;
      this.sendError(name, error);
    }
  }

  /** Called whenever the queue has advanced. */
  resume(): void {
    const { blocked, core } = this;
    if (blocked === null) return;
    if (blocked.action.whenIdle !== undefined) {
      if (core.isBusy) return;
      blocked.orders.push(...blocked.action.whenIdle());
      blocked.action = {};
    }
    while (blocked.orders.length > 0) {
      if (!core.hasRoom) return;
      core.enqueue(blocked.orders.shift()!);
    }
    this.blocked = null;
    this.answer(blocked.name, blocked.action);
    if (blocked.extra) this.sendError(blocked.name, new BoardFault(7, "Err: Extra parameter"));
    blocked.action.then?.();
  }

  private answer(name: string, action: Action): void {
    if (action.isSilent === true) return;
    if (action.raw !== undefined) {
      this.hooks.send(action.raw);
      return;
    }
    const values = action.values?.();
    if (this.hasFutureSyntax) {
      const extraLine = name === "QU" ? "\n" : "";
      this.hooks.send((values === undefined ? name : `${name},${values}`) + "\n" + extraLine);
      return;
    }
    const shape = replyShape(name);
    let text = "";
    if (values !== undefined) text += (shape.isNamed ? `${name},` : "") + values + (shape.valueEnd ?? "");
    if (shape.ok) text += this.okText();
    this.hooks.send(text);
  }

  private okText(): string {
    if (this.sendsOk) return "OK\r\n";
    return this.core.features.hasFutureSyntax ? "\r\n" : "";
  }

  private sendError(name: string, fault: BoardFault): void {
    if (this.hasFutureSyntax && name !== "") this.hooks.send(`${name},!${fault.code} ${fault.text}\n`);
    else this.hooks.send(`!${fault.code} ${fault.text}\r\n`);
  }

  private commands(): ReadonlyMap<string, Handler> {
    const table: [string, string, Handler][] = [
      ["V", "0.0.0", () => ({ values: () => this.queries.versionText() })],
      ["SM", "0.0.0", (p) => ({ orders: this.motion.slow(p, false) })],
      ["XM", "2.3.0", (p) => ({ orders: this.motion.slow(p, true) })],
      ["LM", "2.5.0", (p) => ({ orders: this.motion.stepped(p, false) })],
      ["L3", "3.0.0", (p) => ({ orders: this.motion.stepped(p, true) })],
      ["LT", "2.7.0", (p) => ({ orders: this.motion.timed(p, false) })],
      ["T3", "3.0.0", (p) => ({ orders: this.motion.timed(p, true) })],
      ["TD", "3.0.1", (p) => ({ orders: this.motion.timedDouble(p) })],
      ["HM", "2.6.2", (p) => this.home(p)],
      ["SP", "0.0.0", (p) => this.pen(p)],
      ["TP", "0.0.0", (p) => this.togglePen(p)],
      ["S2", "2.2.0", (p) => this.servo(p)],
      ["SC", "0.0.0", (p) => this.configure(p)],
      ["SE", "2.2.0", (p) => this.engraver(p)],
      ["EM", "0.0.0", (p) => this.enable(p)],
      ["ES", "2.2.7", (p) => this.stop(p)],
      ["CS", "2.4.3", () => this.core.clearSteps(true)],
      ["CU", "0.0.0", (p) => this.configureUser(p)],
      ["R", "0.0.0", () => ({ then: this.hooks.reset })],
      ["RB", "2.5.4", () => ({ isSilent: true, then: this.hooks.restart })],
      ["BL", "0.0.0", () => ({ isSilent: true, then: this.hooks.restart })],
      ["QM", "2.2.6", () => ({ values: () => this.queries.motorsText() })],
      ["QG", "2.6.2", () => ({ values: () => this.queries.generalText() })],
      ["QS", "2.4.3", () => ({ values: () => this.core.stepsNow().join(",") })],
      ["QP", "0.0.0", () => ({ values: () => (this.core.penUp ? "1" : "0") })],
      ["QB", "0.0.0", () => ({ values: () => this.queries.takeButton() })],
      ["QC", "2.2.3", () => ({ values: () => this.queries.currentText() })],
      ["QE", "2.8.0", () => ({ values: () => this.queries.microstepText() })],
      ["QR", "2.5.6", () => ({ values: () => (this.core.servoUsed ? "1" : "0") })],
      ["QN", "0.0.0", () => ({ values: () => this.queries.padded(this.inputs.nodeCount, 10) })],
      ["QL", "0.0.0", (p) => this.queryLayer(p)],
      ["QT", "2.5.4", () => ({ values: () => this.inputs.name })],
      ["QU", "3.0.0", (p) => this.queryUtility(p)],
      ["SR", "2.5.6", (p) => this.servoTimeout(p)],
      ["SL", "0.0.0", (p) => this.setLayer(p)],
      ["SN", "0.0.0", (p) => this.setNode(p.uint())],
      ["NI", "0.0.0", () => this.setNode(this.inputs.nodeCount + 1)],
      ["ND", "0.0.0", () => this.setNode(this.inputs.nodeCount - 1)],
      ["ST", "2.5.4", (p) => this.setName(p)],
      ["PI", "0.0.0", (p) => this.pinInput(p)],
      ["PO", "0.0.0", (p) => this.pinOutput(p)],
      ["PD", "0.0.0", (p) => this.pinOutput(p)],
    ];
    return new Map(table.filter(([, since]) => this.core.isFrom(since)).map(([name, , run]) => [name, run]));
  }

  // motors

  private home(p: Parameters): Action {
    const order = this.motion.home(p);
    return { whenIdle: () => order(this.core.steps1, this.core.steps2) };
  }

  private enable(p: Parameters): Action | void {
    const mode1 = p.uint(5);
    const mode2 = p.hasMore ? p.uint(5) : null;
    if (!this.core.features.enableIsQueued) this.core.enableMotors(mode1, mode2);
    else if (mode2 !== null) return { orders: [{ kind: "enable", mode1, mode2 }] };
    // Firmware 2.8 and newer ignores EM with one argument.
    else return { isSilent: !this.hasFutureSyntax, raw: "EM" };
  }

  private stop(p: Parameters): Action {
    const disable = p.optionalUint(0, 1);
    const { hit, waiting, left } = this.core.stop();
    if (disable === 1 && this.core.isFrom("2.8.0")) this.core.motors.switchOff();
    const flag = hit ? 1 : 0;
    const isShort = this.core.isFrom("3.0.0");
    return { values: () => (isShort ? `${flag}` : [flag, ...waiting, ...left].join(",")) };
  }

  // pen and outputs

  private pen(p: Parameters): Action | void {
    const value = p.uint(3);
    const { core } = this;
    if (value > 1) {
      if (!core.features.hasImmediateLift) throw invalidValue();
      if (value === 3) this.disableDrops();
      core.movePen(core.servoUp, core.servoRateUp, true);
      core.penUp = true;
      return;
    }
    const delayMs = p.optionalUint(0, MS16);
    if (p.hasMore) p.uint(24);
    return { orders: [this.penOrder(value === 1, delayMs)] };
  }

  private penOrder(up: boolean, delayMs: number): Order {
    const { core } = this;
    return {
      kind: "servo",
      position: up ? core.servoUp : core.servoDown,
      rate: up ? core.servoRateUp : core.servoRateDown,
      ticks: delayMs * TICKS_PER_MS,
      penUp: up,
      movesPen: ebbOf(core.machine).servoPin === STANDARD_PIN,
      isPen: true,
    };
  }

  /** SP,3: pen-down orders in the queue lift the pen instead, and the down height becomes the up height. */
  private disableDrops(): void {
    const { core } = this;
    core.servoDown = core.servoUp;
    core.fifo.forEach((order, i) => {
      if (order.kind === "servo" && order.isPen) core.fifo[i] = { ...order, position: core.servoUp };
    });
  }

  private togglePen(p: Parameters): Action {
    return { orders: [this.penOrder(!this.core.penUp, p.optionalUint(0, MS16))] };
  }

  private servo(p: Parameters): Action | void {
    const position = p.uint(MS16);
    const pin = p.uint(24);
    const rate = p.optionalUint(0, MS16);
    const delayMs = p.optionalUint(0, MS16);
    if (position === 0) return;
    // On the standard output, the board treats the pen as up only at exactly the height of SC,4.
    const penUp = pin === STANDARD_PIN ? position === this.core.servoUp : null;
    const movesPen = pin === ebbOf(this.core.machine).servoPin;
    const ticks = delayMs * TICKS_PER_MS;
    return { orders: [{ kind: "servo", position, rate, ticks, penUp, movesPen, isPen: false }] };
  }

  private configure(p: Parameters): void {
    const which = p.uint(255);
    const value = p.uint(MS16);
    const { core } = this;
    if (which === 4) core.servoUp = value;
    else if (which === 5) core.servoDown = value;
    else if (which === 8) core.servo.channels = Math.min(MAX_SERVO_CHANNELS, Math.max(1, value));
    else if (which === 9) core.servo.slotMs = Math.max(1, value);
    else if (which === 10) core.servoRateUp = core.servoRateDown = value;
    else if (which === 11) core.servoRateUp = value;
    else if (which === 12) core.servoRateDown = value;
    else if (which === 1 && value > 2) throw invalidValue();
  }

  private engraver(p: Parameters): Action | void {
    p.uint(1);
    p.optionalUint(0, 1_023);
    if (p.optionalUint(0, 1) === 1) return { orders: [{ kind: "delay", ticks: 1 }] };
  }

  private servoTimeout(p: Parameters): void {
    p.uint();
    if (p.hasMore) this.core.servoUsed = p.uint(1) === 1;
  }

  // settings

  private configureUser(p: Parameters): Action | void {
    const which = p.uint(255);
    const value = p.int();
    const { core } = this;
    if (which === 1) this.sendsOk = value !== 0;
    if (which === 50) core.motors.autoEnable = value !== 0;
    if (which === 60) this.inputs.powerThreshold = value;
    if (!core.features.hasFutureSyntax) return;
    if (which === 4) {
      const depth = Math.min(core.features.maxFifoDepth, value);
      return {
        whenIdle: () => {
          core.fifoDepth = depth;
          return [];
        },
      };
    }
    if (which === 10) {
      this.hasFutureSyntax = value !== 0;
      return { raw: this.hasFutureSyntax ? "\n" : "CUOK\r\n" };
    }
    if (which === 51) core.motors.watchLimit(value & 255);
    if (which === 52) core.motors.limitTarget = value & 255;
    if (which === 51 || which === 52) core.findLimit();
    if (which === 251) this.isTestMode = value !== 0;
  }

  private queryUtility(p: Parameters): Action {
    const which = p.uint(255);
    const { core } = this;
    const answers: Record<number, number> = {
      1: 0,
      2: core.features.maxFifoDepth,
      3: core.fifoDepth,
      6: core.fifo.length,
      60: this.inputs.powerThreshold,
    };
    const answer = answers[which];
    if (answer === undefined) throw invalidValue();
    const echoes = !this.core.isFrom("3.0.2");
    return { values: () => (echoes ? `${which},${answer}` : `${answer}`) };
  }

  private setLayer(p: Parameters): void {
    const value = p.uint(255);
    const index = p.optionalUint(0, 31);
    this.inputs.layer[index] = value;
  }

  private queryLayer(p: Parameters): Action {
    const index = p.optionalUint(0, 31);
    return { values: () => this.queries.padded(this.inputs.layer[index], 3) };
  }

  private setNode(value: number): void {
    this.inputs.nodeCount = value >>> 0;
  }

  private setName(p: Parameters): void {
    this.inputs.name = p.text(16);
  }

  private pinInput(p: Parameters): Action {
    const [port, pin] = p.text(8).split(",");
    const level = (): number | null =>
      port?.toUpperCase() === "B" ? this.core.motors.portB(Number(pin)) : null;
    // Every other input is the button.
    return { values: () => `${level() ?? (this.inputs.buttonDown ? 0 : 1)}` };
  }

  private pinOutput(p: Parameters): void {
    p.text(8);
  }
}

function unknownCommand(name: string): BoardFault {
  const hex = [...name].map((c) => c.charCodeAt(0).toString(16).toUpperCase().padStart(2, "0")).join("");
  return new BoardFault(8, `Err: Unknown command '${name}:${hex}'`);
}
