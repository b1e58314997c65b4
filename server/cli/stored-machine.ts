/** The machine that is set for a server's plotter, for commands that run without the server. */
import { existsSync } from "node:fs";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { Store } from "../storage/store.js";

/**
 * The machine of the plotter with that device, or else of the plotter that takes any board. Null if nothing is stored.
 * Throws `busy` while a server runs with that folder, since the wrong machine would drive the wrong servo.
 */
export function storedMachine(dataDir: string, device: string): string | null {
  if (!existsSync(join(dataDir, "plotwright.db"))) return null;
  const store = openStore(dataDir);
  try {
    const rows = store.plotters();
    const row = rows.find((one) => one.device === device) ?? rows.find((one) => one.device === "auto");
    if (row === undefined) return null;
    // A plotter without a set machine uses the machine of its last job.
    const [last] = store
      .jobs()
      .filter((job) => job.plotterId === row.id && job.startedAt !== null)
      .sort((a, b) => (b.startedAt ?? "").localeCompare(a.startedAt ?? ""));
    return row.machine ?? last?.settings.machine ?? null;
  } finally {
    store.close();
  }
}

function openStore(dataDir: string): Store {
  try {
    return Store.open(dataDir);
  } catch (cause) {
    if (!(cause instanceof PlotwrightError && cause.code === "conflict")) throw cause;
    throw new PlotwrightError(
      "busy",
      "A plotwright server is running: move the plotter from its page, or choose the machine with --machine.",
      { cause },
    );
  }
}
