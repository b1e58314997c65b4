/** Checks machine profiles, which may be written by hand in programs without types. */
import { checkObject } from "../check-arguments.js";
import { PlotwrightError } from "../errors.js";
import { isAllowed, rangeInWords } from "../settings/setting.js";
import type { ControllerField, ControllerFields, MachineProfile } from "./profile.js";

interface Rule {
  readonly isValid: (value: unknown) => boolean;
  /** Valid values, in words. */
  readonly allowed: string;
}
type Values = Readonly<Record<string, unknown>>;

const isObject = (value: unknown): value is Values => typeof value === "object" && value !== null;
const oneOf = (values: readonly unknown[]): Rule => ({
  isValid: (value) => values.includes(value),
  allowed: values.map((value) => JSON.stringify(value)).join(" or "),
});

const ABOVE_0: Rule = {
  isValid: (value) => Number.isFinite(value) && (value as number) > 0,
  allowed: "a number above 0",
};
const CONTROLLER_NAME: Rule = {
  isValid: (value) => typeof value === "string" && value !== "",
  allowed: "the name of a controller",
};
const OBJECT: Rule = { isValid: isObject, allowed: "an object" };

const PROFILE_RULES: Readonly<Record<string, Rule>> = {
  widthMm: ABOVE_0,
  heightMm: ABOVE_0,
  stepsPerMm: ABOVE_0,
  motors: oneOf(["mixed", "direct"]),
};

/** @throws PlotwrightError "bad-setting" for the first field that is missing or invalid, except the controller's */
export function checkProfile(machine: MachineProfile): void {
  checkObject("machine", "the machine", machine, [], 'a profile, for example machineById("axidraw-v3")');
  const values = machine as unknown as Values;
  for (const [key, rule] of Object.entries(PROFILE_RULES)) check(machine, key, rule, values[key]);
  const { controller } = values;
  if (!isObject(controller)) {
    throw bad(
      `The machine profile "${nameOf(machine)}" has no controller, which says how its motors and pen are driven.`,
    );
  }
  check(machine, "controller.kind", CONTROLLER_NAME, controller.kind);
}

/** @throws PlotwrightError "bad-setting" for the first field of the controller that is missing or invalid */
export const checkController = (machine: MachineProfile, fields: ControllerFields): void =>
  checkFields(machine, "controller.", fields, machine.controller);

function checkFields(machine: MachineProfile, at: string, fields: ControllerFields, values: Values): void {
  for (const [key, field] of Object.entries(fields)) {
    const value = values[key];
    const isLeftOut = value === null || value === undefined;
    if (isLeftOut && field.isOptional) continue;
    if (field.kind === "group") {
      check(machine, at + key, OBJECT, value);
      checkFields(machine, `${at}${key}.`, field.fields, value as Values);
    } else check(machine, at + key, ruleOf(field), value);
  }
}

function ruleOf(field: Exclude<ControllerField, { kind: "group" }>): Rule {
  switch (field.kind) {
    case "one-of":
      return oneOf(field.values);
    case "choice":
      return oneOf(field.choices);
    case "switch":
      return oneOf([true, false]);
    case "text":
      return {
        isValid: (value) => typeof value === "string" && value.length <= field.maxLength,
        allowed: `a text of at most ${field.maxLength} characters`,
      };
    case "number":
      return { isValid: (value) => isAllowed(field, value as number), allowed: rangeInWords(field) };
  }
}

function check(machine: MachineProfile, field: string, { isValid, allowed }: Rule, value: unknown): void {
  if (isValid(value)) return;
  const is = value === undefined ? "is missing" : `is ${JSON.stringify(value)}`;
  throw bad(
    `The machine profile "${nameOf(machine)}" can't be used: ${field} ${is}, and must be ${allowed}.`,
  );
}

const nameOf = ({ name, id }: MachineProfile): string => String(name ?? id ?? "without a name");

const bad = (message: string): PlotwrightError =>
  new PlotwrightError("bad-setting", `${message} Begin with one of MACHINES and change what differs.`);
