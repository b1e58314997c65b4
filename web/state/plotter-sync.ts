/**
 * Keeps the page's model, heights, pens and presets in sync with the plotter's, which are on the server. The user's
 * changes are stored there. Changes by another screen are shown here, as an undo step. While the server can't be
 * reached, the page plans with the values it has; when the server is back, the plotter's values apply.
 */
import { MACHINES, type MachineProfile } from "../../src/index.js";
import { findMachine, motionForSprings, isSameJson } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  plotterPartOf,
  withPlotterPart,
  type Job,
  type PlotSettings,
  type Plotter,
  type PlotterSettings,
} from "../../src/schema/index.js";
import { createPlotterSaver, type Shown, type SyncParts } from "./plotter-saver.js";
import { ACTIVE_STATES, currentPlotter, mayOperate, type PageState } from "./store.js";

export const createPlotterSync = (parts: SyncParts) => {
  const { store, show } = parts;
  // After a failure, or if the user has not taken over, the plotter's values are shown again.
  const saver = createPlotterSaver(parts, () => follow());
  /** The plotter whose values the page shows. */
  let shownId: string | null = null;

  /** Called after a change by the user. Stores the part that belongs to the plotter. */
  const changed = (before: Shown): void => {
    const state = store.getState();
    const plotter = currentPlotter(state);
    if (!plotter || state.link !== "connected" || !mayOperate(state)) return;
    const { machine } = state.settings;
    if (machine !== before.settings.machine && machine !== plotter.machine) {
      saver.sendMachine(plotter.id, machine);
    }
    const [old, now] = [partOf(before), partOf(state)];
    if (isSameJson(old, now)) return;
    const stored = saver.unsentOf(plotter.id) ?? state.plotterSettings[plotter.id] ?? now;
    const settings = {
      pen: isSameJson(old.pen, now.pen) ? stored.pen : now.pen,
      pens: isSameJson(old.pens, now.pens) ? stored.pens : now.pens,
      presets: isSameJson(old.presets, now.presets) ? stored.presets : now.presets,
    };
    saver.saveSoon(plotter.id, settings, old);
  };

  /** Called when the user chooses the model that is shown already, because none was chosen before. */
  const confirmed = (machine: string): void => {
    const state = store.getState();
    const plotter = currentPlotter(state);
    if (plotter?.machine !== null || state.link !== "connected" || !mayOperate(state)) return;
    saver.sendMachine(plotter.id, machine);
  };

  /** Shows the plotter's values, unless changes by this page are still being stored. */
  const follow = (isStep = true): void => {
    const state = store.getState();
    const plotter = currentPlotter(state);
    if (!plotter || state.link !== "connected" || saver.isBusy()) return;
    const isOther = shownId !== null && shownId !== plotter.id;
    const isFirst = shownId !== plotter.id;
    // A running plot is shown with the settings that it is plotted with.
    if (!isOther && showsActiveJob(state)) return;
    shownId = plotter.id;
    const own = state.plotterSettings[plotter.id] ?? (isOther ? NOTHING_SET : null);
    const withModel = withMachine(state.settings, modelOf(state, plotter));
    const values = {
      settings: own ? withPlotterPart(withModel, own) : withModel,
      presets: own?.presets ?? state.presets,
    };
    if (!isSameJson(values, { settings: state.settings, presets: state.presets }))
      show(values, isStep && !isFirst);
  };

  return { changed, confirmed, follow };
};

/**
 * A job's settings as the page opens them. A running job keeps its own; another one gets the plotter's heights and
 * pens.
 */
export const openedSettings = (state: PageState, job: Job): PlotSettings => {
  const plotter = currentPlotter(state);
  const own = plotter && state.plotterSettings[plotter.id];
  if (!own || ACTIVE_STATES.includes(job.state)) return job.settings;
  return withPlotterPart(withMachine(job.settings, modelOf(state, plotter)), own);
};

/**
 * The settings for a machine. The profile of a custom machine is included. The quality stays the same, with this
 * machine's numbers.
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

/** The machine with this id; null: this server does not know it. */
export const profileOf = ({ machines }: PageState, id: string | null): MachineProfile | null =>
  [...MACHINES, ...machines].find((machine) => machine.id === id) ?? null;

/** A plotter whose model is not set counts as the default one. */
const modelOf = (state: PageState, { machine }: Plotter): MachineProfile | null =>
  profileOf(state, machine ?? DEFAULT_PLOT_SETTINGS.machine);

const showsActiveJob = ({ drawing, jobs }: PageState): boolean => {
  const job = jobs.find(({ id }) => id === drawing?.jobId);
  return job !== undefined && ACTIVE_STATES.includes(job.state);
};
