/** The plotter's machine with its measured springs: a custom machine, which the server stores. */
import { MACHINES, type MachineProfile } from "../../src/index.js";
import type { Springs } from "../../src/internal.js";
import { copyOf } from "../plotter/profile.js";

/** A built-in machine can't be changed, so the springs are stored with a copy of it. */
export const measuredMachine = (
  machine: MachineProfile,
  springs: Springs,
  made: readonly MachineProfile[],
  nameOf: (machine: string) => string,
): MachineProfile => {
  const rounded = { ...springs, xHz: tenth(springs.xHz), yHz: tenth(springs.yHz) };
  const isBuiltIn = MACHINES.some(({ id }) => id === machine.id);
  if (!isBuiltIn) return { ...machine, springs: rounded };
  return { ...copyOf(machine, nameOf(machine.name), made), springs: rounded };
};

/** The precision of counting ripples. */
const tenth = (hz: number): number => Math.round(10 * hz) / 10;
