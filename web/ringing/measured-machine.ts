/** The plotter's machine with its measured springs: a machine of the user's own, which the server stores. */
import { MACHINES, type MachineProfile } from "../../src/index.js";
import type { Springs } from "../../src/internal.js";
import { copyOf } from "../plotter/profile.js";

/** The machines that come with plotwright cannot be changed: theirs is stored as a copy. */
export const measuredMachine = (
  machine: MachineProfile,
  springs: Springs,
  made: readonly MachineProfile[],
  nameOf: (machine: string) => string,
): MachineProfile => {
  const rounded = { ...springs, xHz: tenth(springs.xHz), yHz: tenth(springs.yHz) };
  const isBuiltIn = MACHINES.some(({ id }) => id === machine.id);
  if (!isBuiltIn) return { ...machine, springs: rounded };
  const taken = [...MACHINES, ...made].map(({ id }) => id);
  return { ...copyOf(machine, nameOf(machine.name), taken), springs: rounded };
};

/** What a count of ripples can tell. */
const tenth = (hz: number): number => Math.round(10 * hz) / 10;
