/**
 * Rejects motion and pen settings that are outside the ranges of the settings tables or contradict each
 * other.
 */
import { checkNames } from "../check-arguments.js";
import { PlotwrightError } from "../errors.js";
import type { MachineProfile } from "../machines/profile.js";
import {
  AXIS_TABLE,
  DEFAULT_MOTION,
  DRAW_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  MOTION_MODES,
  MOTOR_ACCEL,
  SHAPERS,
  SPEED_FACTOR,
  TRAVEL_TABLE,
  type MotionSettings,
} from "../settings/motion.js";
import {
  DEFAULT_PEN,
  DROP_RATE,
  LAYER_WAIT,
  LIFT_RATE,
  OVERLAP_TABLE,
  PEN_OVERLAPS,
  PEN_TABLE,
  type PenSettings,
} from "../settings/pen.js";
import { PEN_SERVO_TABLE, SPRINGS_TABLE } from "../settings/machine.js";
import { isAllowed, rangeInWords, type NumberSetting } from "../settings/setting.js";
import { drawLimitsOf } from "./limits.js";
import { penOfLayer } from "./pen/pen-times.js";

/** @throws PlotwrightError "bad-setting", naming the setting, its value and what is allowed */
export function checkSettings(
  motion: MotionSettings,
  pen: PenSettings,
  machine: MachineProfile | undefined,
): void {
  checkSettingNames(motion, pen);
  checkChoice("Motion mode", MOTION_MODES, motion.mode);
  checkShaper(motion, machine);
  checkNumbers("Draw", DRAW_TABLE, motion.draw);
  checkNumbers("Travel", TRAVEL_TABLE, motion.travel);
  for (const [layer, own] of Object.entries(motion.layers ?? {})) {
    checkOptional(`Layer "${layer}" draw`, SPEED_FACTOR, own.speedFactor);
    checkNumbers(`Layer "${layer}" draw`, DRAW_TABLE, drawLimitsOf(motion, layer));
  }
  if (motion.fit) checkNumbers("Fit", FIT_TABLE, motion.fit);
  if (motion.ease) checkNumbers("Slow-in", EASE_TABLE, motion.ease);
  checkOptional("The", MOTOR_ACCEL, motion.motorAccelStepsPerS2);
  for (const key of Object.keys(AXIS_TABLE) as (keyof typeof AXIS_TABLE)[]) {
    checkOptional("The", AXIS_TABLE[key], motion[key]);
  }
  if (machine?.penServo) checkNumbers(`Machine "${machine.name}"`, PEN_SERVO_TABLE, machine.penServo);
  checkPen("Pen", pen);
  for (const [layer, { beforeMs }] of Object.entries(pen.layers ?? {})) {
    checkPen(`Layer "${layer}" pen`, penOfLayer(pen, layer));
    checkOptional(`Layer "${layer}" pen`, LAYER_WAIT, beforeMs);
  }
}

const PEN_NAMES = [...Object.keys(DEFAULT_PEN), "liftPctPerS", "dropPctPerS", "layers"];
const MOTION_NAMES = [
  ...Object.keys(DEFAULT_MOTION),
  ...Object.keys(AXIS_TABLE),
  "ease",
  "motorAccelStepsPerS2",
  "layers",
];

/** @throws PlotwrightError "bad-setting" for unknown names */
export function checkSettingNames(motion: MotionSettings, pen: PenSettings): void {
  checkNames("motion", motion, MOTION_NAMES);
  checkNames("draw", motion.draw, Object.keys(DRAW_TABLE));
  checkNames("travel", motion.travel, Object.keys(TRAVEL_TABLE));
  checkNames("pen", pen, PEN_NAMES);
}

function checkShaper({ shaper = "none", mode }: MotionSettings, machine: MachineProfile | undefined): void {
  checkChoice("Shaper", SHAPERS, shaper);
  if (shaper === "none") return;
  if (!machine?.springs) {
    throw bad(
      `Shaper ${shaper} needs the measured swing of the machine, but ` +
        `${machine ? `machine "${machine.name}" was not measured` : "no machine is given"}: ` +
        "plot the ringing sheet, or choose shaper none.",
    );
  }
  checkNumbers(`Machine "${machine.name}"`, SPRINGS_TABLE, machine.springs);
  if (mode === "scurve") {
    throw bad(
      `Shaper ${shaper} cannot be combined with mode scurve, since both filter the motion: ` +
        "choose mode blend, or shaper none.",
    );
  }
}

/** @throws PlotwrightError "bad-setting" */
export function checkPen(name: string, pen: PenSettings): void {
  checkNumbers(name, PEN_TABLE, pen);
  if (pen.upPct <= pen.downPct) {
    throw bad(
      `${name} up height ${pen.upPct} % is not above its down height ${pen.downPct} %: ` +
        "the pen would never leave the paper; raise the up height or lower the down height.",
    );
  }
  checkOptional(name, LIFT_RATE, pen.liftPctPerS);
  checkOptional(name, DROP_RATE, pen.dropPctPerS);
  checkNumber(name, OVERLAP_TABLE.contactPct, pen.contactPct);
  checkNumber(name, OVERLAP_TABLE.fullHeightMm, pen.fullHeightMm);
  checkChoice(`${name} overlap`, PEN_OVERLAPS, pen.overlap);
}

function checkChoice<T extends string>(name: string, choices: readonly T[], value: T): void {
  if (choices.includes(value)) return;
  throw bad(`${name} is "${String(value)}": choose one of ${choices.join(", ")}.`);
}

function checkNumbers<Table extends Readonly<Record<string, NumberSetting>>>(
  name: string,
  table: Table,
  values: Readonly<Record<keyof Table, number>>,
): void {
  for (const [key, row] of Object.entries(table)) checkNumber(name, row, values[key]);
}

function checkOptional(name: string, row: NumberSetting, value: number | null | undefined): void {
  if (value !== null && value !== undefined) checkNumber(name, row, value);
}

function checkNumber(name: string, row: NumberSetting, value: number): void {
  // The planner has no upper limit for speeds and lengths; percentages and waits have one.
  const range = row.minExcluded ? { ...row, max: Infinity } : row;
  if (isAllowed(range, value)) return;
  const shown =
    typeof value === "number" ? `${value} ${row.unit}`.trim() : (JSON.stringify(value) ?? "missing");
  throw bad(`${name} ${row.label.toLowerCase()} is ${shown}: it must be ${rangeInWords(range)}.`);
}

const bad = (message: string): PlotwrightError => new PlotwrightError("bad-setting", message);
