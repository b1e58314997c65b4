/** Entry "plotwright/server": creates the whole server, for embedding in other programs. */
import { randomUUID } from "node:crypto";
import type { Server } from "node:http";
import type { AddressInfo } from "node:net";
import { hostname } from "node:os";
import { machineOf } from "../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  type Pairing,
  type PlotSettings,
  type ServerEvent,
} from "../src/schema/index.js";
import { Closing } from "./closing.js";
import { defaultDataDir, prepareDataDir } from "./data-dir.js";
import { createApp, type AppParts } from "./http/app.js";
import { EventHub } from "./http/events.js";
import { httpServer, listen, urlOf } from "./http/listen.js";
import { LogBook, readLog } from "./log-book.js";
import { MachineFiles } from "./machines/machine-files.js";
import { createPlanning } from "./planning/planning.js";
import { DrawingFiles } from "./queue/drawing-files.js";
import { JobQueue } from "./queue/job-queue.js";
import { Notices } from "./queue/notices.js";
import { packagePath, packageVersion } from "./package-files.js";
import { Store } from "./queue/store.js";
import { SharedQueue, claimsOf, type SharedParts } from "./shared/shared-queue.js";
import { SharedStore } from "./shared/shared-store.js";
import { Access } from "./security/access.js";
import { OperatorLock } from "./security/operator-lock.js";
import { LocalName, MDNS_NAME } from "./security/local-name.js";
import { lanAddresses, pairingLinks } from "./security/network.js";
import { FIRST_PLOTTER, openDriven } from "./driven-plotter.js";
import { PlotterRegistry } from "./plotter-registry.js";
import { findBoards } from "./serial/find-boards.js";
import { WatchFolder } from "./watch-folder.js";
import { Webhooks } from "./webhooks/webhooks.js";

export type { HandMove } from "./plotter/hand-moves.js";
export { PlotterDriver, type PlotterOptions, type PlotterState } from "./plotter/plotter.js";

export interface ServerOptions {
  /** Default 9080; 0 picks a free port. */
  readonly port?: number;
  /** Default 127.0.0.1, or all addresses with `lan`. */
  readonly host?: string;
  /** Listen on the network. Other devices have to be paired; the links are in the server's `pairing`. */
  readonly lan?: boolean;
  /**
   * Announce plotwright.local by mDNS, or plotwright-2.local if that is taken. Default: the value of `lan`.
   */
  readonly mdns?: boolean;
  /** Serve https with this certificate and key (PEM text). */
  readonly tls?: { readonly cert: string; readonly key: string };
  /** Require pairing on this computer too, for use behind a proxy on this computer. */
  readonly pairAlways?: boolean;
  /**
   * Serial path of the board, or "virtual"; default: the first EBB found, or the virtual board if there is
   * none.
   */
  readonly device?: string;
  /** Speed of the virtual board: 1 is real time. */
  readonly virtualSpeed?: number;
  /** Folder for jobs and settings. */
  readonly dataDir?: string;
  /** Largest upload; default 200 MB. */
  readonly maxUploadBytes?: number;
  /** Host names to accept besides localhost and addresses. */
  readonly allowedHosts?: readonly string[];
  /** Folder whose new drawings become queued jobs. */
  readonly watchDir?: string;
  /** postgres://… of a database through which servers share jobs; needs the packages pg and pg-boss. */
  readonly sharedQueue?: string;
  /** How often idle plotters look for shared jobs; default 2000. */
  readonly sharedPollMs?: number;
  /** Time without a sign of life after which a sharing server counts as lost; default 60 000. */
  readonly sharedLostAfterMs?: number;
  /** Timeout of the shared database; default 5 s. */
  readonly sharedTimeoutMs?: number;
  /** Receives the lines of the log. */
  readonly log?: (line: string) => void;
}

export interface PlotwrightServer {
  /** URL of the page, with the actual port. */
  readonly url: string;
  /** Paths of the links that pair a device, to append to an address of this computer. */
  readonly pairing: { readonly operatePath: string; readonly watchPath: string };
  /** Stops plotting (the pen lifts), stores the state, and releases port, board and data folder. */
  close(): Promise<void>;
}

const DEFAULT_PORT = 9080;
const DEFAULT_MAX_UPLOAD_BYTES = 200_000_000;

/**
 * Throws `conflict` (port or data folder in use), `no-board` (the named device is missing), `bad-setting`.
 */
export async function createServer(options: ServerOptions = {}): Promise<PlotwrightServer> {
  const dataDir = options.dataDir ?? defaultDataDir();
  let book: LogBook | null = null;
  const log = (text: string): void => {
    // Text from clients must not send control characters to the terminal.
    const line = text.replace(/[^\P{Cc}\n\t]/gu, "?");
    book?.write(line);
    options.log?.(line);
  };
  const closing = new Closing(log);
  try {
    prepareDataDir(dataDir);
    const store = Store.open(dataDir);
    closing.add("the database", () => store.close());
    book = new LogBook(dataDir);
    const { repair, copyFault } = store.opened;
    if (repair !== null) log(repair);
    if (copyFault !== null) log(`the database could not be backed up: ${copyFault}`);
    const parts = await openParts(options, dataDir, store, log, closing);
    const { access, registry } = parts;
    const isTls = options.tls !== undefined;
    const paths = { operatePath: access.pairingPath("operate"), watchPath: access.pairingPath("watch") };
    const pairing = (): Promise<Pairing> => {
      const own = new URL(urlOf(http, isTls));
      const address = options.lan === true ? (lanAddresses()[0] ?? own.hostname) : own.hostname;
      return pairingLinks(`${own.protocol}//${address}:${own.port}`, options.lan === true, paths);
    };
    let localName: LocalName | null = null;
    const app = createApp({
      ...parts,
      pairing,
      log,
      serverLog: () => readLog(dataDir),
      localName: () => localName?.name ?? null,
    });
    const http = httpServer(options.tls, app, access, log);
    await listen(
      http,
      options.port ?? DEFAULT_PORT,
      options.host ?? (options.lan === true ? "::" : "127.0.0.1"),
    );
    closing.addUrgent("the port", () => stopListening(http, parts.hub));
    const { port } = http.address() as AddressInfo;
    if (options.mdns ?? options.lan === true) {
      const name = openLocalName({ port, isTls }, store, parts.hub, log);
      closing.add("the mDNS name", () => name.close());
      localName = name;
    }
    log(`plotwright ${parts.version} listens on port ${port}, with ${registry.list().length} plotter(s)`);
    return { url: urlOf(http, isTls), pairing: paths, close: () => closing.run() };
  } catch (error) {
    await closing.run();
    throw error;
  }
}

/** Opens everything behind the routes, and registers how each part is closed. */
async function openParts(
  options: ServerOptions,
  dataDir: string,
  store: Store,
  log: (line: string) => void,
  closing: Closing,
): Promise<Omit<AppParts, "pairing" | "log" | "serverLog" | "localName">> {
  const files = new DrawingFiles(dataDir, options.maxUploadBytes ?? DEFAULT_MAX_UPLOAD_BYTES);
  const unclaimedCount = await files.sweep((drawing) => store.isUsed(drawing));
  if (unclaimedCount > 0)
    log(`${unclaimedCount} drawing(s) that belong to no job were moved to ${files.unclaimedDir}`);
  const hub = new EventHub();
  const announce = (event: ServerEvent): void => hub.announce(event);
  const nowIso = (): string => new Date().toISOString();
  const machines = new MachineFiles(dataDir);
  machines.warnings.forEach(log);
  const withMachine = (settings: PlotSettings): PlotSettings => machines.withMachine(settings);

  const { virtualSpeed, device: firstDevice } = options;
  const registry = new PlotterRegistry({
    store,
    announce,
    findBoards,
    mustBeMachine: (machine) => void machineOf(withMachine({ ...DEFAULT_PLOT_SETTINGS, machine })),
    firstId: FIRST_PLOTTER,
    firstDevice,
    open: (row, isTaken) => openDriven(row, { virtualSpeed, isTaken, withMachine, log }),
  });
  closing.add("the plotters", () => registry.close());
  const plotters = registry.ports;
  const plotterName = (id: string): string => plotters.get(id)?.snapshot().name ?? id;
  const webhooks = new Webhooks({ store: store.webhooks, plotterName, log });
  closing.add("the webhooks", () => webhooks.close());
  let shared: SharedQueue | null = null;
  const queue = new JobQueue({
    store,
    files,
    planning: createPlanning(files),
    plotters,
    announce,
    nowIso,
    log,
    withChange: (before, after) => webhooks.note(before, after),
    claims: claimsOf(store, () => shared),
    afterChange: () => {
      webhooks.wake();
      shared?.wake();
    },
  });
  closing.addUrgent("the running plots", () => queue.close());
  webhooks.start();
  const notices = new Notices({ store, announce, nowIso });
  if (store.opened.repair !== null) notices.add(store.opened.repair);
  if (options.watchDir !== undefined) {
    const folder = await WatchFolder.open(options.watchDir, {
      queue,
      files,
      store,
      notices,
      withMachine,
      log,
    });
    closing.add("the watched folder", () => folder.close());
  }

  shared = await openShared(options, { store, queue, files, plotters, notices, log });
  closing.add("the shared queue", () => shared?.close());
  const access = new Access(store, { trustsLoopback: options.pairAlways !== true });
  access.onRevoke(() => hub.dropAll());
  const operatorLock = new OperatorLock({
    store,
    log,
    announce: (operator) => announce({ type: "operator", operator }),
  });
  closing.add("the operator lock", () => operatorLock.close());
  return {
    version: packageVersion(),
    machines,
    queue,
    files,
    registry,
    hub,
    operatorLock,
    webhooks,
    notices,
    shared,
    access,
    allowedHosts: allowedHosts(options),
    webDir: packagePath("dist/web"),
    samplesDir: packagePath("samples"),
  };
}

/** Probes for the name of the last run first. */
function openLocalName(
  at: { readonly port: number; readonly isTls: boolean },
  store: Store,
  hub: EventHub,
  log: (line: string) => void,
): LocalName {
  const last = store.setting("local-name");
  return new LocalName({
    ...at,
    log,
    last: typeof last === "string" ? last : undefined,
    onName: (name) => {
      try {
        if (name !== null) store.saveSetting("local-name", name);
      } catch (error) {
        log(`the local name is not stored: ${(error as Error).message}`);
      }
      hub.announce({ type: "local-name", localName: name });
    },
  });
}

/** Opens the shared queue; null if the server has none. */
async function openShared(
  { sharedQueue, sharedPollMs, sharedLostAfterMs, sharedTimeoutMs }: ServerOptions,
  parts: Pick<SharedParts, "queue" | "files" | "plotters" | "log"> & {
    readonly store: Store;
    readonly notices: Notices;
  },
): Promise<SharedQueue | null> {
  if (sharedQueue === undefined) return null;
  const { store, notices, log } = parts;
  const storedId = store.setting("server-id");
  const serverId = typeof storedId === "string" ? storedId : randomUUID();
  if (serverId !== storedId) store.saveSetting("server-id", serverId);
  return new SharedQueue({
    ...parts,
    shared: await SharedStore.open(sharedQueue, log, sharedTimeoutMs),
    serverId,
    serverName: hostname(),
    notice: (message) => notices.add(message),
    ...(sharedPollMs === undefined ? {} : { pollMs: sharedPollMs }),
    ...(sharedLostAfterMs === undefined ? {} : { lostAfterMs: sharedLostAfterMs }),
  });
}

function allowedHosts({ allowedHosts = [], host, lan }: ServerOptions): string[] {
  const own = lan === true ? [`${MDNS_NAME}.local`, hostname()] : [];
  return [...allowedHosts, ...own, ...(host === undefined ? [] : [host])];
}

function stopListening(http: Server, hub: EventHub): Promise<void> {
  return new Promise((resolve) => {
    http.close(() => resolve());
    hub.close();
    http.closeAllConnections();
  });
}
