/** Machines of the user's own: new ones, their ids, and what the schema says of them. */
import type { MachineProfile } from "../../src/index.js";
import type { EbbController } from "../../src/internal.js";
import { faultInWords, machineProfileSchema } from "../../src/schema/index.js";

const MAX_ID = 60;

/** An id that fits a file's name and that no other machine has: "My Plotter" -> "my-plotter", "my-plotter-2" … */
export const freeId = (name: string, taken: readonly string[]): string => {
  const plain = name
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, MAX_ID - 3);
  const base = plain === "" ? "plotter" : plain;
  let id = base;
  for (let n = 2; taken.includes(id); n++) id = `${base}-${n}`;
  return id;
};

export const copyOf = (profile: MachineProfile, name: string, taken: readonly string[]): MachineProfile => ({
  ...machineProfileSchema.parse(profile),
  id: freeId(name, taken),
  name,
});

/** What the form and the wizard can set up of a controller. */
export type EbbMachine = MachineProfile<EbbController>;

export const isEbbMachine = (profile: MachineProfile): profile is EbbMachine =>
  profile.controller.kind === "ebb";

/** The profile with parts of its controller changed. */
export const withController = (profile: EbbMachine, part: Partial<EbbController>): EbbMachine => ({
  ...profile,
  controller: { ...profile.controller, ...part },
});

/** What is wrong with a profile, "field: what"; empty where it can be saved. */
export const problemsOf = (profile: unknown): readonly string[] => {
  const parsed = machineProfileSchema.safeParse(profile);
  if (parsed.success) return [];
  return parsed.error.issues.map((issue) =>
    [issue.path.join("."), faultInWords(issue)].filter(Boolean).join(": "),
  );
};

/** A profile as it was saved to a file, here or elsewhere. Throws with words for the user. */
export const parseMachineFile = (content: string): MachineProfile => {
  const profile: unknown = JSON.parse(content);
  const problems = problemsOf(profile);
  if (problems.length > 0) throw new Error(problems.join("; "));
  return machineProfileSchema.parse(profile);
};

/** A profile as a file's text, without what only a list of machines has. */
export const fileOf = (profile: MachineProfile): string =>
  `${JSON.stringify(machineProfileSchema.parse(profile), null, 2)}\n`;
