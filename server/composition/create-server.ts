/** Creates the whole server: opens its parts, connects them and closes them. */
import type { Server } from "node:http";
import type { AddressInfo } from "node:net";
import { hostname } from "node:os";
import type { Pairing, PlotSettings, ServerEvent } from "../../src/schema/index.js";
import { Closing } from "./closing.js";
import { defaultDataDir, prepareDataDir } from "../storage/data-dir.js";
import { createApp, type AppParts } from "../http/app.js";
import { EventHub } from "../http/events.js";
import { httpServer, listen, urlOf } from "../http/listen.js";
import { LiveSockets } from "../http/live-routes.js";
import { Refusals } from "../http/refusals.js";
import { noteAddress } from "../storage/data-lock.js";
import { fileFault } from "../storage/file-fault.js";
import { LogBook, readLog } from "../storage/log-book.js";
import { MachineFiles } from "../storage/machine-files.js";
import { createPlanning } from "../planning/planner.js";
import { DrawingFiles, UNCLAIMED_DAYS } from "../storage/drawing-files.js";
import { LibraryFiles } from "../storage/library-files.js";
import { JobQueue } from "../../host/queue/job-queue.js";
import { Notices } from "../../host/queue/notices.js";
import { packagePath, packageVersion } from "../storage/package-files.js";
import { Store } from "../storage/store.js";
import { Access } from "../security/access.js";
import { OperatorLock } from "../security/operator-lock.js";
import { lanAddresses, LOCAL_NAME, pairingLinks, type PairingPaths } from "../security/network.js";
import { askPorts } from "../../host/plotter/ask-ports.js";
import { FIRST_PLOTTER, openNamedPlotter } from "../../host/plotter/named-plotter.js";
import { NODE_PARTS } from "../plotter/node-parts.js";
import { PlotterRegistry } from "../../host/plotter/plotter-registry.js";
import { findBoards } from "../serial/find-boards.js";
import type { PluginHost, RunningPlugin } from "../plugins/server-plugin.js";
import { UploadedDrawings } from "../../host/queue/uploaded-drawings.js";
import { jobHooksOf, loadPlugins } from "./load-plugins.js";
import { checkServerOptions, originsOf, type ServerOptions } from "./server-options.js";

export type { ServerOptions } from "./server-options.js";

export interface PlotwrightServer {
  /** URL of the page, with the actual port. */
  readonly url: string;
  /**
   * Paths of the links that pair a device, to append to an address of this computer. They are replaced when a device is
   * removed.
   */
  readonly pairing: PairingPaths;
  /** Stops plotting (the pen lifts), stores the state, and releases port, board and data folder. */
  close(): Promise<void>;
}

const DEFAULT_PORT = 9080;
const DEFAULT_MAX_UPLOAD_BYTES = 200_000_000;

/**
 * Throws `conflict` (port or data folder in use), `no-board` (the named device is missing), `bad-setting`.
 */
export async function createServer(options: ServerOptions = {}): Promise<PlotwrightServer> {
  checkServerOptions(options);
  const allowedOrigins = originsOf(options.allowedOrigins ?? []);
  const dataDir = options.dataDir ?? defaultDataDir();
  let book: LogBook | null = null;
  const log = (text: string): void => {
    // Text from clients must not send control characters to the terminal.
    const line = text.replace(/[^\P{Cc}\n\t]/gu, "?");
    book?.write(line);
    options.log?.(line);
  };
  const closing = new Closing(log);
  const closed = async (): Promise<void> => {
    await closing.run();
    await book?.written();
  };
  try {
    prepareDataDir(dataDir);
    const store = Store.open(dataDir);
    closing.add("the database", () => store.close());
    const openBook = new LogBook(dataDir);
    book = openBook;
    const { repair, copyFault } = store.opened;
    if (repair !== null) log(repair);
    if (copyFault !== null) log(`the database could not be backed up: ${copyFault}`);
    const parts = await openParts(options, dataDir, store, log, closing);
    const { access, registry, refusals, plugins } = parts;
    const isTls = options.tls !== undefined;
    const paths = (): PairingPaths => ({
      operatePath: access.pairingPath("operate"),
      submitPath: access.pairingPath("submit"),
      watchPath: access.pairingPath("watch"),
    });
    const pairing = (): Promise<Pairing> => {
      const own = new URL(urlOf(http, isTls));
      const address = options.lan === true ? (lanAddresses()[0] ?? own.hostname) : own.hostname;
      return pairingLinks(`${own.protocol}//${address}:${own.port}`, options.lan === true, paths());
    };
    const app = createApp({
      ...parts,
      allowedOrigins,
      plugins: plugins.flatMap(({ operations }) => operations ?? []),
      pairing,
      log,
      serverLog: async () => {
        await openBook.written();
        return readLog(dataDir);
      },
    });
    const http = httpServer(options.tls, app, access, refusals);
    await listen(
      http,
      options.port ?? DEFAULT_PORT,
      options.host ?? (options.lan === true ? "::" : "127.0.0.1"),
    );
    closing.addUrgent("the port", () => stopListening(http, parts));
    const { port } = http.address() as AddressInfo;
    for (const plugin of plugins) plugin.listening?.({ port, isTls });
    log(`plotwright ${parts.version} has started, plotters: ${registry.list().length}`);
    const url = urlOf(http, isTls);
    try {
      noteAddress(dataDir, url);
    } catch (error) {
      log(`the address could not be stored in ${dataDir}: ${fileFault(error)}`);
    }
    return {
      url,
      get pairing() {
        return paths();
      },
      close: closed,
    };
  } catch (error) {
    await closed();
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
): Promise<
  Omit<AppParts, "pairing" | "log" | "serverLog" | "plugins" | "allowedOrigins"> & {
    readonly plugins: readonly RunningPlugin[];
  }
> {
  const files = new DrawingFiles(dataDir, options.maxUploadBytes ?? DEFAULT_MAX_UPLOAD_BYTES);
  const unclaimedCount = await files.sweep((drawing) => store.isUsed(drawing));
  if (unclaimedCount > 0)
    log(
      `Drawings that belong to no job were moved to ${files.unclaimedDir}, where they are kept for ${UNCLAIMED_DAYS} days: ${unclaimedCount}`,
    );
  const uploads = new UploadedDrawings(files, log);
  closing.add("the uploaded drawings", () => uploads.close());
  const hub = new EventHub();
  const running: RunningPlugin[] = [];
  const announce = (event: ServerEvent): void => {
    hub.announce(event);
    for (const plugin of running) plugin.onEvent?.(event);
  };
  const nowIso = (): string => new Date().toISOString();
  const machines = new MachineFiles(dataDir, announce);
  machines.warnings.forEach(log);
  const withMachine = (settings: PlotSettings): PlotSettings => machines.withMachine(settings);

  const { virtualSpeed, virtualSprings, device: firstDevice } = options;
  const registry = new PlotterRegistry({
    store,
    announce,
    findBoards,
    askPorts: (isTaken) => askPorts(NODE_PARTS, isTaken),
    withMachine,
    firstId: FIRST_PLOTTER,
    firstDevice,
    open: (row, isTaken, settings) =>
      openNamedPlotter(row, { virtualSpeed, virtualSprings, isTaken, settings, log, ...NODE_PARTS }),
  });
  closing.add("the plotters", () => registry.close());
  const plotters = registry.ports;
  const core = { store, plotters, log, dataDir };
  const plugins = await loadPlugins(options, core);
  const queue = new JobQueue({
    store,
    files,
    planning: createPlanning(files),
    plotters,
    settingsOf: (id, last) => registry.settingsOf(id, last),
    withMachine,
    announce,
    nowIso,
    log,
    ...jobHooksOf(plugins, core),
  });
  closing.addUrgent("the running plots", () => queue.close());
  const notices = new Notices({ store, announce, nowIso });
  if (store.opened.repair !== null) notices.add(store.opened.repair);
  let localName: string | null = null;
  const setLocalName = (name: string | null): void => {
    localName = name;
    announce({ type: "local-name", localName: name });
  };
  const host: PluginHost = { ...core, queue, files, uploads, notices, setLocalName };
  for (const plugin of plugins) {
    const started = await plugin.start(host);
    closing.add(plugin.name, () => started.close());
    running.push(started);
  }
  const access = new Access(store, { trustsLoopback: options.pairAlways !== true });
  const lives = new LiveSockets();
  access.onRevoke((id) => {
    hub.drop(id);
    lives.drop(id);
  });
  access.onNewPairing(() => options.onNewPairing?.());
  const operatorLock = new OperatorLock({
    store,
    log,
    announce: (operator) => announce({ type: "operator", operator }),
  });
  closing.add("the operator lock", () => operatorLock.close());
  const refusals = new Refusals(log);
  closing.add("the count of refusals", () => refusals.close());
  return {
    version: packageVersion(),
    machines,
    queue,
    files,
    library: new LibraryFiles(dataDir, files.maxBytes),
    uploads,
    registry,
    hub,
    lives,
    operatorLock,
    notices,
    plugins: running,
    localName: () => localName,
    access,
    refusals,
    allowedHosts: allowedHosts(options),
    webDir: packagePath("dist/web"),
    samplesDir: packagePath("samples"),
  };
}

function allowedHosts({ allowedHosts = [], host, lan }: ServerOptions): string[] {
  const own = lan === true ? [`${LOCAL_NAME}.local`, hostname()] : [];
  return [...allowedHosts, ...own, ...(host === undefined ? [] : [host])];
}

function stopListening(http: Server, { hub, lives }: Pick<AppParts, "hub" | "lives">): Promise<void> {
  return new Promise((resolve) => {
    http.close(() => resolve());
    hub.close();
    lives.close();
    http.closeAllConnections();
  });
}
