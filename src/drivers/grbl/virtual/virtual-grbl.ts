/**
 * A small simulated Grbl: a receive buffer of 128 characters, a queue of 15 moves, motion by the planner's model,
 * reports, and real-time commands. It supports the commands that this driver sends, and refuses others as Grbl does.
 */
import { placeFromMotors } from "../../../machines/motors.js";
import { DrawnPolylines, type DrawnPolyline } from "../../drawn-polylines.js";
import type { VirtualMachine, VirtualMachineOptions } from "../../driver.js";
import { asciiBytes } from "../../line-splitter.js";
import type { Transport } from "../../transport.js";
import { axisLimits, dwellS, grblOf } from "../model/grbl-controller.js";
import { difference, QUEUE_MOVES, type Axes } from "../model/planner.js";
import { RX_BYTES } from "../protocol.js";
import { VirtualLink } from "../../virtual-link.js";
import { GrblMotion } from "./motion.js";

const VERSION = "1.1h";
/** How long Grbl waits for more lines before it starts with a queue that is not full. */
const START_S = 0.005;
const WORDS = /([A-Z])([-+]?\d*\.?\d+)/g;
const ERROR = { number: 2, dollar: 3, locked: 9, unknown: 20, noFeed: 22, unused: 36 } as const;
/** Modes that are always on. */
const FIXED_MODES = new Set(["G0", "G1", "G21", "G54", "G90", "G94"]);

interface VirtualGrblState {
  readonly state: string;
  readonly xMm: number;
  readonly yMm: number;
  readonly zMm: number;
  readonly penUp: boolean;
  /** Characters that arrived when the buffer was full: a real Grbl loses them silently. */
  readonly lostCount: number;
}

export class VirtualGrbl implements VirtualMachine {
  private readonly motion: GrblMotion;
  private readonly startS: number;
  private link: VirtualLink | null = null;
  private received = "";
  private lostCount = 0;
  private isLocked = false;
  private isAsleep = false;
  private isHeld = false;
  /** After some alarms it answers nothing until it is reset. */
  private isDeaf = false;
  private feed = 0;
  private isRapid = true;
  /** Origin of the work coordinates, mm. */
  private offset: Axes = [0, 0, 0];
  private isOffsetReported = false;
  /** Machine seconds at which the running G4 ends; null: none is running. */
  private waitUntilS: number | null = null;
  private startDueS: number | null = null;
  private cancelTimer: () => void = () => undefined;
  private isClosed = false;
  private readonly lines = new DrawnPolylines();
  private isDrawing = false;

  constructor(private readonly options: VirtualMachineOptions) {
    const { clock, machine } = options;
    this.startS = clock.nowS();
    this.motion = new GrblMotion(axisLimits(grblOf(machine)), () => this.record());
    this.newLine(false);
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
    this.motion.zero();
    this.newLine(this.isDown(this.workAt()[2]));
    this.isLocked = false;
    this.begin();
    this.schedule();
  }

  /** As if it has hit a limit switch: it stops, and answers nothing until it is reset. */
  hitSwitch(): void {
    this.catchUp();
    this.motion.stop();
    this.waitUntilS = this.startDueS = null;
    this.isLocked = this.isDeaf = true;
    this.reply("ALARM:1");
    this.reply("[MSG:Reset to continue]");
    this.schedule();
  }

  state(): VirtualGrblState {
    this.catchUp();
    const [x, y, z] = this.workAt();
    const { x: xMm, y: yMm } = this.onPage(x, y);
    return { state: this.stateName(), xMm, yMm, zMm: z, penUp: !this.isDown(z), lostCount: this.lostCount };
  }

  drawn(): DrawnPolyline[] {
    this.catchUp();
    return this.lines.list();
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
      else if (this.received.length < RX_BYTES) this.received += character;
      else this.lostCount++;
    }
    this.work();
  }

  /** Reads lines while it can, and sets a timer for the next event. */
  private work(): void {
    while (!this.isHeld && !this.isAsleep && !this.isDeaf && this.waitUntilS === null) {
      const end = this.received.indexOf("\n");
      if (end < 0) break;
      const line = this.received.slice(0, end).replace(/\s|\(.*?\)|;.*/g, "");
      const answer = this.perform(line.toUpperCase());
      if (answer === null) break;
      this.received = this.received.slice(end + 1);
      this.reply(answer === 0 ? "ok" : `error:${answer}`);
    }
    if (!this.motion.isEmpty && !this.motion.isMoving && !this.isHeld) {
      this.startDueS ??= this.nowS + START_S;
      const waitsForMotion = this.received.startsWith("G4");
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
      this.motion.go(this.startDueS);
      this.startDueS = null;
    }
    this.motion.advance(toS);
    if (this.waitUntilS !== null && this.waitUntilS <= toS) {
      this.waitUntilS = null;
      this.reply("ok");
    }
  }

  /** Returns 0 if the line is done or queued, an error code if it is refused, null if it has to wait. */
  private perform(line: string): number | null {
    if (line === "") return 0;
    if (line.startsWith("$")) return this.system(line);
    if (this.isLocked) return ERROR.locked;
    if (line.replace(WORDS, "") !== "") return ERROR.number;
    const words = new Map<string, number>();
    const modes: string[] = [];
    for (const [, letter, value] of line.matchAll(WORDS)) {
      if (letter === "G" || letter === "M") modes.push(`${letter}${Number(value)}`);
      else words.set(letter, Number(value));
    }
    if (modes.includes("G4")) return this.dwell(words.get("P"));
    if (modes.includes("G10")) return this.setOffset(words);
    if (modes.some((mode) => !FIXED_MODES.has(mode))) return ERROR.unknown;
    return this.move(modes, words);
  }

  private system(line: string): number {
    if (line === "$I") {
      this.reply(`[VER:${VERSION}.20190830:]`);
      this.reply(`[OPT:V,${QUEUE_MOVES},${RX_BYTES}]`);
    } else if (line === "$X") this.isLocked = false;
    else if (line === "$SLP") this.isAsleep = true;
    else return ERROR.dollar;
    return 0;
  }

  /** G4 is answered when its wait ends, so the line is removed from the buffer here. */
  private dwell(seconds: number | undefined): number | null {
    if (seconds === undefined) return 28;
    if (!this.motion.isEmpty) return null;
    if (seconds <= 0) return 0;
    this.waitUntilS = this.nowS + dwellS(seconds);
    this.received = this.received.slice(this.received.indexOf("\n") + 1);
    return null;
  }

  private setOffset(words: ReadonlyMap<string, number>): number | null {
    if (words.get("L") !== 20 || words.get("P") !== 1) return ERROR.unknown;
    if (!this.motion.isEmpty) return null;
    const at = this.motion.at;
    const set = (i: 0 | 1 | 2, letter: string): number =>
      words.has(letter) ? at[i] - (words.get(letter) ?? 0) : this.offset[i];
    this.offset = [set(0, "X"), set(1, "Y"), set(2, "Z")];
    this.isOffsetReported = false;
    this.newLine(false);
    return 0;
  }

  private move(modes: readonly string[], words: ReadonlyMap<string, number>): number | null {
    const isMove = words.has("X") || words.has("Y") || words.has("Z");
    if (isMove && this.motion.isFull) return null;
    if (modes.includes("G0")) this.isRapid = true;
    if (modes.includes("G1")) this.isRapid = false;
    const feed = words.get("F") ?? this.feed;
    if (isMove && !this.isRapid && feed === 0) return ERROR.noFeed;
    this.feed = feed;
    if (!isMove) return words.size > (words.has("F") ? 1 : 0) ? ERROR.unused : 0;
    const { end } = this.motion;
    const to: Axes = [
      this.target(words.get("X"), 0, end),
      this.target(words.get("Y"), 1, end),
      this.target(words.get("Z"), 2, end),
    ];
    if (to.every((value, i) => value === end[i])) return 0;
    this.motion.queue(to, this.isRapid ? Infinity : feed / 60);
    return 0;
  }

  /** X and Y are rounded to whole steps. */
  private target(word: number | undefined, axis: 0 | 1 | 2, end: Axes): number {
    if (word === undefined) return end[axis];
    const mm = word + this.offset[axis];
    const { stepsPerMm } = this.options.machine;
    return axis === 2 ? mm : Math.round(mm * stepsPerMm) / stepsPerMm;
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
      this.reply("ALARM:3");
      this.isLocked = true;
    }
    this.begin();
  }

  private begin(): void {
    this.motion.stop();
    this.received = "";
    this.isHeld = this.isAsleep = this.isDeaf = false;
    this.waitUntilS = this.startDueS = null;
    this.feed = 0;
    this.isRapid = true;
    this.isOffsetReported = false;
    this.reply(`Grbl ${VERSION} ['$' for help]`);
    if (this.isLocked) this.reply("[MSG:'$H'|'$X' to unlock]");
  }

  private report(): void {
    if (this.isDeaf) return;
    const mm = (at: Axes): string => at.map((value) => value.toFixed(3)).join(",");
    const offset = this.isOffsetReported ? "" : `|WCO:${mm(this.offset)}`;
    this.isOffsetReported = true;
    const free = `${this.motion.freeCount},${RX_BYTES - this.received.length}`;
    const feed = Math.round(60 * this.motion.speedMmPerS);
    this.reply(`<${this.stateName()}|MPos:${mm(this.motion.at)}|Bf:${free}|FS:${feed},0${offset}>`);
  }

  private stateName(): string {
    if (this.isAsleep) return "Sleep";
    if (this.isLocked) return "Alarm";
    if (this.isHeld) return this.motion.isMoving ? "Hold:1" : "Hold:0";
    return this.motion.isEmpty ? "Idle" : "Run";
  }

  private reply(line: string): void {
    this.link?.deliver(asciiBytes(`${line}\r\n`));
  }

  private workAt(): Axes {
    return difference(this.motion.at, this.offset);
  }

  private isDown(z: number): boolean {
    const { penUpZMm, penDownZMm } = grblOf(this.options.machine);
    return Math.abs(z - penDownZMm) < Math.abs(z - penUpZMm);
  }

  private onPage(x: number, y: number): { x: number; y: number } {
    const { stepsPerMm } = this.options.machine;
    return placeFromMotors(this.options.machine, x * stepsPerMm, y * stepsPerMm);
  }

  private record(): void {
    const penDown = this.isDown(this.workAt()[2]);
    if (this.isDrawing !== penDown) this.newLine(penDown);
    else this.addPoint();
  }

  private newLine(penDown: boolean): void {
    this.isDrawing = penDown;
    this.lines.begin(penDown);
    this.addPoint();
  }

  private addPoint(): void {
    const [x, y] = this.workAt();
    const page = this.onPage(x, y);
    this.lines.add(page.x, page.y);
  }
}
