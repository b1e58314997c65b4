/** Opens a browser's host: the queue and the plotters, stored in IndexedDB. */
import { PlotwrightError } from "../../../src/index.js";
import {
  machineProfileSchema,
  type LiveBegin,
  type OperationHandlers,
  type PlotSettings,
  type ServerEvent,
  type Snapshot,
} from "../../../src/schema/index.js";
import { version } from "../../../package.json";
import { CustomMachines } from "../../../host/custom-machines.js";
import { FIRST_PLOTTER, openNamedPlotter } from "../../../host/plotter/named-plotter.js";
import type { Requester } from "../../../host/planning/lane.js";
import { askPorts } from "../../../host/plotter/ask-ports.js";
import { OtherBoards } from "../../../host/plotter/other-board.js";
import { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import type { LiveJob } from "../../../host/queue/live-jobs.js";
import { Notices } from "../../../host/queue/notices.js";
import { UploadedDrawings } from "../../../host/queue/uploaded-drawings.js";
import { browserClock } from "../../serial/web-serial.js";
import { hasLocks } from "./capabilities.js";
import { Database, type DatabaseEvents, type Records } from "./database.js";
import { drawingRecords, storageReason, MemoryRecords } from "./drawing-records.js";
import { browserOperations, ownMethods, type OwnMethods } from "./host-api.js";
import { DATABASE, type WorkerStart } from "./protocol.js";
import { serialDevices } from "./serial-devices.js";
import { StoredModel } from "./stored-model.js";
import { browserText } from "./text.js";
import { workerPlanning } from "./worker-planning.js";
import { LimitedProgress } from "../../../host/limited-progress.js";

const STOPPED =
  "The page was closed or reloaded while this was plotting. Check pen and paper, then resume where it stopped.";
/** Browsers throttle hidden tabs: timers may fire this late. */
const HIDDEN_LATENESS_S = 0.7;

export interface Host {
  readonly operations: OperationHandlers<Requester>;
  readonly own: OwnMethods;
  beginLive(plotterId: string, wanted: LiveBegin): Promise<LiveJob>;
  /** Whether the job is on a plotter now. */
  isRunning(jobId: string): boolean;
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
  let onCleared = (): void => undefined;
  const db = await openRecords({
    onFault: (error) => onFault(error),
    onWritten: () => onWritten(),
    onCleared: () => onCleared(),
  });
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
    announce,
  );
  const withMachine = (wanted: PlotSettings): PlotSettings => machines.withMachine(wanted);
  const devices = serialDevices((navigator as { serial?: Serial }).serial);
  const clock = { ...browserClock(), latenessS: () => (page.isPageHidden() ? HIDDEN_LATENESS_S : 0) };
  const log = (): void => undefined;
  const registry = new PlotterRegistry({
    store,
    announce,
    findBoards: devices.findAll,
    askPorts: (isTaken) => askPorts({ devices, clock }, isTaken),
    withMachine,
    firstId: FIRST_PLOTTER,
    open: (row, isTaken, settings) =>
      openNamedPlotter(row, {
        virtualSpeed: start.virtualSpeed,
        isTaken,
        settings,
        log,
        clock,
        devices,
        otherBoards: new OtherBoards({ devices, clock }, isTaken),
      }),
  });
  const drawings = drawingRecords(db);
  const queue = new JobQueue({
    store,
    files: drawings,
    planning: workerPlanning(drawings.read),
    plotters: registry.ports,
    settingsOf: (id, last) => registry.settingsOf(id, last),
    withMachine,
    announce,
    nowIso,
    stoppedMessage: STOPPED,
  });
  const uploads = new UploadedDrawings(drawings, log);
  const notices = new Notices({ store, announce, nowIso });
  let faultId: string | null = null;
  onFault = (error) => (faultId ??= notices.add(browserText.onlyHere(storageReason(error))));
  onWritten = () => {
    const id = faultId;
    faultId = null;
    if (notices.list().some((notice) => notice.id === id)) notices.remove(String(id));
  };
  onCleared = () => void notices.add(browserText.cleared);
  // On an insecure page the plotter's panel already says so.
  if (db instanceof MemoryRecords && hasLocks()) notices.add(browserText.nothingStored);
  if (store.unreadableCount > 0) {
    notices.add(
      `Jobs that can't be read, because another version of plotwright stored them: ${store.unreadableCount}.`,
    );
  } else await removeUnused(db, store);
  return {
    operations: browserOperations({ queue, registry, notices, machines, uploads, drawings }),
    own: ownMethods({ queue, registry }),
    beginLive: (id, wanted) => queue.live.begin(id, wanted),
    isRunning: (id) => queue.isRunning(id),
    snapshot: () => ({
      version,
      plotters: registry.list(),
      plotterSettings: registry.settings(),
      queue: queue.settings(),
      queues: queue.allSettings(),
      operator: { id: start.tab, name: "Another tab" },
      serverNotices: notices.list(),
      localName: null,
      machines: machines.list(),
      ...queue.recent(),
    }),
    written: () =>
      db.written().catch((cause: unknown) => {
        throw new PlotwrightError("disk-full", browserText.onlyHere(storageReason(cause)), { cause });
      }),
    close: async () => {
      await uploads.close();
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

/** Removes drawings whose job was never added because the page was closed first. */
async function removeUnused(db: Records, store: StoredModel): Promise<void> {
  for (const id of await db.drawingIds()) if (!store.isUsed(id)) db.remove("drawings", id);
}

/** Announces the changes of a browser's host. Each event is held back until all changes before it are stored. */
export function announcer(
  db: Pick<Records, "written">,
  send: (event: ServerEvent) => void,
): (event: ServerEvent) => void {
  let last: Promise<void> = Promise.resolve();
  const events = new LimitedProgress((event) => {
    // A change that can't be stored is announced too: the page must always show a running plot. A notice reports the
    // fault.
    const stored = db.written().catch(() => undefined);
    last = last.then(() => stored).then(() => send(event));
  });
  return (event) => events.announce(event);
}
