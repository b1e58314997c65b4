import { findMachine, type Springs } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";

/** How the chosen machine swings; null: it was not measured. */
export const useSprings = (): Springs | null =>
  usePageState(({ settings }) => findMachine(settings)?.springs ?? null);
