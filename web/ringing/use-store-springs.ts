import { findMachine, measuredMachine, type Springs } from "../../src/internal.js";
import { useActions, usePageState } from "../state/use-store.js";

/**
 * Stores the springs with the plotter's machine, and chooses that machine. False: it failed, and the user has seen
 * why.
 */
export const useStoreSprings = (): ((springs: Springs) => Promise<boolean>) => {
  const machine = usePageState(({ settings }) => findMachine(settings));
  const machines = usePageState((state) => state.machines);
  const { saveMachine } = useActions();
  return async (springs) =>
    machine !== null && (await saveMachine(measuredMachine(machine, springs, machines))) !== null;
};

/** Whether the machine has these springs. They are stored to a tenth of a Hz. */
export const isStored = (springs: Springs | null, known: Springs | null): boolean =>
  springs !== null &&
  known !== null &&
  Math.abs(springs.xHz - known.xHz) < 0.051 &&
  Math.abs(springs.yHz - known.yHz) < 0.051 &&
  springs.damping === known.damping;
