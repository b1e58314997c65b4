/** Which settings the chosen plotter uses: controls of the others are not shown. */
import { findMachine, usesSetting } from "../../src/internal.js";
import type { PageState } from "./store.js";
import { usePageState } from "./use-store.js";

/** `path`: such as "motion.layers.*.cornerMm". */
export const isUsed = ({ settings }: PageState, path: string): boolean => {
  const machine = findMachine(settings);
  return machine === null || usesSetting(machine, path);
};

export const useIsUsed = (path: string): boolean => usePageState((state) => isUsed(state, path));
