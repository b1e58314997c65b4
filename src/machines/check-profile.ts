/** Checks profiles written by hand in programs without types, which may lack required fields. */
import { checkObject } from "../check-arguments.js";
import { PlotwrightError } from "../errors.js";
import { isAllowed, rangeInWords, type NumberSetting, type SettingsTable } from "../settings/setting.js";
import { CONTROLLER_TABLES } from "./controllers.js";
import type { MachineProfile } from "./profile.js";

const isNumber = (value: unknown): boolean => Number.isFinite(value);
const isAbove0 = (value: unknown): boolean => isNumber(value) && (value as number) > 0;
const isOneOf =
  (...allowed: readonly unknown[]) =>
  (value: unknown): boolean =>
    allowed.includes(value);

interface Need {
  readonly isRight: (value: unknown) => boolean;
  readonly what: string;
}
const ABOVE_0: Need = { isRight: isAbove0, what: "a number above 0" };
const NUMBER: Need = { isRight: isNumber, what: "a number" };

const PROFILE_NEEDS: Readonly<Record<string, Need>> = {
  widthMm: ABOVE_0,
  heightMm: ABOVE_0,
  stepsPerMm: ABOVE_0,
  motors: { isRight: isOneOf("mixed", "direct"), what: '"mixed" or "direct"' },
};
const EBB_NEEDS: Readonly<Record<string, Need>> = {
  microstepMode: { isRight: isOneOf(1, 2, 3, 4, 5), what: "1, 2, 3, 4 or 5" },
  servoPosAt0Pct: NUMBER,
  servoPosAt100Pct: NUMBER,
  servoPin: { isRight: isOneOf(4, 5), what: "4 or 5" },
};

const needOf = (row: NumberSetting): Need => ({
  isRight: (value) => isAllowed(row, value as number),
  what: rangeInWords(row),
});
const needsOf = (table: SettingsTable): Record<string, Need> =>
  Object.fromEntries(
    Object.entries(table).flatMap(([key, row]) => (row.kind === "number" ? [[key, needOf(row)]] : [])),
  );

/** By the controller's kind. */
const CONTROLLER_NEEDS: Readonly<Record<string, Readonly<Record<string, Need>>>> = {
  ebb: EBB_NEEDS,
  ...Object.fromEntries(Object.entries(CONTROLLER_TABLES).map(([kind, table]) => [kind, needsOf(table)])),
};
const KINDS = Object.keys(CONTROLLER_NEEDS);
const KIND: Need = { isRight: isOneOf(...KINDS), what: KINDS.map((kind) => `"${kind}"`).join(" or ") };

/** @throws PlotwrightError "bad-setting" for the first field that is missing or invalid */
export function checkProfile(machine: MachineProfile): void {
  checkObject("machine", "the machine", machine, [], 'a profile, for example machineById("axidraw-v3")');
  const name = String(machine.name ?? machine.id ?? "without a name");
  check(name, "", PROFILE_NEEDS, machine);
  const controller: unknown = machine.controller;
  if (typeof controller !== "object" || controller === null) {
    throw bad(`The machine profile "${name}" has no controller: what drives its motors and its pen.`);
  }
  check(name, "controller.", { kind: KIND }, controller);
  const { kind } = controller as { readonly kind: string };
  check(name, "controller.", CONTROLLER_NEEDS[kind] ?? {}, controller);
}

function check(name: string, at: string, needs: Readonly<Record<string, Need>>, values: object): void {
  for (const [key, { isRight, what }] of Object.entries(needs)) {
    const value = (values as Readonly<Record<string, unknown>>)[key];
    if (isRight(value)) continue;
    const is = value === undefined ? "is missing" : `is ${JSON.stringify(value)}`;
    throw bad(`The machine profile "${name}" can't be used: ${at}${key} ${is}, and must be ${what}.`);
  }
}

const bad = (message: string): PlotwrightError =>
  new PlotwrightError("bad-setting", `${message} Begin with one of MACHINES and change what differs.`);
