/**
 * Keeps the page's model, heights, pens and presets the same as the plotter's, which are on the server: what the user
 * changes here is stored there, and what another screen changes there is shown here, as a step that can be undone.
 * Without the server the page plans with the values it has; when the server is back, the plotter's values apply.
 */
import { MACHINES, type MachineProfile } from "../../src/index.js";
import { findMachine } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  plotterPartOf,
  withPlotterPart,
  type Job,
  type PlotSettings,
  type PlotterSettings,
} from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import { motionForSprings } from "./motion-of-machine.js";
import {
  ACTIVE_STATES,
  currentPlotter,
  mayOperate,
  otherOperator,
  type PageState,
  type PageStore,
} from "./store.js";
import type { AsOperator } from "./take-over.js";

/** A slider's way is stored a few times a second. */
const SAVE_MS = 250;

type Shown = Pick<PageState, "settings" | "presets">;

interface SyncParts {
  readonly store: PageStore;
  readonly backend: Pick<Backend, "savePlotterSettings" | "setPlotterMachine">;
  readonly asOperator: AsOperator;
  after(delayMs: number, callback: () => void): void;
  /** Tells the user what went wrong. */
  failed(error: unknown): void;
  /** Shows the plotter's values; `isStep`: as a step of undo, else undo forgets what was before. */
  show(values: Shown, isStep: boolean): void;
}

export const createPlotterSync = ({ store, backend, asOperator, after, failed, show }: SyncParts) => {
  /** What the user has changed here and the server does not have yet. */
  let unsaved: { readonly id: string; readonly settings: PlotterSettings } | null = null;
  /** As it was before the first change that the server does not have yet. */
  let lastSaved: PlotterSettings | null = null;
  /** Rises when the user leaves another browser operating: changes of before that are dropped. */
  let refusals = 0;
  let isWaiting = false;
  let sendingCount = 0;
  let turn: Promise<void> = Promise.resolve();
  /** The plotter whose values the page shows. */
  let shownId: string | null = null;

  /** One after the other, so that the last change is the one that stays. */
  const send = (request: () => Promise<unknown>): void => {
    sendingCount++;
    turn = turn
      .then(async () => {
        await request();
      })
      .catch(failed)
      .then(() => {
        sendingCount--;
        // After a failure, or where another browser goes on operating, the plotter's values are shown again.
        follow();
      });
  };

  const setMachine = async (id: string, machine: string): Promise<void> => {
    const saved = await asOperator(() => backend.setPlotterMachine(id, machine));
    if (saved === null) return;
    store.setState(({ plotters }) => ({
      plotters: plotters.map((plotter) => (plotter.id === id ? saved : plotter)),
    }));
  };

  /** False where another browser goes on operating. */
  const saveNow = async (id: string, settings: PlotterSettings): Promise<boolean> => {
    const saved = await asOperator(() => backend.savePlotterSettings(id, settings));
    if (saved === null) return false;
    store.setState(({ plotterSettings }) => ({ plotterSettings: { ...plotterSettings, [id]: saved } }));
    return true;
  };

  const saveOrTakeBack = async (id: string, settings: PlotterSettings, turnOf: number): Promise<void> => {
    if (turnOf !== refusals || (await saveNow(id, settings))) return;
    refusals++;
    unsaved = null;
    const { settings: now } = store.getState();
    if (lastSaved) show({ settings: withPlotterPart(now, lastSaved), presets: lastSaved.presets }, true);
  };

  const saveSoon = (): void => {
    if (isWaiting) return;
    isWaiting = true;
    after(SAVE_MS, () => {
      isWaiting = false;
      const wanted = unsaved;
      unsaved = null;
      const turnOf = refusals;
      if (wanted) send(() => saveOrTakeBack(wanted.id, wanted.settings, turnOf));
    });
  };

  /** The user has changed something: stores what of it belongs to the plotter. */
  const changed = (before: Shown): void => {
    const state = store.getState();
    const plotter = currentPlotter(state);
    if (!plotter || state.link !== "connected" || !mayOperate(state)) return;
    const { machine } = state.settings;
    if (machine !== before.settings.machine && machine !== plotter.machine) {
      send(() => setMachine(plotter.id, machine));
    }
    const [old, now] = [partOf(before), partOf(state)];
    if (isSame(old, now)) return;
    const stored = (unsaved?.id === plotter.id ? unsaved.settings : state.plotterSettings[plotter.id]) ?? now;
    const settings = {
      pen: isSame(old.pen, now.pen) ? stored.pen : now.pen,
      pens: isSame(old.pens, now.pens) ? stored.pens : now.pens,
      presets: isSame(old.presets, now.presets) ? stored.presets : now.presets,
    };
    if (!unsaved && sendingCount === 0) lastSaved = old;
    unsaved = { id: plotter.id, settings };
    saveSoon();
  };

  /** Shows what the plotter has, unless something of this page is on its way there. */
  const follow = (isStep = true): void => {
    const state = store.getState();
    const plotter = currentPlotter(state);
    if (!plotter || state.link !== "connected" || unsaved || sendingCount > 0) return;
    const isOther = shownId !== null && shownId !== plotter.id;
    const isFirst = shownId !== plotter.id;
    // A plot that is under way is shown with the settings that it is plotted with.
    if (!isOther && showsActiveJob(state)) return;
    shownId = plotter.id;
    const own = state.plotterSettings[plotter.id] ?? (isOther ? NOTHING_SET : null);
    const withModel = withMachine(state.settings, profileOf(state, plotter.machine));
    const values = {
      settings: own ? withPlotterPart(withModel, own) : withModel,
      presets: own?.presets ?? state.presets,
    };
    if (!isSame(values, { settings: state.settings, presets: state.presets }))
      show(values, isStep && !isFirst);
  };

  /** Heights, pens and presets that this browser has kept go to each plotter that has none. True once that is settled. */
  const takeOver = async (kept: KeptHere): Promise<boolean> => {
    const state = store.getState();
    if (state.me === null || !mayOperate(state) || otherOperator(state) !== null) return false;
    try {
      for (const { id, machine } of state.plotters) {
        if (state.plotterSettings[id] !== undefined) continue;
        if (!(await saveNow(id, kept.settings))) return false;
        if (machine === null) await setMachine(id, kept.machine);
      }
      return true;
    } catch (error) {
      failed(error);
      return false;
    }
  };

  return { changed, follow, takeOver };
};

/** What a browser has kept by itself, before the server kept it. */
export interface KeptHere {
  readonly machine: string;
  readonly settings: PlotterSettings;
}

/** A job's settings as the page opens them: those of a plot under way as they are, any other with the plotter's part. */
export const openedSettings = (state: PageState, job: Job): PlotSettings => {
  const plotter = currentPlotter(state);
  const own = plotter && state.plotterSettings[plotter.id];
  if (!own || ACTIVE_STATES.includes(job.state)) return job.settings;
  return withPlotterPart(withMachine(job.settings, profileOf(state, plotter.machine)), own);
};

/**
 * The settings for a machine: its whole profile goes with them where plotwright does not know it by itself. A step of
 * quality stays the same step, with this machine's numbers.
 */
export const withMachine = (settings: PlotSettings, profile: MachineProfile | null): PlotSettings => {
  if (profile === null) return settings;
  const isKnown = MACHINES.some(({ id }) => id === profile.id);
  const springs = findMachine(settings)?.springs ?? null;
  return {
    ...settings,
    machine: profile.id,
    motion: motionForSprings(settings.motion, springs, profile.springs ?? null),
    customMachine: isKnown ? null : machineProfileSchema.parse(profile),
  };
};

const NOTHING_SET: PlotterSettings = { ...plotterPartOf(DEFAULT_PLOT_SETTINGS), presets: [] };

const partOf = ({ settings, presets }: Shown): PlotterSettings => ({
  ...plotterPartOf(settings),
  presets: [...presets],
});

const isSame = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

const profileOf = ({ machines }: PageState, id: string | null): MachineProfile | null =>
  [...MACHINES, ...machines].find((machine) => machine.id === id) ?? null;

const showsActiveJob = ({ drawing, jobs }: PageState): boolean => {
  const job = jobs.find(({ id }) => id === drawing?.jobId);
  return job !== undefined && ACTIVE_STATES.includes(job.state);
};
