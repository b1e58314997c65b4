/**
 * The plotters that the data folder has, with what is stored of them: asked from the server that uses the folder, or else
 * read from its database. So a name means the same with and without a server.
 */
import { existsSync } from "node:fs";
import { PlotwrightError, type MachineProfile } from "../../../src/index.js";
import { machineProfileSchema, type PlotterSettings } from "../../../src/schema/index.js";
import type { WithMachine } from "../../../host/plotter/settings-of-plotter.js";
import { addressOfServer } from "../../storage/data-lock.js";
import { MachineFiles } from "../../storage/machine-files.js";
import { findBoards } from "../../serial/find-boards.js";
import {
  dataDirOf,
  plotterSettingsFromOptions,
  settingsFromOptions,
  settingsOver,
  type FoundSettings,
  type OptionValues,
} from "../settings-options.js";
import {
  hasStore,
  plotterAt,
  plottersIn,
  withStore,
  NOTHING_STORED,
  type KnownPlotter,
} from "../stored-plotter.js";
import { serverState } from "./server-client.js";
import { serverClient, type ServerAccess } from "../../../host/handle/server-client.js";
import { keyInEnvironment, machinesOf, plotterOf, storedOf } from "./served-plotter.js";

export interface KnownPlotters {
  readonly plotters: readonly KnownPlotter[];
  /** Adds the profile of a server's custom machine. */
  readonly withMachine: WithMachine;
  saveSettings(id: string, settings: PlotterSettings): Promise<void>;
  saveMachine(id: string, machine: string): Promise<void>;
  /** The user's own machines. */
  readonly ownMachines: readonly MachineProfile[];
  storeMachine(machine: MachineProfile): Promise<void>;
}

/** The server of --url, or the one that uses the data folder; null: none runs. */
function accessFor(options: OptionValues): ServerAccess | null {
  const { url = addressOfServer(dataDirOf(options)), key } = options;
  if (typeof url !== "string") return null;
  return { url, ...(typeof key === "string" ? { key } : keyInEnvironment()) };
}

/** Makes the database if there is none yet. */
export async function withKnownPlotters<T>(
  options: OptionValues,
  use: (known: KnownPlotters) => Promise<T>,
): Promise<T> {
  const access = accessFor(options);
  if (access === null) {
    const files = new MachineFiles(dataDirOf(options));
    return withStore(dataDirOf(options), (store) =>
      use({
        plotters: plottersIn(store),
        withMachine: (settings) => settings,
        saveSettings: (id, settings) => Promise.resolve(store.savePlotterSettings(id, settings)),
        saveMachine: (id, machine) => {
          const row = store.plotters().find((one) => one.id === id);
          if (row !== undefined) store.savePlotter({ ...row, machine });
          return Promise.resolve();
        },
        ownMachines: files.list().filter(({ builtIn }) => !builtIn),
        storeMachine: (machine) => Promise.resolve(void files.save(machine)),
      }),
    );
  }
  const state = await serverState(access);
  const { plotters: client, machines } = serverClient(access);
  return use({
    plotters: state.plotters.map((plotter) => ({ ...plotter, stored: storedOf(state, plotter) })),
    withMachine: machinesOf(state),
    saveSettings: async (id, settings) => void (await client.saveSettings(id, settings)),
    saveMachine: async (id, machine) => void (await client.patch(id, { machine })),
    ownMachines: state.machines.filter(({ builtIn }) => !builtIn),
    storeMachine: async (machine) =>
      void (await machines.save(machine.id, machineProfileSchema.parse(machine))),
  });
}

/** With the plotter that --plotter names, or the first one. Nothing happens if there is none. */
export const withChosenPlotter = (
  options: OptionValues,
  use: (plotter: KnownPlotter, known: KnownPlotters) => Promise<void>,
): Promise<void> =>
  withKnownPlotters(options, async (known) => {
    const plotter = plotterOf(known.plotters, options["plotter"]);
    if (plotter !== undefined) await use(plotter, known);
  });

/** Without a server and a database there are none. */
export async function knownPlotters(
  options: OptionValues,
): Promise<Pick<KnownPlotters, "plotters" | "withMachine">> {
  const isNew = accessFor(options) === null && !hasStore(dataDirOf(options));
  if (isNew) return { plotters: [], withMachine: (settings) => settings };
  return withKnownPlotters(options, (known) => Promise.resolve(known));
}

/**
 * For a command that uses no plotter. With --plotter, the settings are those of that plotter; with --preset alone, those of
 * the first plotter that has a preset of that name.
 */
export async function settingsByPlotter(options: OptionValues): Promise<FoundSettings> {
  const { plotter, preset } = options;
  if (plotter === undefined && preset === undefined)
    return { settings: settingsFromOptions(options), note: null };
  const { plotters, withMachine } = await knownPlotters(options);
  const chosen =
    typeof plotter === "string"
      ? plotterOf(plotters, plotter)
      : (plotters.find((one) => hasPreset(one, String(preset))) ?? plotters[0]);
  return settingsOver(options, chosen?.stored ?? NOTHING_STORED, withMachine);
}

const hasPreset = ({ stored }: KnownPlotter, wanted: string): boolean =>
  stored.own?.presets.some(({ name }) => name.toLowerCase() === wanted.trim().toLowerCase()) ?? false;

/**
 * For a command that opens the plotter itself, as `plotterSettingsFromOptions`. A preset can be read beside a running server
 * too, by asking it.
 */
export async function settingsOfOwnPlotter(options: OptionValues): Promise<FoundSettings> {
  const { preset, device = "auto" } = options;
  if (preset === undefined || accessFor(options) === null) return plotterSettingsFromOptions(options);
  const { plotters, withMachine } = await knownPlotters(options);
  return settingsOver(options, plotterAt(plotters, String(device))?.stored ?? NOTHING_STORED, withMachine);
}

/**
 * The options with the port of the plotter that --device names: a plotter of the data folder, or a board by the name that it
 * gives itself on USB. Throws `no-board` if there is none.
 */
export async function withPortByName<T extends OptionValues>(options: T): Promise<T> {
  const { device } = options;
  if (typeof device !== "string" || isPort(device)) return options;
  const { plotters } = await knownPlotters(options);
  const isMeant = (name: string | null): boolean => name?.toLowerCase() === device.toLowerCase();
  const stored = plotters.find(({ id, name }) => isMeant(name) || isMeant(id))?.device;
  const port = stored ?? (await findBoards()).find(({ serialNumber }) => isMeant(serialNumber))?.path;
  if (port !== undefined) return { ...options, device: port };
  const known = plotters.map(({ name }) => name).join(", ");
  throw new PlotwrightError(
    "no-board",
    `--device ${device}: there is no such serial port, and no plotter with that name. ${known === "" ? "" : `Plotters: ${known}. `}"plotwright devices" lists the boards that are plugged in.`,
  );
}

const isPort = (device: string): boolean =>
  ["auto", "virtual"].includes(device) || /[\\/]|^COM\d+$/i.test(device) || existsSync(device);
