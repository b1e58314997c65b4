/**
 * The Grbl's own settings ($$), as far as they decide whether a plan is true: its units, speeds, limits and homing. A
 * setting that it does not report is not checked.
 */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { ARC_TOLERANCE_MM } from "../model/arc-cut.js";
import { axisLimits, GRBL_FIELDS, grblOf } from "../model/grbl-controller.js";
import { difference, type Axes, type GrblAxisLimits } from "../model/planner.js";
import { isOldVersion, unplaced } from "../protocol.js";
import { rangeOf, reachOf, type Range } from "./reach.js";

const AXES = ["X", "Y", "Z"] as const;
const MM_PER_INCH = 25.4;
/** Relative difference up to which two values count as the same. */
const SAME = 0.01;

const BOTH_POSITIONS = 3;

/** The numbers of the settings. Those of an axis follow each other in the order X, Y, Z. */
const SETTING = {
  report: 10,
  junctionMm: 11,
  arcTolerance: 12,
  reportInches: 13,
  softLimits: 20,
  homing: 22,
  homingDirections: 23,
  pullOff: 27,
  maxSignal: 30,
  laserMode: 32,
  speed: 110,
  accel: 120,
  travel: 130,
} as const;

export class BoardSettings {
  private readonly values = new Map<number, number>();
  /** A build whose machine coordinates begin at the switches: option Z of `$I`. */
  private isOriginAtSwitches = false;

  /** Takes over a line such as "$110=500.000" or "[OPT:VZ,15,128]"; ignores others. */
  take(line: string): void {
    const setting = /^\$(\d+)=(-?[\d.]+)/.exec(line);
    if (setting) this.values.set(Number(setting[1]), Number(setting[2]));
    const options = /^\[OPT:([A-Z]*)/.exec(line);
    if (options) this.isOriginAtSwitches = options[1].includes("Z");
  }

  forget(): void {
    this.values.clear();
  }

  /** The unit of the positions that it reports. */
  get mmPerUnit(): number {
    return this.isOn(SETTING.reportInches) ? MM_PER_INCH : 1;
  }

  /** Throws `bad-setting` for a Grbl 0.9 that does not report both its positions. Later versions report their offset. */
  mustReport(version: string): void {
    const mask = this.values.get(SETTING.report) ?? BOTH_POSITIONS;
    if (isOldVersion(version) && (mask & BOTH_POSITIONS) !== BOTH_POSITIONS) throw unplaced("in the console");
  }

  /** It locks itself at each start, until it is homed. */
  get hasHoming(): boolean {
    return this.isOn(SETTING.homing);
  }

  get arcToleranceMm(): number {
    return this.values.get(SETTING.arcTolerance) ?? ARC_TOLERANCE_MM;
  }

  /** Where the search for the switches ends, in machine coordinates; null: it does not say. */
  get afterHoming(): Axes | null {
    const pullOff = this.values.get(SETTING.pullOff);
    if (!this.hasHoming || pullOff === undefined) return null;
    if (this.isOriginAtSwitches) return [0, 0, 0];
    const travel = (axis: number): number => this.values.get(SETTING.travel + axis) ?? 0;
    const end = (axis: number): number => (this.isHomedLow(axis) ? pullOff - travel(axis) : -pullOff);
    return [end(0), end(1), end(2)];
  }

  /** Those that a plan has to follow: the Grbl's own, and the lower of both speeds. */
  limitsFor(profile: MachineProfile): GrblAxisLimits {
    const { speed, accel, junctionMm } = axisLimits(grblOf(profile));
    const own = (setting: number, axis: number): number | undefined => this.values.get(setting + axis);
    const each = (value: (axis: 0 | 1 | 2) => number): Axes => [value(0), value(1), value(2)];
    return {
      speed: each((axis) => Math.min(speed[axis], (own(SETTING.speed, axis) ?? Infinity) / 60)),
      accel: each((axis) => own(SETTING.accel, axis) ?? accel[axis]),
      junctionMm: this.values.get(SETTING.junctionMm) ?? junctionMm,
    };
  }

  /** What the Grbl does more slowly than the profile says, in words; null: nothing. */
  slowerThan(profile: MachineProfile): string | null {
    const asked = axisLimits(grblOf(profile));
    const own = this.limitsFor(profile);
    const slower = AXES.flatMap((letter, axis) => {
      const name = axis === 2 ? "the pen" : letter;
      return [
        ...lower(`speed of ${name}`, "mm/s", own.speed[axis], asked.speed[axis], SETTING.speed + axis),
        ...lower(
          `acceleration of ${name}`,
          "mm/s²",
          own.accel[axis],
          asked.accel[axis],
          SETTING.accel + axis,
        ),
      ];
    });
    const { label, unit } = GRBL_FIELDS.junctionMm;
    slower.push(...lower(label, unit, own.junctionMm, asked.junctionMm, SETTING.junctionMm));
    if (slower.length === 0) return null;
    return (
      `This Grbl is slower than the profile of ${profile.name} says: ${slower.join("; ")}. Plots take longer than ` +
      "the preview tells: change the profile, or the Grbl's settings in the console."
    );
  }

  /**
   * Throws if the Grbl would not perform lines as they are meant. In machine coordinates, `offset`: the work zero; `at`:
   * where it stands, which only arcs depend on.
   */
  mustPerform(lines: readonly string[], offset: Axes, at = offset): void {
    this.mustSignal(lines);
    this.mustReach(lines, offset, at);
  }

  /** Throws `bad-setting` if the servo would not follow its lines. */
  private mustSignal(lines: readonly string[]): void {
    const range = rangeOf(lines, "M3S");
    if (!range) return;
    if (this.isOn(SETTING.laserMode)) {
      throw new PlotwrightError(
        "bad-setting",
        "The Grbl is in laser mode ($32=1), in which it switches the signal of the pen's servo by itself. Nothing has " +
          "moved. Switch the mode off: send $32=0 in the console.",
      );
    }
    const max = this.values.get(SETTING.maxSignal) ?? Infinity;
    if (range[1] <= max) return;
    throw new PlotwrightError(
      "bad-setting",
      `The pen's servo needs S${mm(range[1])}, but the Grbl's highest S is ${mm(max)} ($30). Nothing has moved. ` +
        "Lower the pen's heights, or change the profile's S values or $30.",
    );
  }

  /**
   * Throws `out-of-bounds` if lines leave the soft limits, at which the Grbl would stop with an alarm.
   */
  private mustReach(lines: readonly string[], offset: Axes, at: Axes): void {
    if (!this.isOn(SETTING.softLimits)) return;
    const reach = reachOf(lines, difference(at, offset));
    AXES.forEach((letter, axis) => {
      const limits = this.limitsOf(axis);
      const range = reach[axis];
      if (!limits || !range) return;
      const [min, max] = [limits[0] - offset[axis], limits[1] - offset[axis]];
      if (range[0] >= min - 1e-6 && range[1] <= max + 1e-6) return;
      throw new PlotwrightError(
        "out-of-bounds",
        `This needs ${letter} from ${mm(range[0])} to ${mm(range[1])} mm, but the Grbl's soft limits ($20=1) end at ` +
          `${mm(min)} and ${mm(max)} mm from home. Nothing has moved. Home the machine, push the carriage to where ` +
          "the drawing lies within its limits and set home there, or switch the limits off ($20=0).",
      );
    });
  }

  private limitsOf(axis: number): Range | null {
    const travel = this.values.get(SETTING.travel + axis);
    if (travel === undefined) return null;
    return this.isOriginAtSwitches && this.isHomedLow(axis) ? [0, travel] : [-travel, 0];
  }

  /** Its switch is at the low end of the axis. */
  private isHomedLow(axis: number): boolean {
    return (((this.values.get(SETTING.homingDirections) ?? 0) >> axis) & 1) === 1;
  }

  private isOn(setting: number): boolean {
    return (this.values.get(setting) ?? 0) !== 0;
  }
}

/** The Grbl reports three decimals. */
const lower = (what: string, unit: string, own: number, asked: number, setting: number): string[] =>
  asked === Infinity || own >= asked - SAME * asked - 0.0005
    ? []
    : [`${what} is at most ${mm(own)} ${unit} ($${setting})`];

const mm = (value: number): string => String(Number(value.toFixed(3)));
