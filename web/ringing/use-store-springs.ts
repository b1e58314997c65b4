import { findMachine, type Springs } from "../../src/internal.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ringingText } from "./ringing-text.js";
import { MACHINES, type MachineProfile } from "../../src/index.js";
import { copyOf } from "../plotter/machines/profile.js";

/**
 * Stores the springs with the plotter's machine, and chooses that machine. False: it failed, and the user has seen
 * why.
 */
export const useStoreSprings = (): ((springs: Springs) => Promise<boolean>) => {
  const machine = usePageState(({ settings }) => findMachine(settings));
  const machines = usePageState((state) => state.machines);
  const { saveMachine } = useActions();
  return async (springs) => {
    if (machine === null) return false;
    const measured = measuredMachine(machine, springs, machines, ringingText.machineName);
    return (await saveMachine(measured)) !== null;
  };
};

/** Whether the machine has these springs. They are stored to a tenth of a Hz. */
export const isStored = (springs: Springs | null, known: Springs | null): boolean =>
  springs !== null &&
  known !== null &&
  Math.abs(springs.xHz - known.xHz) < 0.051 &&
  Math.abs(springs.yHz - known.yHz) < 0.051;

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
