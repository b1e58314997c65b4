/**
 * A small simulated Grbl: a receive buffer of 128 characters, a queue of 15 moves, motion by the planner's model,
 * reports, real-time commands, soft limits and the lock of a machine that wants to be homed. It supports the commands
 * that this driver sends, and refuses others as Grbl does.
 */
import { PlotwrightError } from "../../../errors.js";
import { positionFromMotors } from "../../../machines/motors.js";
import type { DrawnPolyline } from "../../drawn-polylines.js";
import type { VirtualMachine, VirtualMachineOptions } from "../../driver.js";
import { asciiBytes } from "../../line-splitter.js";
import type { Transport } from "../../transport.js";
import { dwellS } from "../model/grbl-controller.js";
import { sum, type Axes } from "../model/planner.js";
import { VirtualLink } from "../../virtual-link.js";
import { versionOf } from "../protocol.js";
import { ERROR, Modes, wordsOf } from "./gcode-words.js";
import { GrblMotion } from "./motion.js";
import { RxBuffer } from "./rx-buffer.js";
import { Ink, VirtualPen } from "./virtual-pen.js";
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
const PULL_OFF_MM = 1;

export class VirtualGrbl implements VirtualMachine {
  readonly firmware: string;
  private readonly settings: VirtualSettings;
  private readonly motion: GrblMotion;
  private readonly pen: VirtualPen;
  private readonly startS: number;
  private link: VirtualLink | null = null;
  private readonly rx: RxBuffer;
  private earlyCount = 0;
  private readonly modes = new Modes();
  private isLocked = false;
  private isAsleep = false;
  private isHoming = false;
  private isHeld = false;
  /** After some alarms it answers nothing until it is reset. */
  private isDeaf = false;
  /** Origin of the work coordinates, mm. */
  private offset: Axes = [0, 0, 0];
  /** Where the machine coordinates begin since the last start, mm from where they began at the first. */
  private origin: Axes = [0, 0, 0];
  /** A grblHAL refuses all G-code after an error. */
  private refusal = 0;
  /** Machine seconds at which the running G4 ends; null: none is running. */
  private waitUntilS: number | null = null;
  private afterWait: () => void = () => undefined;
  private startDueS: number | null = null;
  private cancelTimer: () => void = () => undefined;
  private isClosed = false;
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
    this.rx = new RxBuffer(this.settings.rxBytes);
    this.motion = new GrblMotion(
      this.settings.face.queueMoves,
      () => this.settings.limits,
      (at) => this.onSteps(at),
      () => this.ink.arrived(),
    );
    this.isLocked = this.settings.hasHoming;
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
    this.origin = sum(this.origin, this.motion.at);
    this.motion.jumpTo([0, 0, 0]);
    this.ink.begin(this.isPenDown);
    this.isLocked = this.settings.hasHoming;
    this.begin();
    this.schedule();
  }

  /** As if the carriage was pushed by hand back to where it stood at the first start, which the Grbl does not notice. */
  pushHome(): void {
    this.catchUp();
    const [x, y] = this.motion.at;
    this.origin = [-x, -y, this.origin[2]];
    this.ink.begin(false);
  }

  /** An alarm, such as 1 for a limit switch: it stops, and answers nothing until it is reset. */
  stopWith(alarm: number): void {
    this.catchUp();
    this.alarm(alarm);
    this.schedule();
  }

  /** As if its hold button was pressed. */
  pressHold(): void {
    this.catchUp();
    this.hold();
    this.schedule();
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
    const { x: xMm, y: yMm } = this.onPage;
    const pen = { zMm: this.zMm, penUp: !this.isPenDown, offsetMm: this.offset };
    const { starvedCount, movingS } = this.motion;
    const counts = { earlyCount: this.earlyCount, starvedCount, movingS, lostCount: this.rx.lostCount };
    return { state: this.stateName(), xMm, yMm, ...pen, ...counts };
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
      if (character === "?") this.report();
      else if (character === "!") this.hold();
      else if (character === "~") this.resume();
      else if (character === "\x18") this.reset();
      else if (character === "\n" && this.settings.takes("line-end-lost")) continue;
      else this.rx.push(character);
    }
    this.work();
  }

  /** Reads lines while it can, and sets a timer for the next event. */
  private work(): void {
    while (!this.isHeld && !this.isAsleep && !this.isDeaf && this.waitUntilS === null) {
      const received = this.rx.line;
      if (received === null) break;
      const line = received.replace(/\s|\(.*?\)|;.*/g, "");
      const answer = this.perform(line.toUpperCase());
      if (answer === null) break;
      if (answer === 0) this.pen.executed(line.toUpperCase(), this.nowS);
      this.rx.dropLine();
      this.answer(answer === 0 ? "ok" : this.settings.face.error(answer));
    }
    if (!this.motion.isEmpty && !this.motion.isMoving && !this.isHeld) {
      this.startDueS ??= this.nowS + START_S;
      const waitsForMotion = /^(G4|M[345])/.test(this.rx.line ?? "");
      if (this.motion.isFull || waitsForMotion) this.startDueS = this.nowS;
    }
    this.schedule();
  }

  private schedule(): void {
    this.cancelTimer();
    if (this.isClosed) return;
    const dueS = Math.min(this.motion.nextS, this.waitUntilS ?? Infinity, this.startDueS ?? Infinity);
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
    if (this.waitUntilS !== null && this.waitUntilS <= toS) {
      this.waitUntilS = null;
      this.ink.see();
      this.afterWait();
      this.answer("ok");
    }
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
    if (line.startsWith("$")) return this.system(line);
    if (this.isLocked) return ERROR.locked;
    const block = wordsOf(line);
    if (typeof block === "number") return block;
    const { modes, words } = block;
    this.modes.takeTool(words);
    const isChange = this.modes.takeSpindle(block, this.motion.isEmpty);
    if (isChange === null) return null;
    if (isChange) {
      this.motion.mayRest();
      this.pen.signal(this.modes.signal, this.nowS);
    }
    if (modes.includes("G4")) return this.dwell(modes, words);
    if (modes.includes("G10")) return this.setOffset(words);
    return this.move(modes, words);
  }

  private system(line: string): number | null {
    const isAtRest = this.motion.isEmpty || this.isLocked;
    const [, number, value] = /^\$(\d+)=(-?[\d.]+)$/.exec(line) ?? [];
    const { face } = this.settings;
    if (line === "$G") this.reply(face.modes(this.modes.words));
    else if (line === "$")
      this.reply("[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]");
    else if (line === "$X") {
      if (this.isLocked) this.reply("[MSG:Caution: Unlocked]");
      this.isLocked = false;
    } else if (line === "$H") return this.seekSwitches();
    else if (line !== "$I" && line !== "$$" && line !== "$SLP" && number === undefined) {
      return ERROR.dollar;
    } else if (!isAtRest) return ERROR.busy;
    else if (line === "$I") {
      for (const info of face.info) this.reply(info);
    } else if (line === "$$") for (const setting of this.settings.list()) this.reply(setting);
    else if (line === "$SLP") this.isAsleep = true;
    else {
      this.settings.offsetDue = 0;
      return this.settings.set(Number(number), Number(value)) ? 0 : ERROR.dollar;
    }
    return 0;
  }

  /** It stands at the switches then, where the carriage stood at the first start, and the pen is up. */
  private seekSwitches(): number | null {
    if (!this.settings.hasHoming) return ERROR.noHoming;
    this.isHoming = true;
    this.wait(HOMING_S, () => {
      this.isHoming = this.isLocked = false;
      this.motion.jumpTo([-PULL_OFF_MM, -PULL_OFF_MM, -PULL_OFF_MM]);
      this.origin = [PULL_OFF_MM, PULL_OFF_MM, 0];
      this.ink.begin(false);
    });
    return null;
  }

  /** The line is answered when the wait ends, so it is removed from the buffer here. */
  private wait(seconds: number, then: () => void): void {
    this.waitUntilS = this.nowS + seconds;
    this.afterWait = then;
    this.rx.dropLine();
  }

  /**
   * A move in the same line, whose line end was lost, comes after the wait.
   */
  private dwell(modes: readonly string[], words: ReadonlyMap<string, number>): number | null {
    const seconds = words.get("P");
    if (seconds === undefined) return ERROR.noWait;
    if (!this.motion.isEmpty) return null;
    this.motion.mayRest();
    const rest = new Map(words);
    rest.delete("P");
    if (seconds <= 0) return this.move(modes, rest);
    this.wait(dwellS(seconds), () => this.move(modes, rest));
    return null;
  }

  private setOffset(words: ReadonlyMap<string, number>): number | null {
    if (words.get("L") !== 20 || words.get("P") !== 1) return ERROR.unknown;
    if (!this.motion.isEmpty) return null;
    const at = this.motion.at;
    const set = (i: 0 | 1 | 2, letter: string): number =>
      words.has(letter) ? at[i] - (words.get(letter) ?? 0) : this.offset[i];
    this.offset = [set(0, "X"), set(1, "Y"), set(2, "Z")];
    this.settings.offsetDue = 0;
    this.ink.begin(false);
    return 0;
  }

  private move(modes: readonly string[], words: ReadonlyMap<string, number>): number | null {
    const isMove = words.has("X") || words.has("Y") || words.has("Z");
    if (isMove && this.motion.isFull) return null;
    if (!this.modes.takeMotion(modes, words, isMove)) return ERROR.noFeed;
    const { isRapid, feed } = this.modes;
    if (!isMove) return words.size > (words.has("F") ? 1 : 0) ? ERROR.unused : 0;
    const { end } = this.motion;
    const target = (letter: string, axis: 0 | 1 | 2): number => {
      const word = words.get(letter);
      return word === undefined ? end[axis] : word + this.offset[axis];
    };
    const to = this.onSteps([target("X", 0), target("Y", 1), target("Z", 2)]);
    if (this.settings.isBeyond(to)) {
      // It comes to rest first; here at once.
      this.alarm(2);
      return null;
    }
    if (to.every((value, i) => value === end[i])) return 0;
    this.motion.queue(to, isRapid ? Infinity : feed / 60);
    return 0;
  }

  /** X and Y are rounded to whole steps. */
  private onSteps([x, y, z]: Axes): Axes {
    const { stepsPerMm } = this.options.machine;
    return [Math.round(x * stepsPerMm) / stepsPerMm, Math.round(y * stepsPerMm) / stepsPerMm, z];
  }

  private hold(): void {
    if (this.isLocked || this.isAsleep) return;
    this.isHeld = true;
    this.startDueS = null;
    if (this.motion.isMoving) this.motion.hold();
  }

  private resume(): void {
    if (!this.isHeld || this.motion.isMoving) return;
    this.isHeld = false;
    if (!this.motion.isEmpty) this.motion.go(this.nowS);
  }

  private reset(): void {
    if (this.motion.isMoving) {
      this.reply(this.settings.face.alarm(3));
      this.isLocked = true;
    }
    if (this.isHoming) {
      this.reply(this.settings.face.alarm(6));
      this.isLocked = true;
    }
    // The motors were off, so the carriage may have been pushed.
    if (this.isAsleep) this.isLocked = true;
    this.begin();
  }

  /** It stops, and answers nothing until it is reset. */
  private alarm(code: number): void {
    this.motion.stop();
    this.waitUntilS = this.startDueS = null;
    this.isLocked = this.isDeaf = true;
    this.reply(this.settings.face.alarm(code));
    this.reply("[MSG:Reset to continue]");
  }

  private begin(): void {
    this.motion.stop();
    this.rx.clear();
    this.refusal = 0;
    this.isHeld = this.isAsleep = this.isDeaf = this.isHoming = false;
    this.waitUntilS = this.startDueS = null;
    this.modes.reset();
    this.settings.offsetDue = 0;
    this.reply(this.settings.face.greeting);
    if (this.isLocked) this.reply("[MSG:'$H'|'$X' to unlock]");
  }

  private report(): void {
    if (this.isDeaf || this.isHoming) return;
    const { motion } = this;
    const free = `${motion.freeCount},${this.rx.freeCount}`;
    this.reply(this.settings.report(this.stateName(), motion.at, this.offset, free, motion.speedMmPerS));
  }

  private stateName(): string {
    if (this.isAsleep) return "Sleep";
    if (this.isLocked) return "Alarm";
    if (this.isHeld) return this.motion.isMoving ? "Hold:1" : "Hold:0";
    return this.motion.isEmpty ? "Idle" : "Run";
  }

  /** The reply to a line. */
  private answer(text: string): void {
    for (const line of this.settings.answersFor(text)) this.reply(line);
  }

  private reply(line: string): void {
    this.link?.deliver(asciiBytes(`${line}\r\n`));
  }

  private get zMm(): number {
    return this.origin[2] + this.motion.at[2];
  }

  private get isPenDown(): boolean {
    return this.pen.isDown(this.zMm, this.nowS);
  }

  private get onPage(): { x: number; y: number } {
    const { machine } = this.options;
    const [x, y] = sum(this.origin, this.motion.at);
    return positionFromMotors(machine, x * machine.stepsPerMm, y * machine.stepsPerMm);
  }
}
