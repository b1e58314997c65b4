/** Custom machines: new ones, and checking them by the schema. */
import type { MachineProfile } from "../../../src/index.js";
import { freeId, type EbbController } from "../../../src/internal.js";
import { faultInWords, machineProfileSchema } from "../../../src/schema/index.js";

export const copyOf = (
  profile: MachineProfile,
  name: string,
  made: readonly MachineProfile[],
): MachineProfile => ({
  ...machineProfileSchema.parse(profile),
  id: freeId(name, made),
  name,
});

/** A machine whose controller the form and the wizard can set up. */
export type EbbProfile = MachineProfile<EbbController>;

export const isEbbMachine = (profile: MachineProfile): profile is EbbProfile =>
  profile.controller.kind === "ebb";

/** The profile with some fields of its controller changed. */
export const withController = (profile: EbbProfile, part: Partial<EbbController>): EbbProfile => ({
  ...profile,
  controller: { ...profile.controller, ...part },
});

/** The errors in a profile as "field: message"; empty if it can be saved. */
export const problemsOf = (profile: unknown): readonly string[] => {
  const parsed = machineProfileSchema.safeParse(profile);
  if (parsed.success) return [];
  return parsed.error.issues.map((issue) =>
    [issue.path.join("."), faultInWords(issue)].filter(Boolean).join(": "),
  );
};

/** Parses a profile saved to a file. Throws an error with a message for the user. */
export const parseMachineFile = (content: string): MachineProfile => {
  const profile: unknown = JSON.parse(content);
  const problems = problemsOf(profile);
  if (problems.length > 0) throw new Error(problems.join("; "));
  return machineProfileSchema.parse(profile);
};

/** A profile as a file's text, without the fields of the machine list. */
export const fileOf = (profile: MachineProfile): string =>
  `${JSON.stringify(machineProfileSchema.parse(profile), null, 2)}\n`;
