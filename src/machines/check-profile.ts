/** Checks profiles written by hand in programs without types, which may lack required fields. */
import { checkObject } from "../check-arguments.js";
import { PlotwrightError } from "../errors.js";
import { isAllowed, rangeInWords } from "../settings/setting.js";
import type { ControllerField, ControllerFields } from "./controller.js";
import type { MachineProfile } from "./profile.js";

interface Need {
  readonly isRight: (value: unknown) => boolean;
  readonly what: string;
}
type Values = Readonly<Record<string, unknown>>;

const isObject = (value: unknown): value is Values => typeof value === "object" && value !== null;
const oneOf = (values: readonly unknown[]): Need => ({
  isRight: (value) => values.includes(value),
  what: values.map((value) => JSON.stringify(value)).join(" or "),
});

const ABOVE_0: Need = {
  isRight: (value) => Number.isFinite(value) && (value as number) > 0,
  what: "a number above 0",
};
const CONTROLLER_NAME: Need = {
  isRight: (value) => typeof value === "string" && value !== "",
  what: "the name of a controller",
};
const OBJECT: Need = { isRight: isObject, what: "an object" };

const PROFILE_NEEDS: Readonly<Record<string, Need>> = {
  widthMm: ABOVE_0,
  heightMm: ABOVE_0,
  stepsPerMm: ABOVE_0,
  motors: oneOf(["mixed", "direct"]),
};

/** @throws PlotwrightError "bad-setting" for the first field that is missing or invalid, except the controller's */
export function checkProfile(machine: MachineProfile): void {
  checkObject("machine", "the machine", machine, [], 'a profile, for example machineById("axidraw-v3")');
  const values = machine as unknown as Values;
  for (const [key, need] of Object.entries(PROFILE_NEEDS)) check(machine, key, need, values[key]);
  const { controller } = values;
  if (!isObject(controller)) {
    throw bad(
      `The machine profile "${nameOf(machine)}" has no controller: what drives its motors and its pen.`,
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
    if (field.kind === "group") {
      const isLeftOut = value === null || value === undefined;
      if (isLeftOut && field.isOptional) continue;
      check(machine, at + key, OBJECT, value);
      checkFields(machine, `${at}${key}.`, field.fields, value as Values);
    } else check(machine, at + key, needOf(field), value);
  }
}

function needOf(field: Exclude<ControllerField, { kind: "group" }>): Need {
  switch (field.kind) {
    case "one-of":
      return oneOf(field.values);
    case "choice":
      return oneOf(field.choices);
    case "switch":
      return oneOf([true, false]);
    case "number":
      return { isRight: (value) => isAllowed(field, value as number), what: rangeInWords(field) };
  }
}

function check(machine: MachineProfile, field: string, { isRight, what }: Need, value: unknown): void {
  if (isRight(value)) return;
  const is = value === undefined ? "is missing" : `is ${JSON.stringify(value)}`;
  throw bad(`The machine profile "${nameOf(machine)}" can't be used: ${field} ${is}, and must be ${what}.`);
}

const nameOf = ({ name, id }: MachineProfile): string => String(name ?? id ?? "without a name");

const bad = (message: string): PlotwrightError =>
  new PlotwrightError("bad-setting", `${message} Begin with one of MACHINES and change what differs.`);
