/** What is stored in the data folder of plotters, for commands that use it without a server. */
import { existsSync } from "node:fs";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { plotterSettingsSchema, type Job } from "../../src/schema/index.js";
import { FIRST_PLOTTER } from "../../host/plotter/named-plotter.js";
import type { StoredOfPlotter } from "../../host/plotter/settings-of-plotter.js";
import { prepareDataDir } from "../storage/data-dir.js";
import { Store } from "../storage/store.js";

/** Nothing is stored of the plotter. */
export const NOTHING_STORED: StoredOfPlotter = { machine: null, own: undefined, last: undefined };

/** A plotter of a server, or of its data folder. */
export interface KnownPlotter {
  readonly id: string;
  readonly name: string;
  /** Null: a server does not have it connected. */
  readonly device: string | null;
  readonly stored: StoredOfPlotter;
}

interface StoredChoice {
  readonly dataDir: string;
  /** As given by --device. */
  readonly device: string;
  /** Without the stored settings, defaults apply: for a plotter whose model is given, and for the virtual one. */
  readonly isOptional: boolean;
}

/**
 * The plotter with that device, or else the one that takes any board, or else the only one. Throws `busy` while a server
 * runs with that folder, since the wrong machine would drive the wrong servo.
 */
export function storedPlotter({ dataDir, device, isOptional }: StoredChoice): StoredOfPlotter {
  if (!hasStore(dataDir)) return NOTHING_STORED;
  const store = openStore(dataDir, isOptional);
  if (store === null) return NOTHING_STORED;
  try {
    return plotterAt(plottersIn(store), device)?.stored ?? NOTHING_STORED;
  } finally {
    store.close();
  }
}

export const plotterAt = (plotters: readonly KnownPlotter[], device: string): KnownPlotter | undefined =>
  plotters.find((one) => one.device === device) ??
  plotters.find((one) => one.device === "auto") ??
  (plotters.length === 1 ? plotters[0] : undefined);

export const hasStore = (dataDir: string): boolean => existsSync(join(dataDir, "plotwright.db"));

/**
 * Uses the database of the data folder. A new one has one plotter, as a server's has. Throws `busy` while a server runs.
 */
export async function withStore<T>(dataDir: string, use: (store: Store) => T | Promise<T>): Promise<T> {
  prepareDataDir(dataDir);
  const store = openStore(dataDir, false);
  try {
    if (store.plotters().length === 0) {
      store.savePlotter({ id: FIRST_PLOTTER, name: null, device: "auto", machine: null });
    }
    return await use(store);
  } finally {
    store.close();
  }
}

/** The plotter's job that was begun last. */
export const lastBegun = (jobs: readonly Job[], plotterId: string): Job | undefined =>
  jobs
    .filter((job) => job.plotterId === plotterId && job.startedAt !== null)
    .sort((a, b) => (b.startedAt ?? "").localeCompare(a.startedAt ?? ""))[0];

export function plottersIn(store: Store): KnownPlotter[] {
  const settings = store.plotterSettings();
  const jobs = store.jobs();
  return store.plotters().map(({ id, name, device, machine }) => ({
    id,
    name: name ?? id,
    device,
    stored: {
      machine,
      own: plotterSettingsSchema.safeParse(settings[id]).data,
      last: lastBegun(jobs, id)?.settings,
    },
  }));
}

/** Another command may read the database at this moment, which takes it a few tenths of a second. */
const ATTEMPTS = 6;
const PAUSE_MS = 200;

/** Null if a server runs, and its settings are not needed. */
function openStore(dataDir: string, isOptional: false): Store;
function openStore(dataDir: string, isOptional: boolean): Store | null;
function openStore(dataDir: string, isOptional: boolean): Store | null {
  for (let attempt = 1; ; attempt++) {
    try {
      return Store.open(dataDir);
    } catch (cause) {
      if (!(cause instanceof PlotwrightError && cause.code === "conflict")) throw cause;
      if (attempt === ATTEMPTS && isOptional) return null;
      if (attempt === ATTEMPTS) throw serverRuns(cause);
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, PAUSE_MS);
    }
  }
}

const serverRuns = (cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "busy",
    "A plotwright server is running: use the plotter from its page or with plotwright add, or choose the machine with --machine.",
    { cause },
  );
