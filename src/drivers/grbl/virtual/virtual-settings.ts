/** What differs from one virtual Grbl to another: its own settings, its receive buffer, faults; and what a test sees of it. */
import type { MachineProfile } from "../../../machines/profile.js";
import { ARC_TOLERANCE_MM } from "../model/arc-cut.js";
import { axisLimits, grblOf } from "../model/grbl-controller.js";
import { difference, type Axes, type GrblAxisLimits } from "../model/planner.js";
import { ERROR } from "./gcode-words.js";
import { faceNamed, faceOf, type Face, type FaceName } from "./faces.js";

export interface VirtualGrblOptions {
  /** Which of Grbl's children it is; default: the one that the version names. */
  readonly face?: FaceName;
  /** Characters that its receive buffer really holds; default: as many as it reports. */
  readonly rxBytes?: number;
  /** The code with which it refuses a line when `spoil("refused")` was called; default 20. */
  readonly refusal?: number;
  /** Whether it knows G2 and G3; default: as its face does. */
  readonly takesArcs?: boolean;
  /** Whether it is built for CoreXY, and plans the way of its motors as Grbl 1.1 does. Default false. */
  readonly isCore?: boolean;
  /** Settings by number, where they differ from the machine's profile: { 110: 3000 } is $110=3000. */
  readonly settings?: Readonly<Record<number, number>>;
}

export interface VirtualGrblState {
  readonly state: string;
  /** The real position, from that of the first start. */
  readonly xMm: number;
  readonly yMm: number;
  readonly zMm: number;
  readonly penUp: boolean;
  /** Its work offset, in the machine coordinates since its last start. */
  readonly offsetMm: Axes;
  /** Motions that began while the pen's servo was still on its way. */
  readonly earlyCount: number;
  /** Times at which the motion ended in want of the next move. */
  readonly starvedCount: number;
  /** Seconds in motion. */
  readonly movingS: number;
  /** Characters that arrived when the buffer was full: a real Grbl loses them silently. */
  readonly lostCount: number;
}

/**
 * Faults of the connection: the next replies ("ok" or "error:n") are lost, sent twice or damaged; the next line ends do
 * not arrive, so that two lines become one; the next lines are refused.
 */
export type LineFault = "reply-lost" | "reply-doubled" | "reply-damaged" | "line-end-lost" | "refused";

/** The work offset is in every 10th report at rest, and every 30th in motion. */
const OFFSET_EVERY = { rest: 10, motion: 30 };

export class VirtualSettings {
  readonly face: Face;
  readonly rxBytes: number;
  readonly refusal: number;
  readonly takesArcs: boolean;
  private readonly isCore: boolean;
  /** Reports until the next one with the work offset. */
  offsetDue = 0;
  private readonly settings = new Map<number, number>();
  private readonly faults = new Map<LineFault, number>();

  constructor(
    machine: MachineProfile,
    version: string,
    {
      face = faceNamed(version),
      rxBytes,
      refusal = ERROR.unknown,
      takesArcs,
      isCore = false,
      settings = {},
    }: VirtualGrblOptions,
  ) {
    this.refusal = refusal;
    this.face = faceOf(face);
    this.takesArcs = takesArcs ?? this.face.takesArcs;
    this.isCore = isCore;
    this.rxBytes = rxBytes ?? this.face.rxBytes;
    const { speed, accel, junctionMm } = axisLimits(grblOf(machine));
    const finite = (value: number, other: number): number => (Number.isFinite(value) ? value : other);
    const { stepsPerMm, widthMm, heightMm } = machine;
    const all: Readonly<Record<number, number>> = {
      0: 10,
      1: 25,
      10: this.face.mask,
      11: junctionMm,
      12: ARC_TOLERANCE_MM,
      13: 0,
      20: 0,
      22: 0,
      23: 0,
      27: 1,
      30: 1_000,
      31: 0,
      32: 0,
      100: stepsPerMm,
      101: stepsPerMm,
      102: stepsPerMm,
      110: 60 * speed[0],
      111: 60 * speed[1],
      112: finite(60 * speed[2], 500),
      120: accel[0],
      121: accel[1],
      122: finite(accel[2], 10),
      130: widthMm,
      131: heightMm,
      132: 200,
      ...settings,
    };
    for (const [number, value] of Object.entries(all)) this.settings.set(Number(number), value);
  }

  get limits(): GrblAxisLimits {
    const speed = this.axes(110);
    return {
      speed: [speed[0] / 60, speed[1] / 60, speed[2] / 60],
      accel: this.axes(120),
      junctionMm: this.value(11),
      isCore: this.isCore,
    };
  }

  /** The reply to `$I`. */
  get info(): readonly string[] {
    return this.isCore ? this.face.info.map((line) => line.replace("[OPT:V", "[OPT:VC")) : this.face.info;
  }

  get arcToleranceMm(): number {
    return this.value(12);
  }

  get hasHoming(): boolean {
    return this.value(22) !== 0;
  }

  /** A status report. `at`: in machine coordinates; `work`: their work offset. */
  report(state: string, at: Axes, work: Axes, free: string, speedMmPerS: number): string {
    const hasOffset = this.offsetDue === 0;
    this.offsetDue = hasOffset ? OFFSET_EVERY[state === "Idle" ? "rest" : "motion"] : this.offsetDue - 1;
    return this.face.report({
      state,
      machineAt: this.reported(at),
      workAt: this.reported(difference(at, work)),
      offset: hasOffset ? this.reported(work) : null,
      free,
      feed: Math.round(60 * speedMmPerS),
      mask: this.value(10),
    });
  }

  /** What really arrives of an answer. */
  answersFor(text: string): readonly string[] {
    if (this.takes("reply-lost")) return [];
    if (this.takes("reply-damaged")) return [`${text[0]}?`];
    return this.takes("reply-doubled") ? [text, text] : [text];
  }

  /** A position in the unit and with the decimals of its reports. */
  private reported(at: Axes): string {
    const inInches = this.value(13) !== 0;
    return at.map((mm) => (inInches ? (mm / 25.4).toFixed(4) : mm.toFixed(3))).join(",");
  }

  /** Whether a target in machine coordinates is beyond the soft limits. */
  isBeyond(target: Axes): boolean {
    const travel = this.axes(130);
    return this.value(20) !== 0 && target.some((mm, axis) => mm > 0 || mm < -travel[axis]);
  }

  list(): string[] {
    return [...this.settings].map(([number, value]) => {
      return `$${number}=${number < 11 || (number > 12 && number < 24) ? value : value.toFixed(3)}`;
    });
  }

  /** False if there is no such setting. */
  set(number: number, value: number): boolean {
    if (!this.settings.has(number)) return false;
    this.settings.set(number, value);
    return true;
  }

  spoil(fault: LineFault, count: number): void {
    this.faults.set(fault, count);
  }

  /** Whether the fault happens now. */
  takes(fault: LineFault): boolean {
    const count = this.faults.get(fault) ?? 0;
    if (count > 0) this.faults.set(fault, count - 1);
    return count > 0;
  }

  private axes(first: number): Axes {
    return [this.value(first), this.value(first + 1), this.value(first + 2)];
  }

  private value(number: number): number {
    return this.settings.get(number) ?? 0;
  }
}
