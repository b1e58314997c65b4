/**
 * Stores the user's changes of a plotter's values on the server, one request after the other. If the user declines to
 * take over from another browser, the values before the change are shown again.
 */
import { withPlotterPart, type PlotterSettings } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import type { PageState, PageStore } from "./store.js";
import type { AsOperator } from "./take-over.js";

/** While a slider is dragged, its value is stored a few times a second. */
const SAVE_MS = 250;

export type Shown = Pick<PageState, "settings" | "presets">;

export interface SyncParts {
  readonly store: PageStore;
  readonly backend: Pick<Backend, "plotters">;
  readonly asOperator: AsOperator;
  after(delayMs: number, callback: () => void): void;
  /** Shows the user what went wrong. */
  failed(error: unknown): void;
  /** Shows the plotter's values; `isStep`: as an undo step, otherwise the undo history is cleared. */
  show(values: Shown, isStep: boolean): void;
}

/** `onSettled` is called after each request, whether or not it succeeded. */
export const createPlotterSaver = (
  { store, backend, asOperator, after, failed, show }: SyncParts,
  onSettled: () => void,
) => {
  /** Changes by the user that are not sent to the server yet. */
  let unsent: { readonly id: string; readonly settings: PlotterSettings } | null = null;
  /** The settings before the first change that the server does not have yet. */
  let lastSaved: PlotterSettings | null = null;
  /** Counts how often the user has declined to take over. Changes made before that are dropped. */
  let refusals = 0;
  let isWaiting = false;
  let sendingCount = 0;
  let turn: Promise<void> = Promise.resolve();

  /** Sends requests one after the other, so that the last change wins. */
  const send = (request: () => Promise<unknown>): void => {
    sendingCount++;
    turn = turn
      .then(async () => {
        await request();
      })
      .catch(failed)
      .then(() => {
        sendingCount--;
        onSettled();
      });
  };

  const setMachine = async (id: string, machine: string): Promise<void> => {
    const saved = await asOperator(() => backend.plotters.patch(id, { machine }));
    if (saved === null) return;
    store.setState(({ plotters }) => ({
      plotters: plotters.map((plotter) => (plotter.id === id ? saved : plotter)),
    }));
  };

  /** False: another browser is the operator, and the user has not taken over. */
  const saveNow = async (id: string, settings: PlotterSettings): Promise<boolean> => {
    const saved = await asOperator(() => backend.plotters.saveSettings(id, settings));
    if (saved === null) return false;
    store.setState(({ plotterSettings }) => ({ plotterSettings: { ...plotterSettings, [id]: saved } }));
    return true;
  };

  const saveOrTakeBack = async (
    id: string,
    settings: PlotterSettings,
    refusalsBefore: number,
  ): Promise<void> => {
    if (refusalsBefore !== refusals || (await saveNow(id, settings))) return;
    refusals++;
    unsent = null;
    const { settings: now } = store.getState();
    if (lastSaved) show({ settings: withPlotterPart(now, lastSaved), presets: lastSaved.presets }, true);
  };

  return {
    /** Whether changes of this page are still being stored. */
    isBusy: (): boolean => unsent !== null || sendingCount > 0,
    /** Settings of the plotter that are not sent yet. */
    unsentOf: (id: string): PlotterSettings | null => (unsent?.id === id ? unsent.settings : null),
    sendMachine: (id: string, machine: string): void => send(() => setMachine(id, machine)),
    /** `before`: the values before the change. */
    saveSoon: (id: string, settings: PlotterSettings, before: PlotterSettings): void => {
      if (!unsent && sendingCount === 0) lastSaved = before;
      unsent = { id, settings };
      if (isWaiting) return;
      isWaiting = true;
      after(SAVE_MS, () => {
        isWaiting = false;
        const wanted = unsent;
        unsent = null;
        const refusalsBefore = refusals;
        if (wanted) send(() => saveOrTakeBack(wanted.id, wanted.settings, refusalsBefore));
      });
    },
  };
};
