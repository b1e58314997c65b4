/**
 * How a Grbl moves the pen: with its Z axis, with a servo on the output of the spindle (M3 S), or with lines from the
 * profile. Grbl knows nothing of a servo's travel, so it is told to wait (G4).
 */
import { PlotwrightError } from "../../../errors.js";
import { HOBBY_SERVO, servoTime } from "../../../machines/pen-servo.js";
import type { Controller, MachineProfile, PenServo } from "../../../machines/profile.js";
import { waitOf } from "../../../plan/pen/pen-times.js";
import { PEN_TABLE, type PenSettings } from "../../../settings/pen.js";
import type { ControllerChoice } from "../../driver.js";
import { whyRefused } from "../console-lines.js";
import { dwellS, grblOf, type GrblController } from "./grbl-controller.js";
import { moveTimeS, type GrblAxisLimits } from "./planner.js";

export interface PenLift {
  readonly kind: "z" | "servo" | "lines";
  /** The time of a move that Grbl itself does not know, by height; a servo's model. */
  readonly servo: PenServo;
  /** Lines that move the pen to a height, without the wait. */
  lines(up: boolean, pct: number): readonly string[];
  /** Duration of those lines themselves, s. */
  moveS(fromPct: number, toPct: number): number;
  /** The wait after a pen move; `servoS`: the time of the servo. */
  waitS(servoS: number): number;
  /** The Z or S of a height, and the reverse. Own lines have none: 0. */
  valueAt(pct: number): number;
  pctOf(value: number): number;
}

const UP_PCT = PEN_TABLE.upPct.default;
const DOWN_PCT = PEN_TABLE.downPct.default;
const WHOLE_PCT = 100;
/** Grbl itself knows when the pen has arrived, or the profile's wait says it. */
const AT_ONCE: PenServo = {
  minMs: 0,
  slopeMsPerPct: 0,
  liftPctPerS: Infinity,
  dropPctPerS: Infinity,
  frameMs: 0,
};

export const LIFT_CHOICE: ControllerChoice = {
  label: "The pen is lifted by",
  options: [
    { label: "Servo (M3 S)", fields: ["penUpS", "penDownS"] },
    { label: "Z axis", fields: ["penUpZMm", "penDownZMm", "penSpeedMmPerS", "penAccelMmPerS2"] },
    { label: "Own lines", fields: ["penUpLines", "penDownLines"] },
  ],
};

/** A line that waits, as a user may write it. */
const WAIT = /^\s*G0*4\s*P\s*(\d*\.?\d+)/i;

const given = (value: unknown): boolean => value !== null && value !== undefined;

/** The first field that is missing or contradicts another; null if the profile describes one pen lift. */
export function liftFault(controller: Controller): { field: string; message: string } | null {
  const grbl = controller as GrblController;
  const pairs = [
    ["penUpZMm", "penDownZMm"],
    ["penUpS", "penDownS"],
    ["penUpLines", "penDownLines"],
  ] as const;
  const used = pairs.filter((pair) => pair.some((field) => given(grbl[field])));
  if (used.length === 0) {
    return {
      field: "penUpZMm",
      message:
        "the profile does not say how the pen is lifted: it needs penUpZMm and penDownZMm for a Z axis, penUpS and " +
        "penDownS for a servo, or penUpLines and penDownLines",
    };
  }
  if (used.length > 1) {
    return { field: used[1][0], message: `a pen is lifted in one way, but there is ${used[0][0]} too` };
  }
  const [[up, down]] = used;
  const missing = [up, down].find((field) => !given(grbl[field]));
  if (missing) return { field: missing, message: "it is missing, but the other of the two heights is given" };
  if (grbl[up] === grbl[down]) {
    return { field: down, message: "it must differ from the other of the two heights" };
  }
  if (up === "penUpLines") {
    for (const field of [up, down] as const) {
      const why = grbl[field]!.split("\n")
        .map(whyRefused)
        .find((one) => one !== null);
      if (why) return { field, message: `a line cannot be sent: ${why}` };
    }
  }
  if (up === "penUpZMm") {
    const lacking = (["penSpeedMmPerS", "penAccelMmPerS2"] as const).find((field) => !given(grbl[field]));
    if (lacking) return { field: lacking, message: "a Z axis needs it" };
  }
  return null;
}

/**
 * Throws `bad-setting` for a profile that does not describe one. `limits`: those of the Grbl itself, if known; `zShiftMm`:
 * where the profile's Z is 0.
 */
export function penLiftOf(machine: MachineProfile, limits?: GrblAxisLimits, zShiftMm = 0): PenLift {
  const grbl = grblOf(machine);
  const fault = liftFault(grbl);
  if (fault) {
    throw new PlotwrightError(
      "bad-setting",
      `The machine profile "${machine.name}" can't be used: ${fault.field}: ${fault.message}.`,
    );
  }
  const extraS = (grbl.penWaitMs ?? 0) / 1_000;
  const waitS = (servoS: number): number => dwellS(servoS + extraS);
  const { penUpZMm, penDownZMm, penUpS, penDownS, penUpLines, penDownLines } = grbl;
  if (given(penUpZMm)) {
    const scale = new Scale(penUpZMm!, penDownZMm!, grbl.penMinZMm ?? -Infinity, grbl.penMaxZMm ?? Infinity);
    const speed = Math.min(grbl.penSpeedMmPerS!, limits?.speed[2] ?? Infinity);
    const accel = limits?.accel[2] ?? grbl.penAccelMmPerS2!;
    return {
      kind: "z",
      servo: AT_ONCE,
      lines: (_, pct) => [`G1Z${number(scale.at(pct) + zShiftMm)}F${number(60 * grbl.penSpeedMmPerS!)}`],
      moveS: (fromPct, toPct) => moveTimeS(Math.abs(scale.at(toPct) - scale.at(fromPct)), speed, accel),
      waitS,
      valueAt: (pct) => scale.at(pct),
      pctOf: (zMm) => scale.pctOf(zMm - zShiftMm),
    };
  }
  if (given(penUpS)) {
    const scale = new Scale(penUpS!, penDownS!, 0, Infinity);
    return {
      kind: "servo",
      servo: machine.penServo ?? HOBBY_SERVO,
      lines: (_, pct) => [`M3S${number(scale.at(pct))}`],
      moveS: () => 0,
      waitS,
      valueAt: (pct) => scale.at(pct),
      pctOf: (s) => scale.pctOf(s),
    };
  }
  return {
    kind: "lines",
    servo: machine.penServo ?? AT_ONCE,
    lines: (up) => (up ? penUpLines! : penDownLines!).split("\n"),
    moveS: (fromPct, toPct) =>
      fromPct === toPct ? 0 : waitsS(toPct > fromPct ? penUpLines! : penDownLines!),
    waitS,
    valueAt: () => 0,
    pctOf: () => 0,
  };
}

/** A height in percent as a value of Z or S. */
class Scale {
  constructor(
    private readonly up: number,
    private readonly down: number,
    private readonly min: number,
    private readonly max: number,
  ) {}

  at(pct: number): number {
    const share = (pct - DOWN_PCT) / (UP_PCT - DOWN_PCT);
    return Math.min(this.max, Math.max(this.min, this.down + share * (this.up - this.down)));
  }

  pctOf(value: number): number {
    return DOWN_PCT + ((value - this.down) / (this.up - this.down)) * (UP_PCT - DOWN_PCT);
  }
}

/** The sum of the waits (G4) in own lines. How long their moves take is unknown. */
const waitsS = (lines: string): number =>
  lines.split("\n").reduce((seconds, line) => seconds + dwellS(Number(WAIT.exec(line)?.[1] ?? 0)), 0);

/** At most three decimals. */
export const number = (value: number): string => String(Number(value.toFixed(3)));

/** A line that waits; its reply comes when the wait is over. */
export const waitLine = (seconds: number): string => `G4P${number(dwellS(seconds))}`;

/** The wait after a pen move outside a plot. `fromPct`: null if unknown. */
export function waitAfter(
  lift: PenLift,
  fromPct: number | null,
  toPct: number,
  up: boolean,
  pen: PenSettings,
): string {
  const byPct = fromPct === null ? WHOLE_PCT : Math.abs(toPct - fromPct);
  const { liftPctPerS, dropPctPerS } = lift.servo;
  const [pctPerS, extraMs] = up ? [liftPctPerS, pen.extraLiftMs] : [dropPctPerS, pen.extraDropMs];
  return waitLine(lift.waitS(waitOf(servoTime(lift.servo, byPct, pctPerS), extraMs)));
}
