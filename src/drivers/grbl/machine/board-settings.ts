/**
 * The Grbl's own settings ($$), as far as they decide whether a plan is true: its units, speeds, limits and homing. A
 * setting that it does not report is not checked.
 */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { GRBL_FIELDS, grblOf, type GrblController } from "../model/grbl-controller.js";
import type { Axes } from "../model/planner.js";

const AXES = ["X", "Y", "Z"] as const;
const MM_PER_INCH = 25.4;
/** Relative difference up to which two values count as the same. */
const SAME = 0.01;

/** The numbers of the settings. Those of an axis follow each other in the order X, Y, Z. */
const SETTING = {
  junctionMm: 11,
  reportInches: 13,
  softLimits: 20,
  homing: 22,
  homingDirections: 23,
  speed: 110,
  accel: 120,
  travel: 130,
} as const;

/** The lowest and the highest position of one axis in a job's lines, mm from the work zero. */
type Range = readonly [min: number, max: number];

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

  /** It locks itself at each start, until it is homed. */
  get hasHoming(): boolean {
    return this.isOn(SETTING.homing);
  }

  /** Throws `bad-setting` if the Grbl moves otherwise than the profile says, since all times would then be wrong. */
  mustMatch(profile: MachineProfile): void {
    const grbl = grblOf(profile);
    const wrong = [
      ...[0, 1].flatMap((axis) => this.faster("maxSpeedMmPerS", grbl, axis)),
      ...[0, 1].flatMap((axis) => this.different("accelMmPerS2", grbl, SETTING.accel + axis)),
      ...this.different("junctionMm", grbl, SETTING.junctionMm),
      ...this.faster("penSpeedMmPerS", grbl, 2),
      ...this.different("penAccelMmPerS2", grbl, SETTING.accel + 2),
    ];
    if (wrong.length === 0) return;
    throw new PlotwrightError(
      "bad-setting",
      `The profile of ${profile.name} does not fit the Grbl's own settings, so all times would be wrong: ${wrong.join("; ")}. ` +
        "Change the profile, or the Grbl's settings in the console.",
    );
  }

  /**
   * Throws `out-of-bounds` if lines leave the soft limits, at which the Grbl would stop with an alarm. `offset`: the work
   * zero in machine coordinates.
   */
  mustReach(lines: readonly string[], offset: Axes): void {
    if (!this.isOn(SETTING.softLimits)) return;
    AXES.forEach((letter, axis) => {
      const limits = this.limitsOf(axis);
      const range = rangeOf(lines, letter);
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
    const isAtLowEnd = (((this.values.get(SETTING.homingDirections) ?? 0) >> axis) & 1) === 1;
    return this.isOriginAtSwitches && isAtLowEnd ? [0, travel] : [-travel, 0];
  }

  private isOn(setting: number): boolean {
    return (this.values.get(setting) ?? 0) !== 0;
  }

  private faster(field: "maxSpeedMmPerS" | "penSpeedMmPerS", grbl: GrblController, axis: number): string[] {
    const max = (this.values.get(SETTING.speed + axis) ?? Infinity) / 60;
    if (grbl[field] <= max * (1 + SAME)) return [];
    return [`${GRBL_FIELDS[field].label} is at most ${mm(max)} mm/s ($${SETTING.speed + axis})`];
  }

  private different(
    field: "accelMmPerS2" | "penAccelMmPerS2" | "junctionMm",
    grbl: GrblController,
    setting: number,
  ): string[] {
    const value = this.values.get(setting);
    // Reported with three decimals.
    if (value === undefined || Math.abs(value - grbl[field]) <= SAME * value + 0.0005) return [];
    return [`${GRBL_FIELDS[field].label} is ${mm(value)} ${GRBL_FIELDS[field].unit} ($${setting})`];
  }
}

const mm = (value: number): string => String(Number(value.toFixed(3)));

function rangeOf(lines: readonly string[], letter: string): Range | null {
  const word = new RegExp(`${letter}(-?[\\d.]+)`);
  let [min, max] = [Infinity, -Infinity];
  for (const line of lines) {
    const match = word.exec(line);
    if (!match) continue;
    min = Math.min(min, Number(match[1]));
    max = Math.max(max, Number(match[1]));
  }
  return min <= max ? [min, max] : null;
}
