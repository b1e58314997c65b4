/**
 * A small simulated Grbl: a receive buffer of 128 characters, a queue of 15 moves, motion by the planner's model,
 * reports, real-time commands, soft limits and the lock of a machine that wants to be homed. It supports the commands
 * that this driver sends, and refuses others as Grbl does.
 */
import { PlotwrightError } from "../../../errors.js";
import type { DrawnPolyline } from "../../drawn-polylines.js";
import type { VirtualMachine, VirtualMachineOptions } from "../../driver.js";
import { asciiBytes } from "../../line-splitter.js";
import type { Transport } from "../../transport.js";
import { VirtualLink } from "../../virtual-link.js";
import { versionOf } from "../protocol.js";
import { AT_SWITCHES, Coordinates } from "./coordinates.js";
import { DollarLines } from "./dollar-lines.js";
import { GcodeLines } from "./gcode-lines.js";
import { ERROR, Modes } from "./gcode-words.js";
import { Holds } from "./holds.js";
import { GrblMotion } from "./motion.js";
import { RxBuffer } from "./rx-buffer.js";
import { States } from "./states.js";
import { Ink, VirtualPen } from "./virtual-pen.js";
import { Dwell } from "./dwell.js";
import {
  VirtualSettings,
  type LineFault,
  type VirtualGrblOptions,
  type VirtualGrblState,
} from "./virtual-settings.js";

/** How long Grbl waits for more lines before it starts with a queue that is not full. */
const START_S = 0.005;
/** How long it seeks its switches: longer than any other silence. */
const HOMING_S = 8;

export class VirtualGrbl implements VirtualMachine {
  readonly firmware: string;
  private readonly settings: VirtualSettings;
  private readonly motion: GrblMotion;
  private readonly pen: VirtualPen;
  private readonly startS: number;
  private link: VirtualLink | null = null;
  private readonly rx: RxBuffer;
  /** The line that another program has sent, and that waits for its turn; "": none. */
  private otherLine = "";
  private earlyCount = 0;
  private readonly modes = new Modes();
  private readonly states: States;
  private readonly coordinates: Coordinates;
  /** A grblHAL refuses all G-code after an error. */
  private refusal = 0;
  private readonly wait = new Dwell();
  private startDueS: number | null = null;
  private cancelTimer: () => void = () => undefined;
  private isClosed = false;
  private readonly dollar: DollarLines;
  private readonly gcode: GcodeLines;
  private readonly holds: Holds;
  private readonly ink = new Ink(
    () => this.isPenDown,
    () => this.onPage,
  );

  constructor(
    private readonly options: VirtualMachineOptions,
    board: VirtualGrblOptions = {},
  ) {
    const { clock, machine } = options;
    this.startS = clock.nowS();
    this.settings = new VirtualSettings(machine, options.firmware ?? "", board);
    this.firmware = versionOf(this.settings.face.greeting)!;
    this.pen = new VirtualPen(machine);
    this.coordinates = new Coordinates(machine);
    this.rx = new RxBuffer(this.settings.rxBytes);
    this.states = new States(this.settings.face.doorResuming);
    this.motion = new GrblMotion(
      this.settings.face.queueMoves,
      () => this.settings.limits,
      (at) => this.coordinates.onSteps(at),
      () => this.ink.arrived(),
    );
    this.states.isLocked = this.settings.hasHoming;
    const { settings, modes, motion, coordinates, states } = this;
    const parts = { settings, modes, motion, coordinates };
    this.dollar = new DollarLines({
      ...parts,
      states,
      reply: (line) => this.reply(line),
      seekSwitches: () => {
        this.seek(() => this.answer("ok"));
        this.rx.dropLine();
      },
      begin: () => this.begin(),
    });
    this.holds = new Holds({
      ...{ settings, states, motion, modes, pen: this.pen, wait: this.wait },
      nowS: () => this.nowS,
      reply: (line) => this.reply(line),
      cancelStart: () => {
        this.startDueS = null;
      },
      failHoming: (alarm) => this.failHoming(alarm),
    });
    this.gcode = new GcodeLines({
      ...parts,
      isChecking: () => states.isChecking,
      signalChanged: () => this.pen.signal(modes.signal, this.nowS),
      wait: (seconds, then) => this.answerAfter(seconds, then),
      waitForUser: () => {
        this.answerAfter(0, () => undefined);
        this.holds.hold();
      },
      offsetChanged: () => {
        settings.offsetDue = 0;
        this.ink.begin(false);
      },
      softLimit: () => this.alarm(2),
    });
    this.ink.begin(false);
  }

  transport(): Transport {
    this.link?.drop();
    this.link = new VirtualLink(Infinity, {
      accepting: () => true,
      nowTick: () => 0,
      // Not at once: a reply must not arrive during the write.
      take: (bytes) => void Promise.resolve().then(() => this.take(bytes)),
    });
    return this.link;
  }

  close(): void {
    this.isClosed = true;
    this.cancelTimer();
    this.link?.drop();
  }

  /** As if its reset button was pressed: it counts from its current position as 0, and says that it has started. */
  restart(): void {
    this.catchUp();
    this.motion.stop();
    this.coordinates.restarted(this.motion.at);
    this.motion.jumpTo([0, 0, 0]);
    this.ink.begin(this.isPenDown);
    this.states.isLocked = this.settings.hasHoming;
    this.begin();
    this.schedule();
  }

  /** As if the carriage was pushed by hand back to where it stood at the first start, which the Grbl does not notice. */
  pushHome(): void {
    this.catchUp();
    this.coordinates.pushedHome(this.motion.at);
    this.ink.begin(false);
  }

  /** As if its Z axis was turned by hand. */
  pushPen(zMm: number): void {
    this.catchUp();
    this.coordinates.pushedPen(this.motion.at, zMm);
    this.ink.begin(this.isPenDown);
  }

  /** An alarm, such as 1 for a limit switch: it stops, and answers nothing until it is reset. */
  stopWith(alarm: number): void {
    this.catchUp();
    this.alarm(alarm);
    this.schedule();
  }

  /** Its emergency stop, which some of Grbl's children have, is pressed or released. */
  setStop(isPressed: boolean): void {
    this.states.isStopPressed = isPressed;
    if (isPressed) this.stopWith(10);
  }

  /** As if its hold button was pressed. */
  pressHold(): void {
    this.catchUp();
    this.holds.hold();
    this.schedule();
  }

  /** The switch of its door opens or closes. */
  setDoor(isOpen: boolean): void {
    this.catchUp();
    this.states.door.isOpen = isOpen;
    if (isOpen) this.holds.stopForDoor();
    this.schedule();
  }

  /**
   * As if another program, connected to it as well, had sent this: a real-time character, or one line, which waits until
   * the machine is idle. The answer is for that program.
   */
  takeFromOther(text: string): void {
    this.catchUp();
    if (!this.takesAtOnce(text)) this.otherLine = text;
    this.work();
  }

  /** The cable is unplugged; it has a supply of its own, and goes on. */
  unplug(): void {
    this.link?.drop(new PlotwrightError("disconnected", "The virtual Grbl was unplugged: plug it in again."));
  }

  /** From now on, the next `count` replies or lines suffer this fault. */
  spoil(fault: LineFault, count = 1): void {
    this.settings.spoil(fault, count);
  }

  /** As if this line came from the board. */
  say(line: string): void {
    this.reply(line);
  }

  state(): VirtualGrblState {
    this.catchUp();
    const { x: xMm, y: yMm, zMm } = this.onPage;
    const pen = { zMm, penUp: !this.isPenDown, offsetMm: this.coordinates.offset };
    const { starvedCount, movingS } = this.motion;
    const counts = { earlyCount: this.earlyCount, starvedCount, movingS, lostCount: this.rx.lostCount };
    return { state: this.states.name(this.motion), xMm, yMm, ...pen, ...counts };
  }

  drawn(): DrawnPolyline[] {
    this.catchUp();
    return this.ink.lines.list();
  }

  private get nowS(): number {
    return (this.options.clock.nowS() - this.startS) * this.options.speed;
  }

  private take(bytes: Uint8Array): void {
    this.catchUp();
    for (const byte of bytes) {
      const character = String.fromCharCode(byte);
      if (this.takesAtOnce(character)) continue;
      if (character === "\n" && this.settings.takes("line-end-lost")) continue;
      this.rx.push(character);
    }
    this.work();
  }

  /** Whether it is a real-time command; those beyond ASCII that it does not know are dropped. */
  private takesAtOnce(character: string): boolean {
    if (character === "?") this.report();
    else if (character === "!") this.holds.hold();
    else if (character === "~") this.holds.resume();
    else if (character === "\x18") this.reset();
    else if (character === "\x84") this.holds.stopForDoor();
    else return character >= "\x80";
    return true;
  }

  /** Reads lines while it can, and sets a timer for the next event. */
  private work(): void {
    while (this.states.readsLines && !this.wait.isRunning) {
      this.performOther();
      const received = this.wait.isRunning || this.states.isAsleep ? null : this.rx.line;
      if (received === null) break;
      const { ownVersion, comments } = this.settings.face;
      const line = received.replace(comments, "").replace(/\s/g, "");
      if (line.toUpperCase() === "V" && ownVersion !== null) {
        this.rx.dropLine();
        this.reply(ownVersion);
        continue;
      }
      const answer = this.perform(line.toUpperCase());
      if (answer === null) break;
      if (answer === 0) this.pen.executed(line.toUpperCase(), this.nowS);
      this.rx.dropLine();
      this.answer(answer === 0 ? "ok" : this.settings.face.error(answer));
    }
    if (!this.motion.isEmpty && !this.motion.isMoving && !this.states.isHeld) {
      this.startDueS ??= this.nowS + START_S;
      const waitsForMotion = /^(G4|M[0345])/.test(this.rx.line ?? "");
      if (this.motion.isFull || waitsForMotion) this.startDueS = this.nowS;
    }
    this.schedule();
  }

  private schedule(): void {
    this.cancelTimer();
    if (this.isClosed) return;
    const waitS = Math.min(this.wait.nextS, this.states.door.nextS);
    const dueS = Math.min(this.motion.nextS, waitS, this.startDueS ?? Infinity);
    if (dueS === Infinity) return;
    const delayS = Math.max(0, dueS - this.nowS) / this.options.speed;
    this.cancelTimer = this.options.clock.after(delayS, () => {
      this.catchUp(dueS);
      this.work();
    });
  }

  /**
   * Advances motion and waits to the current time, but at least to `minS`: a timer may fire slightly early.
   */
  private catchUp(minS = 0): void {
    const toS = Math.max(this.nowS, minS);
    if (this.startDueS !== null && this.startDueS <= toS) {
      if (this.pen.isMoving(this.startDueS)) this.earlyCount++;
      if (!this.pen.isOnZ) this.ink.see();
      this.motion.go(this.startDueS);
      this.startDueS = null;
    }
    this.motion.advance(toS);
    if (!this.motion.isMoving) this.holds.rested();
    if (this.states.door.hasResumed(toS)) this.holds.goOn(toS);
    const ended = this.wait.takeEnded(toS);
    if (ended) {
      this.ink.see();
      ended();
    }
  }

  private performOther(): void {
    const line = this.otherLine;
    if (line === "" || !this.motion.isEmpty) return;
    this.otherLine = "";
    if (line === "$H") this.seek(() => undefined);
    else this.dollar.perform(line);
  }

  /** Returns 0 if the line is done or queued, an error code if it is refused, null if it has to wait. */
  private perform(line: string): number | null {
    if (line === "" || line.startsWith("$")) this.refusal = 0;
    if (line === "") return 0;
    if (this.refusal !== 0) return this.refusal;
    const answer = this.settings.takes("refused") ? this.settings.refusal : this.performLine(line);
    if (answer !== null && this.settings.face.refusesOn) this.refusal = answer;
    return answer;
  }

  private performLine(line: string): number | null {
    if (line.startsWith("$")) return this.dollar.perform(line);
    if (this.states.isLocked || this.states.isJogging) return ERROR.locked;
    return this.gcode.perform(line);
  }

  /** It stands at the switches then, where the carriage stood at the first start, and the pen is up. */
  private seek(then: () => void): void {
    this.states.isHoming = true;
    this.wait.start(this.nowS + HOMING_S, () => {
      this.states.isHoming = this.states.isLocked = false;
      this.motion.jumpTo(AT_SWITCHES);
      this.coordinates.foundSwitches();
      this.ink.begin(false);
      then();
    });
  }

  /** The line is answered when the wait ends, so it is removed from the buffer here. */
  private answerAfter(seconds: number, then: () => void): void {
    this.wait.start(this.nowS + seconds, () => {
      then();
      this.answer("ok");
    });
    this.rx.dropLine();
  }

  private reset(): void {
    if (this.motion.isMoving) {
      this.reply(this.settings.face.alarm(3));
      this.states.isLocked = true;
    }
    if (this.states.isHoming) return this.failHoming(6);
    // The motors were off, so the carriage may have been pushed.
    if (this.states.isAsleep) this.states.isLocked = true;
    this.begin();
  }

  private failHoming(alarm: number): void {
    this.reply(this.settings.face.alarm(alarm));
    this.states.isLocked = true;
    this.begin();
  }

  /** It stops, and answers nothing until it is reset. */
  private alarm(code: number): void {
    this.motion.stop();
    this.wait.cancel();
    this.startDueS = null;
    this.states.isLocked = this.states.isDeaf = true;
    this.reply(this.settings.face.alarm(code));
    this.reply(this.settings.face.message("Reset to continue"));
  }

  private begin(): void {
    this.motion.stop();
    this.gcode.forget();
    this.rx.clear();
    this.refusal = 0;
    this.states.begin();
    this.wait.cancel();
    this.startDueS = null;
    this.modes.reset();
    this.settings.offsetDue = 0;
    this.reply(this.settings.face.greeting);
    if (this.states.isLocked) this.reply(this.settings.face.message("'$H'|'$X' to unlock"));
    else if (this.states.door.isOpen) this.holds.stopForDoor();
  }

  private report(): void {
    if (this.states.isDeaf || (this.states.isHoming && !this.settings.face.reportsHoming)) return;
    const { motion } = this;
    const { offset } = this.coordinates;
    const free = `${motion.freeCount},${this.rx.freeCount}`;
    this.reply(
      this.settings.report(this.states.name(this.motion), motion.at, offset, free, motion.speedMmPerS),
    );
  }

  /** The reply to a line. */
  private answer(text: string): void {
    for (const line of this.settings.answersFor(text)) this.reply(line);
  }

  private reply(line: string): void {
    this.link?.deliver(asciiBytes(`${line}\r\n`));
  }

  private get isPenDown(): boolean {
    return this.pen.isDown(this.onPage.zMm, this.nowS);
  }

  private get onPage(): { x: number; y: number; zMm: number } {
    return this.coordinates.onPage(this.motion.at);
  }
}
