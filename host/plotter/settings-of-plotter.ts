/**
 * The settings of a plotter, from which every job and every manual move starts: page, HTTP, command line, watched folder
 * and shared queue. What a caller gives is laid over them. Only the plotter's model can't be changed that way: another
 * model's size and servo would drive this plotter into its frame, or move the wrong servo.
 */
import { findMachine, machineOf, motionForSprings, withGiven } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  plotSettingsSchema,
  withPlotterPart,
  type GivenSettings,
  type PlotSettings,
  type PlotterSettings,
} from "../../src/schema/index.js";
import { parseWith } from "../parse-with.js";

/** Adds the profile when the settings name a custom machine. */
export type WithMachine = (settings: PlotSettings) => PlotSettings;

export interface SettingsOfPlotter {
  /** Its model, heights and pens; all other settings have their defaults. */
  readonly settings: PlotSettings;
  /** Whether its model is set. If not, the machine of its last job is used, or the default one. */
  readonly hasMachine: boolean;
  /** The id of its model, if that is a custom machine that was removed. Jobs made for it have a copy. */
  readonly removedMachine: string | null;
  /** Whether its heights and pens are set. */
  readonly hasPen: boolean;
}

export interface StoredOfPlotter {
  /** The id of its model; null if it was not set. */
  readonly machine: string | null;
  /** Heights, pens and presets; undefined if nothing was set. */
  readonly own: PlotterSettings | undefined;
  /** The settings of its last job, whose machine is used while the model is not set. */
  readonly last: PlotSettings | undefined;
}

export function settingsOfPlotter(
  { machine, own, last }: StoredOfPlotter,
  withMachine: WithMachine,
): SettingsOfPlotter {
  const named = machine === null ? null : withMachine({ ...DEFAULT_PLOT_SETTINGS, machine });
  // A custom machine may have been removed.
  const hasMachine = named !== null && findMachine(named) !== null;
  const choice = (hasMachine ? named : last) ?? DEFAULT_PLOT_SETTINGS;
  const settings = {
    ...DEFAULT_PLOT_SETTINGS,
    machine: choice.machine,
    customMachine: choice.customMachine,
    motion: motionFor(DEFAULT_PLOT_SETTINGS, choice),
  };
  const hasPen = own !== undefined;
  return {
    settings: hasPen ? withPlotterPart(settings, own) : settings,
    hasMachine,
    removedMachine: hasMachine ? null : machine,
    hasPen,
  };
}

/** Settings on a plotter's machine. */
export interface OnPlotter {
  readonly settings: PlotSettings;
  /** That the settings named another machine, in words; null if they did not. */
  readonly note: string | null;
}

/**
 * The settings that apply on a plotter, for what a caller gives.
 *
 * @param base what is given is laid over these; default: the plotter's
 */
export function settingsWith(
  plotter: SettingsOfPlotter,
  given: GivenSettings,
  withMachine: WithMachine,
  base = plotter.settings,
): OnPlotter {
  const whole = parseWith(plotSettingsSchema, withGiven(withMargins(base, given), given));
  const isUnshaped = given.motion?.mode === "scurve" && given.motion.shaper === undefined;
  // A motion has only one filter.
  const motion = isUnshaped ? { ...whole.motion, shaper: "none" as const } : whole.motion;
  return onPlottersMachine({ ...whole, motion }, plotter, withMachine);
}

/** Four margins that are given in part are the others' common margin. */
function withMargins(base: PlotSettings, { prepare }: GivenSettings): PlotSettings {
  if (!prepare?.margins || base.prepare.margins !== null) return base;
  const all = prepare.marginMm ?? base.prepare.marginMm;
  const margins = { topMm: all, rightMm: all, bottomMm: all, leftMm: all };
  return { ...base, prepare: { ...base.prepare, margins } };
}

/** The settings with the plotter's machine, whatever machine they name. Throws `bad-setting` for an unknown one. */
export function onPlottersMachine(
  settings: PlotSettings,
  plotter: SettingsOfPlotter,
  withMachine: WithMachine,
): OnPlotter {
  const wanted = withMachine(settings);
  if (wanted.machine === plotter.removedMachine) return { settings: wanted, note: null };
  const { machine, customMachine } = plotter.settings;
  if (wanted.machine !== machine) {
    const known = findMachine(wanted);
    // A misspelt name may have been meant to choose this plotter's model.
    if (known === null && !plotter.hasMachine) machineOf(wanted);
    const names = [known?.name ?? wanted.machine, machineOf(plotter.settings).name];
    const why = plotter.hasMachine
      ? "because that is the plotter's model"
      : "because the plotter's model is not set. Choose the model on the page, in Model and position, or on the command line with plotwright settings set machine, or by PATCH /plotters/:id";
    return {
      settings: { ...wanted, machine, customMachine, motion: motionFor(wanted, plotter.settings) },
      note: `Its settings are for the ${names[0]}. It is plotted as on the ${names[1]}, ${why}.`,
    };
  }
  // How the machine swings only affects the shaping, and the second ringing sheet tries several values.
  const springs = wanted.customMachine?.id === machine ? wanted.customMachine.springs : undefined;
  const profile =
    springs === undefined
      ? customMachine
      : plotSettingsSchema.shape.customMachine.parse({ ...machineOf(plotter.settings), springs });
  return { settings: { ...wanted, customMachine: profile }, note: null };
}

/** A job's settings after it has moved to another plotter: heights and pens that it had from its plotter are the new one's. */
export function movedSettings(
  settings: PlotSettings,
  { settings: from }: SettingsOfPlotter,
  { settings: to }: SettingsOfPlotter,
): PlotSettings {
  const own = Object.entries(settings.pen).filter(
    ([key, value]) => value !== from.pen[key as keyof typeof from.pen],
  );
  const pen = { ...to.pen, ...Object.fromEntries(own) };
  return withPlotterPart({ ...settings, pen }, { pen, pens: to.pens });
}

/** The motion of `settings` with the same quality on another machine. */
const motionFor = (settings: PlotSettings, machine: PlotSettings): PlotSettings["motion"] =>
  motionForSprings(
    settings.motion,
    findMachine(settings)?.springs ?? null,
    findMachine(machine)?.springs ?? null,
  );
