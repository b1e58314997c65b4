/**
 * A plotter that a running server has open. Commands for it work through that server, because only one program can use
 * the port. `--direct` insists on the port.
 */
import { realpathSync } from "node:fs";
import { PlotwrightError } from "../../../src/index.js";
import { machineProfileSchema, type Plotter } from "../../../src/schema/index.js";
import type { PlotterPort } from "../../../host/plotter/plotter-port.js";
import type { StoredOfPlotter, WithMachine } from "../../../host/plotter/settings-of-plotter.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { addressOfServer } from "../../storage/data-lock.js";
import { serverState, type ServerPlotter, type ServerState } from "./server-client.js";
import { serverClient, type ServerAccess, type ServerClient } from "../../../host/handle/server-client.js";
import { lastBegun, NOTHING_STORED } from "../stored-plotter.js";
import { settingsOver, type FoundSettings, type OptionValues } from "../settings-options.js";

export interface ServedPlotter {
  readonly access: ServerAccess;
  readonly client: ServerClient;
  readonly plotter: ServerPlotter;
  /** Its settings with the options of the command. */
  readonly settings: FoundSettings;
}

/** Null: no server uses the data folder, or it does not have the plotter. */
export async function servedPlotter(options: OptionValues): Promise<ServedPlotter | null> {
  const { data, device = "auto", direct, virtualSpeed } = options;
  // A virtual board that is asked for is this command's own.
  if (direct === true || device === "virtual" || virtualSpeed !== undefined) return null;
  const url = addressOfServer(typeof data === "string" ? data : defaultDataDir());
  if (url === null) return null;
  const access = { url, ...keyInEnvironment() };
  const state = await serverState(access);
  const plotter = device === "auto" ? state.plotters[0] : withDevice(state, String(device));
  if (plotter === undefined) return null;
  const settings = settingsOver(options, storedOf(state, plotter), machinesOf(state));
  return { access, client: serverClient(access), plotter, settings };
}

export function keyInEnvironment(): { readonly key?: string } {
  const { PLOTWRIGHT_KEY: key } = process.env;
  return key === undefined ? {} : { key };
}

/** By the port's path, also through a link such as /dev/serial/by-id/…, or by the name of plotter or board. */
function withDevice({ plotters }: ServerState, device: string): ServerPlotter | undefined {
  const port = realPath(device);
  return plotters.find(
    ({ id, name, boardName, device: its }) =>
      [id, name.toLowerCase(), boardName?.toLowerCase()].includes(device.toLowerCase()) ||
      (its !== null && realPath(its) === port),
  );
}

function realPath(path: string): string {
  try {
    return realpathSync(path);
  } catch {
    return path;
  }
}

interface Named {
  readonly id: string;
  readonly name: string;
}

/** The plotter that --plotter names, or the first one. */
export const plotterOf = <T extends Named>(plotters: readonly T[], wanted: unknown): T | undefined =>
  typeof wanted === "string" ? plotterNamed(plotters, wanted) : plotters[0];

/** The plotter with that id or name. Throws `bad-setting` with the names that there are. */
function plotterNamed<T extends Named>(plotters: readonly T[], wanted: string): T {
  const found =
    plotters.find(({ id }) => id === wanted) ??
    plotters.find(({ name }) => name === wanted) ??
    plotters.find(({ name }) => name.toLowerCase() === wanted.toLowerCase());
  if (found !== undefined) return found;
  const known = plotters.map(({ id, name }) => (id === name ? id : `${id} (${name})`)).join(", ");
  const all = known === "" ? "None is stored." : `There is ${known}.`;
  throw new PlotwrightError("bad-setting", `--plotter: there is no plotter ${wanted}. ${all}`);
}

/** What the server has stored of a plotter. */
export function storedOf(
  { plotterSettings, jobs }: ServerState,
  plotter: ServerPlotter | undefined,
): StoredOfPlotter {
  if (plotter === undefined) return NOTHING_STORED;
  return {
    machine: plotter.machine,
    own: plotterSettings[plotter.id],
    last: lastBegun(jobs, plotter.id)?.settings,
  };
}

/** Adds the profiles of the server's custom machines. */
export const machinesOf =
  ({ machines }: ServerState): WithMachine =>
  (settings) => {
    const custom = machines.find(({ id, builtIn }) => id === settings.machine && !builtIn);
    if (custom === undefined || settings.customMachine?.id === custom.id) return settings;
    return { ...settings, customMachine: machineProfileSchema.parse(custom) };
  };

/** What the commands by hand use of a plotter. */
export type HandPlotter = Pick<PlotterPort, "snapshot" | "pen" | "motorsOff" | "move" | "command">;

/** `cancel`: stops the current move. */
export async function throughServer(
  { client, plotter: { id } }: ServedPlotter,
  cancel: AbortSignal,
): Promise<HandPlotter> {
  const now = await client.plotters.get(id);
  cancel.addEventListener("abort", () => void client.plotters.stop(id).catch(() => undefined));
  return {
    snapshot: () => now,
    pen: async (target, settings) => void (await client.plotters.pen(id, { ...target, settings })),
    motorsOff: async () => void (await client.plotters.motorsOff(id)),
    command: (line) => client.console.command(id, { line }),
    move: async ({ kind, ...how }, settings) => {
      const move = client.moves[kind] as (id: string, body: object) => Promise<Plotter>;
      await move(id, { ...how, settings });
    },
  };
}
