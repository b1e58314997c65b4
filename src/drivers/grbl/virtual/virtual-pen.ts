/** The pen of the virtual Grbl: on its Z axis, on a servo that needs time for its way, or moved by own lines. */
import { servoTime } from "../../../machines/pen-servo.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { PEN_TABLE } from "../../../settings/pen.js";
import { DrawnPolylines } from "../../drawn-polylines.js";
import { grblOf } from "../model/grbl-controller.js";
import { penLiftOf, type PenLift } from "../model/pen-lift.js";

/** Below this height the tip is on the paper. */
const CONTACT_PCT = (PEN_TABLE.upPct.default + PEN_TABLE.downPct.default) / 2;

export class VirtualPen {
  private readonly lift: PenLift;
  private readonly downLines: readonly string[];
  private readonly upLines: readonly string[];
  /** A servo's way: from a height to another one. */
  private fromPct: number = PEN_TABLE.upPct.default;
  private toPct = this.fromPct;
  private startS = 0;
  private endS = 0;

  constructor(machine: MachineProfile) {
    this.lift = penLiftOf(machine);
    const { penUpLines, penDownLines } = grblOf(machine);
    this.upLines = read(penUpLines);
    this.downLines = read(penDownLines);
  }

  /** Whether the tip is on the paper. `zMm`: real height of the Z axis. */
  isDown(zMm: number, nowS: number): boolean {
    return (this.lift.kind === "z" ? this.lift.pctOf(zMm) : this.pctAt(nowS)) < CONTACT_PCT;
  }

  /** A Z axis moves it; it counts as up until that has moved for the first time. */
  get isOnZ(): boolean {
    return this.lift.kind === "z";
  }

  /** Whether a servo is still on its way. */
  isMoving(nowS: number): boolean {
    return nowS < this.endS - 1e-6;
  }

  /** The signal of the spindle's output has changed. Without one, a servo stays where it is. */
  signal(value: number | null, nowS: number): void {
    if (this.lift.kind === "servo" && value !== null) this.moveTo(this.lift.pctOf(value), nowS);
  }

  /** A line was executed. */
  executed(line: string, nowS: number): void {
    if (this.upLines.at(-1) === line) this.moveTo(PEN_TABLE.upPct.default, nowS);
    if (this.downLines.at(-1) === line) this.moveTo(PEN_TABLE.downPct.default, nowS);
  }

  private moveTo(pct: number, nowS: number): void {
    this.fromPct = this.pctAt(nowS);
    this.toPct = pct;
    this.startS = nowS;
    const { servo } = this.lift;
    const rate = pct > this.fromPct ? servo.liftPctPerS : servo.dropPctPerS;
    this.endS = nowS + servoTime(servo, Math.abs(pct - this.fromPct), rate);
  }

  private pctAt(nowS: number): number {
    if (nowS >= this.endS) return this.toPct;
    const share = Math.max(0, nowS - this.startS) / (this.endS - this.startS);
    return this.fromPct + share * (this.toPct - this.fromPct);
  }
}

/** The lines that the pen draws, and its travels. */
export class Ink {
  readonly lines = new DrawnPolylines();
  private isDrawing = false;

  constructor(
    private readonly isPenDown: () => boolean,
    private readonly at: () => { readonly x: number; readonly y: number },
  ) {}

  /** A move has ended. */
  arrived(): void {
    if (!this.see()) this.add();
  }

  /** Begins another line if the pen has touched or left the paper. */
  see(): boolean {
    const hasChanged = this.isDrawing !== this.isPenDown();
    if (hasChanged) this.begin(!this.isDrawing);
    return hasChanged;
  }

  begin(penDown: boolean): void {
    this.isDrawing = penDown;
    this.lines.begin(penDown);
    this.add();
  }

  private add(): void {
    const { x, y } = this.at();
    this.lines.add(x, y);
  }
}

/** The lines as a Grbl reads them. */
const read = (lines: string | null | undefined): string[] =>
  (lines ?? "")
    .split("\n")
    .map((line) => line.replace(/\s|\(.*?\)|;.*/g, "").toUpperCase())
    .filter((line) => line !== "");
