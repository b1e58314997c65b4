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
import { Database, type DatabaseEvents, type Records } from "./database.js";
import { hasLocks } from "./capabilities.js";
import { hostApi, type HostApi } from "./host-api.js";
import { MemoryRecords } from "./memory-records.js";
import { DATABASE, type WorkerStart } from "./protocol.js";
import { serialDevices } from "./serial-devices.js";
import { StoredModel } from "./stored-model.js";
import { browserText } from "./text.js";
import { workerPlanning } from "./worker-planning.js";

const STOPPED =
  "The page was closed or reloaded while this was plotting. Check pen and paper, then continue from where it was.";
const PROGRESS_MS = 100;
/** The system gives the process of a hidden tab less time, so timers may be this late. */
const HIDDEN_LATENESS_S = 0.7;

export interface Host {
  readonly api: HostApi;
  snapshot(): Snapshot;
  /** Resolves when all changes so far are stored. Rejects with a message for the user if that fails. */
  written(): Promise<void>;
  /** Stops a running plot, stores everything and releases the port. */
  close(): Promise<void>;
}

interface HostPage {
  /** Called with every event, in order, after the change that it reports is stored. */
  send(event: ServerEvent): void;
  isPageHidden(): boolean;
}

export async function openHost(start: WorkerStart, page: HostPage): Promise<Host> {
  const nowIso = (): string => new Date().toISOString();
  let onFault = (_error: unknown): void => undefined;
  let onWritten = (): void => undefined;
  const db = await openRecords({ onFault: (error) => onFault(error), onWritten: () => onWritten() });
  const [jobs, plotterRows, settings, journals, machineRows] = await Promise.all([
    db.read("jobs"),
    db.read("plotters"),
    db.read("settings"),
    db.read("journals"),
    db.read("machines"),
  ]);
  const store = new StoredModel(db, { jobs, plotters: plotterRows, settings, journals });
  const announce = announcer(db, (event) => page.send(event));
  const machines = new CustomMachines(
    [...machineRows.values()].flatMap((row) => machineProfileSchema.safeParse(row).data ?? []),
    {
      save: (machine) => db.put("machines", machine.id, machine),
      remove: (id) => db.remove("machines", id),
    },
  );
  const withMachine = (wanted: PlotSettings): PlotSettings => machines.withMachine(wanted);
  const devices = serialDevices((navigator as { serial?: Serial }).serial);
  const clock = { ...browserClock(), latenessS: () => (page.isPageHidden() ? HIDDEN_LATENESS_S : 0) };
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
  const drawings = drawingRecords(db);
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
  let faultId: string | null = null;
  onFault = (error) => (faultId ??= notices.add(browserText.onlyHere(reasonOf(error))));
  onWritten = () => {
    const id = faultId;
    faultId = null;
    if (notices.list().some((notice) => notice.id === id)) notices.remove(String(id));
  };
  // On an insecure page the plotter's panel already says so.
  if (db instanceof MemoryRecords && hasLocks()) notices.add(browserText.nothingStored);
  if (store.unreadableCount > 0) {
    notices.add(
      `Jobs that can't be read, because another version of plotwright stored them: ${store.unreadableCount}.`,
    );
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
        throw new PlotwrightError("disk-full", browserText.onlyHere(reasonOf(cause)), { cause });
      }),
    close: async () => {
      await queue.close();
      await registry.close();
      await db.close();
    },
  };
}

/** Tabs that can't agree on one host must not share records. */
const openRecords = async (events: DatabaseEvents): Promise<Records> => {
  if (!hasLocks()) return new MemoryRecords();
  return Database.open(DATABASE, events).catch(() => new MemoryRecords());
};

const reasonOf = (error: unknown): string => {
  if (error instanceof DOMException && error.name === "QuotaExceededError") return browserText.full;
  return error instanceof Error ? error.message : String(error);
};

/** Holds each event back until all changes before it are stored, and sends progress ten times a second. */
function announcer(db: Records, send: (event: ServerEvent) => void): (event: ServerEvent) => void {
  let last: Promise<void> = Promise.resolve();
  let progressAtMs = -Infinity;
  return (event) => {
    if (event.type === "progress") {
      if (performance.now() - progressAtMs < PROGRESS_MS) return;
      progressAtMs = performance.now();
    }
    // A change that can't be stored is announced too: the page must always show a running plot. A notice reports the
    // fault.
    const stored = db.written().catch(() => undefined);
    last = last.then(() => stored).then(() => send(event));
  };
}

/** Drawings by id. */
const drawingRecords = (db: Records) => ({
  add: async (drawing: DrawingText): Promise<string> => {
    const id = crypto.randomUUID();
    db.put("drawings", id, drawing);
    await db.written().catch((cause: unknown) => {
      // A large drawing must not prevent later, smaller changes from being stored.
      db.remove("drawings", id);
      throw new PlotwrightError("disk-full", browserText.notAdded(reasonOf(cause)), { cause });
    });
    return id;
  },
  read: async (id: string): Promise<DrawingText> => {
    // A plot begins by reading its drawing. Waiting here ensures that the plot's new state is stored first.
    await db.written();
    const drawing = await db.readDrawing(id);
    if (typeof drawing === "string" || drawing instanceof ArrayBuffer) return drawing;
    throw new PlotwrightError("bad-file", "The browser no longer has this drawing. Add it again.");
  },
  remove: (id: string): Promise<void> => {
    db.remove("drawings", id);
    return db.written();
  },
});

/** Removes drawings whose job was never added because the page was closed first. */
async function removeUnused(db: Records, store: StoredModel): Promise<void> {
  for (const id of await db.drawingIds()) if (!store.isUsed(id)) db.remove("drawings", id);
}
