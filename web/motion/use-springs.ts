import { findMachine, type Springs } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";

/** The chosen machine's measured swing; null: not measured. */
export const useSprings = (): Springs | null =>
  usePageState(({ settings }) => findMachine(settings)?.springs ?? null);
