/** Opens a browser's host: the queue and the plotters, stored in IndexedDB. */
import { PlotwrightError } from "../../../src/index.js";
import { machineOf } from "../../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  type PlotSettings,
  type ServerEvent,
  type Snapshot,
} from "../../../src/schema/index.js";
import { version } from "../../../package.json";
import { CustomMachines } from "../../../host/custom-machines.js";
import { FIRST_PLOTTER, openNamedPlotter } from "../../../host/plotter/named-plotter.js";
import { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import { Notices } from "../../../host/queue/notices.js";
import type { DrawingText } from "../../worker/drawing-text.js";
import { browserClock } from "../../serial/web-serial.js";
import { Database } from "./database.js";
import { hostApi, type HostApi } from "./host-api.js";
import { DATABASE, type WorkerStart } from "./protocol.js";
import { serialDevices } from "./serial-devices.js";
import { StoredModel } from "./stored-model.js";
import { workerPlanning } from "./worker-planning.js";

const STOPPED =
  "The page was closed or reloaded while this was plotting. Check pen and paper, then continue from where it was.";
const NOT_STORED =
  "The browser can't store the queue: its storage for this site is full or blocked. Changes are in memory until there is room.";
const PROGRESS_MS = 100;

export interface Host {
  readonly api: HostApi;
  snapshot(): Snapshot;
  /** Resolves when all changes so far are stored. Rejects with a message for the user if that fails. */
  written(): Promise<void>;
  /** Stops a running plot, stores everything and releases the port. */
  close(): Promise<void>;
}

/** `send` gets every event once what it reports is stored, in order. */
export async function openHost(start: WorkerStart, send: (event: ServerEvent) => void): Promise<Host> {
  const nowIso = (): string => new Date().toISOString();
  let isFaultKnown = false;
  const db = await Database.open(DATABASE, () => {
    if (isFaultKnown) return;
    isFaultKnown = true;
    send({ type: "notice", notice: { id: "storage", at: nowIso(), message: NOT_STORED } });
  });
  const [jobs, plotterRows, settings, journals, machineRows] = await Promise.all([
    db.read("jobs"),
    db.read("plotters"),
    db.read("settings"),
    db.read("journals"),
    db.read("machines"),
  ]);
  const store = new StoredModel(db, { jobs, plotters: plotterRows, settings, journals });
  const announce = announcer(db, send);
  const machines = new CustomMachines(
    [...machineRows.values()].flatMap((row) => machineProfileSchema.safeParse(row).data ?? []),
    {
      save: (machine) => db.put("machines", machine.id, machine),
      remove: (id) => db.remove("machines", id),
    },
  );
  const withMachine = (wanted: PlotSettings): PlotSettings => machines.withMachine(wanted);
  const devices = serialDevices((navigator as { serial?: Serial }).serial);
  const clock = browserClock();
  const log = (): void => undefined;
  const registry = new PlotterRegistry({
    store,
    announce,
    findBoards: devices.findAll,
    mustBeMachine: (machine) => void machineOf(withMachine({ ...DEFAULT_PLOT_SETTINGS, machine })),
    firstId: FIRST_PLOTTER,
    open: (row, isTaken) =>
      openNamedPlotter(row, {
        virtualSpeed: start.virtualSpeed,
        isTaken,
        withMachine,
        log,
        clock,
        devices,
      }),
  });
  const drawings = {
    add: async (drawing: DrawingText): Promise<string> => {
      const id = crypto.randomUUID();
      db.put("drawings", id, drawing);
      await db.written();
      return id;
    },
    read: async (id: string): Promise<DrawingText> => {
      // A plot begins by reading its drawing. Waiting here makes sure that its new state is stored before.
      await db.written();
      const drawing = await db.readDrawing(id);
      if (typeof drawing === "string" || drawing instanceof ArrayBuffer) return drawing;
      throw new PlotwrightError("bad-file", "The browser no longer has this drawing. Add it again.");
    },
    remove: (id: string): Promise<void> => {
      db.remove("drawings", id);
      return db.written();
    },
  };
  const queue = new JobQueue({
    store,
    files: drawings,
    planning: workerPlanning(drawings.read),
    plotters: registry.ports,
    announce,
    nowIso,
    stoppedMessage: STOPPED,
  });
  const notices = new Notices({ store, announce, nowIso });
  if (store.unreadableCount > 0) {
    notices.add(`Jobs of another version of plotwright that can't be read: ${store.unreadableCount}.`);
  } else await removeUnused(db, store);
  return {
    api: hostApi({ queue, registry, notices, machines, drawings }),
    snapshot: () => ({
      version,
      plotters: registry.list(),
      plotterSettings: registry.settings(),
      queue: queue.settings(),
      queues: queue.allSettings(),
      operator: { id: start.tab, name: "Another tab" },
      serverNotices: notices.list(),
      localName: null,
      jobs: queue.list(),
    }),
    written: () =>
      db.written().catch((cause: unknown) => {
        throw new PlotwrightError("disk-full", NOT_STORED, { cause });
      }),
    close: async () => {
      await queue.close();
      await registry.close();
      await db.close();
    },
  };
}

/** Holds each event back until all changes before it are stored, and sends progress ten times a second. */
function announcer(db: Database, send: (event: ServerEvent) => void): (event: ServerEvent) => void {
  let last: Promise<void> = Promise.resolve();
  let progressAtMs = -Infinity;
  return (event) => {
    if (event.type === "progress") {
      if (performance.now() - progressAtMs < PROGRESS_MS) return;
      progressAtMs = performance.now();
    }
    // A change that can't be stored is announced too, with a notice: a plot must not become invisible.
    const stored = db.written().catch(() => undefined);
    last = last.then(() => stored).then(() => send(event));
  };
}

/** Drawings whose job was never added, because the page was closed before. */
async function removeUnused(db: Database, store: StoredModel): Promise<void> {
  for (const id of await db.drawingIds()) if (!store.isUsed(id)) db.remove("drawings", id);
}
