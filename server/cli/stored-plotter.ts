/** What a server has stored of a plotter, for commands that use the plotter without the server. */
import { existsSync } from "node:fs";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { plotterSettingsSchema } from "../../src/schema/index.js";
import type { StoredOfPlotter } from "../../host/plotter/settings-of-plotter.js";
import type { PlotterRow } from "../../host/storage.js";
import { Store } from "../storage/store.js";

/** Nothing is stored of the plotter. */
export const NOTHING_STORED: StoredOfPlotter = { machine: null, own: undefined, last: undefined };

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
  if (!existsSync(join(dataDir, "plotwright.db"))) return NOTHING_STORED;
  const store = openStore(dataDir, isOptional);
  if (store === null) return NOTHING_STORED;
  try {
    const row = rowOf(store.plotters(), device);
    if (row === undefined) return NOTHING_STORED;
    const [last] = store
      .jobs()
      .filter((job) => job.plotterId === row.id && job.startedAt !== null)
      .sort((a, b) => (b.startedAt ?? "").localeCompare(a.startedAt ?? ""));
    return {
      machine: row.machine,
      own: plotterSettingsSchema.safeParse(store.plotterSettings()[row.id]).data,
      last: last?.settings,
    };
  } finally {
    store.close();
  }
}

const rowOf = (rows: readonly PlotterRow[], device: string): PlotterRow | undefined =>
  rows.find((one) => one.device === device) ??
  rows.find((one) => one.device === "auto") ??
  (rows.length === 1 ? rows[0] : undefined);

/** Another command may read the database at this moment, which takes it a few tenths of a second. */
const ATTEMPTS = 6;
const PAUSE_MS = 200;

/** Null if a server runs, and its settings are not needed. */
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
