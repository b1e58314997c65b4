/**
 * Model, heights, pens and presets that an earlier version stored in this browser. They are copied once, to plotters
 * that have none on the server. The browser's copy is not deleted.
 */
import { plotterPartOf } from "../../src/schema/index.js";
import { PAGE_KEY, readRemembered, type TextStore } from "./persist.js";
import type { KeptHere } from "./plotter-sync.js";
import { PRESETS_KEY, readPresets } from "./presets.js";

const DONE_KEY = "plotwright.taken-over.v1";

/** Null if nothing was stored, or if it was copied before. */
export const readKeptHere = (store: TextStore | null): KeptHere | null => {
  try {
    if (store === null || store.getItem(DONE_KEY) !== null) return null;
    if (store.getItem(PAGE_KEY) === null && store.getItem(PRESETS_KEY) === null) return null;
  } catch {
    return null;
  }
  const { settings } = readRemembered(store);
  return {
    machine: settings.machine,
    settings: { ...plotterPartOf(settings), presets: readPresets(store) },
  };
};

export const noteTakenOver = (store: TextStore | null): void => {
  try {
    store?.setItem(DONE_KEY, new Date().toISOString());
  } catch {
    // If the browser refuses to store this, it has not stored the settings either.
  }
};
