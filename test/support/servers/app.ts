/** The HTTP server over a temporary folder, with a scripted plotter: everything is real but threads and board. */
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import type { Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { apiRoutes, createApp, type AppParts } from "../../../server/http/app.js";
import { EventHub } from "../../../server/http/events.js";
import { MachineFiles } from "../../../server/storage/machine-files.js";
import { httpServer, type TlsFiles } from "../../../server/http/listen.js";
import { LiveSockets } from "../../../server/http/live-routes.js";
import { Refusals } from "../../../server/http/refusals.js";
import { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import { Notices } from "../../../host/queue/notices.js";
import { OperatorLock } from "../../../server/security/operator-lock.js";
import { pairingLinks } from "../../../server/security/network.js";
import type { FoundBoard } from "../../../server/serial/find-boards.js";
import { Webhooks } from "../../../server/plugins/webhooks/webhooks.js";
import { webhookOperations } from "../../../server/plugins/webhooks/plugin.js";
import { cameraPlugin } from "../../../server/plugins/camera/plugin.js";
import { WebhookStore } from "../../../server/plugins/webhooks/webhook-store.js";
import type { Operation, ServerEvent } from "../../../src/schema/index.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { LibraryFiles } from "../../../server/storage/library-files.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import type { Planning } from "../../../host/planning/planning.js";
import { UploadedDrawings } from "../../../host/queue/uploaded-drawings.js";
import { Store } from "../../../server/storage/store.js";
import { Access } from "../../../server/security/access.js";
import { LED_PLANNING, LedPlotter } from "../jobs/led-plotter.js";

export interface TestApp {
  readonly url: string;
  readonly plotter: LedPlotter;
  readonly queue: JobQueue;
  readonly store: Store;
  readonly access: Access;
  readonly notices: Notices;
  readonly webhooks: Webhooks;
  /** Plotters added while it runs. */
  readonly more: readonly LedPlotter[];
  readonly logged: string[];
  readonly refusals: Refusals;
  /** "method path" of every route below /api/v1. */
  routes(): string[];
  /** What the OpenAPI document is made of. */
  documented(): readonly Operation[];
  drawingsOnDisk(): string[];
  /** From now on requests have to arrive that fast. */
  hurry(headersMs: number, wholeMs: number): void;
  readonly dir: string;
  /** Open connections to the server. */
  connectionCount(): Promise<number>;
  /** `keepsData`: for a server that is started again in the same folder. */
  close(options?: { readonly keepsData: boolean }): Promise<void>;
}

export async function startApp(
  options: {
    /** The data folder of a server before; default: a new one. */
    readonly dir?: string;
    readonly planning?: Planning;
    readonly maxUploadBytes?: number;
    readonly trustsLoopback?: boolean;
    readonly allowedOrigins?: readonly string[];
    readonly lapseMs?: number;
    /** How long an upload waits for its job. */
    readonly keepUploadsMs?: number;
    readonly boards?: readonly FoundBoard[];
    readonly tls?: TlsFiles;
    readonly times?: { readonly connectionsCheckingInterval?: number; readonly unreadTimeout?: number };
  } = {},
): Promise<TestApp> {
  const dir = options.dir ?? mkdtempSync(join(tmpdir(), "plotwright-app-"));
  prepareDataDir(dir);
  const store = Store.open(dir);
  const maxUploadBytes = options.maxUploadBytes ?? 3_000_000;
  const files = new DrawingFiles(dir, maxUploadBytes);
  const plotter = new LedPlotter();
  const hub = new EventHub();
  const logged: string[] = [];
  const log = (line: string): void => void logged.push(line);
  const announce = (event: ServerEvent): void => hub.announce(event);
  const nowIso = (): string => new Date().toISOString();
  const more: LedPlotter[] = [];
  const registry = new PlotterRegistry({
    store,
    announce,
    firstId: plotter.id,
    findBoards: () => Promise.resolve(options.boards ?? []),
    askPorts: (isTaken) =>
      Promise.resolve(
        (options.boards ?? [])
          .filter(({ path }) => !isTaken(path))
          .map((board) => ({ ...board, answer: "Grbl 1.1h", controller: "grbl", fault: null })),
      ),
    withMachine: (settings) => settings,
    open: (row) => {
      if (row.id === plotter.id) return plotter;
      const other = new LedPlotter(row.id, row.name ?? row.id);
      more.push(other);
      return other;
    },
  });
  const plotters = registry.ports;
  const webhooks = new Webhooks({
    store: new WebhookStore(store.database),
    plotterName: (id) => id,
    log,
    pausesS: [0, 0, 0],
  });
  const core = { store, plotters, log, dataDir: dir };
  const camera = cameraPlugin(core);
  const uploads = new UploadedDrawings(files, log, options.keepUploadsMs);
  const queue = new JobQueue({
    store,
    files,
    planning: options.planning ?? LED_PLANNING,
    plotters,
    settingsOf: (id, last) => registry.settingsOf(id, last),
    announce,
    nowIso,
    log,
    withChange: (before, after) => {
      webhooks.note(before, after);
      camera.jobs?.withChange?.(before, after);
    },
    onRemoved: camera.jobs?.onRemoved,
    afterChange: () => webhooks.wake(),
    onProgress: (job) => webhooks.progressed(job),
  });
  const notices = new Notices({ store, announce, nowIso });
  const cameras = await camera.start({
    ...core,
    queue,
    files,
    uploads,
    notices,
    setLocalName: () => undefined,
  });
  const operatorLock = new OperatorLock({
    store,
    log,
    announce: (operator) => announce({ type: "operator", operator }),
    lapseMs: options.lapseMs ?? 30_000,
  });
  const access = new Access(store, { trustsLoopback: options.trustsLoopback });
  const lives = new LiveSockets();
  access.onRevoke((id) => {
    hub.drop(id);
    lives.drop(id);
  });
  const refusals = new Refusals(log);
  const parts: AppParts = {
    version: "0.0.0",
    queue,
    files,
    library: new LibraryFiles(dir, maxUploadBytes),
    uploads,
    registry,
    hub,
    lives,
    operatorLock,
    notices,
    plugins: [{ webhooks: webhookOperations(webhooks, log) }, cameras.operations ?? {}],
    pairing: () =>
      pairingLinks("http://192.168.1.4:9080", true, {
        operatePath: "/pair?a",
        submitPath: "/pair?c",
        watchPath: "/pair?b",
      }),
    serverLog: () => Promise.resolve(logged.join("\n")),
    machines: new MachineFiles(dir, announce),
    allowedHosts: ["plotter.lan"],
    allowedOrigins: options.allowedOrigins ?? [],
    localName: () => "plotwright-2.local",
    webDir: join(dir, "web"),
    samplesDir: fileURLToPath(new URL("../../../samples", import.meta.url)),
    access,
    log,
    refusals,
  };
  const app = createApp(parts);
  const http: Server = httpServer(options.tls, app, access, refusals, options.times);
  await new Promise<void>((resolve) => http.listen(0, "127.0.0.1", resolve));
  return {
    url: `${options.tls === undefined ? "http" : "https"}://127.0.0.1:${(http.address() as AddressInfo).port}`,
    plotter,
    queue,
    store,
    access,
    notices,
    webhooks,
    more,
    routes: () =>
      apiRoutes(parts).router.stack.flatMap(({ route }) =>
        [...new Set((route?.stack ?? []).map(({ method }) => method))].map(
          (method) => `${method} ${route?.path}`,
        ),
      ),
    documented: () => apiRoutes(parts).operations,
    logged,
    refusals,
    drawingsOnDisk: () => readdirSync(join(dir, "drawings")),
    hurry: (headersMs, wholeMs) => {
      http.headersTimeout = headersMs;
      http.requestTimeout = wholeMs;
    },
    dir,
    connectionCount: () =>
      new Promise((resolve, reject) =>
        http.getConnections((error, count) => (error === null ? resolve(count) : reject(error))),
      ),
    close: async ({ keepsData } = { keepsData: false }) => {
      hub.close();
      lives.close();
      refusals.close();
      http.closeAllConnections();
      await new Promise((resolve) => http.close(resolve));
      await queue.close();
      await webhooks.close();
      await cameras.close();
      await uploads.close();
      operatorLock.close();
      store.close();
      if (!keepsData) rmSync(dir, { recursive: true, force: true });
    },
  };
}
