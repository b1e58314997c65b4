/** Entry "plotwright/server": the whole server, to be embedded. */
import { createServer as createHttpServer, type RequestListener, type Server } from "node:http";
import { createServer as createHttpsServer } from "node:https";
import type { AddressInfo } from "node:net";
import { hostname } from "node:os";
import { PlotwrightError } from "../src/index.js";
import type { ServerEvent } from "../src/schema/index.js";
import { defaultDataDir, prepareDataDir } from "./data-dir.js";
import { createApp } from "./http/app.js";
import { EventHub } from "./http/events.js";
import { MachineFiles } from "./machines/machine-files.js";
import { createPlanning } from "./planning/planning.js";
import { DrawingFiles } from "./queue/drawing-files.js";
import { JobQueue } from "./queue/job-queue.js";
import type { PlotterPort } from "./queue/plotter-port.js";
import { packagePath, packageVersion } from "./package-files.js";
import { Store } from "./queue/store.js";
import { Access } from "./security/access.js";
import { MDNS_NAME, announceOnLan } from "./security/network.js";
import { openPlotters } from "./plotters.js";

export interface ServerOptions {
  /** 9080 unless told; 0 takes any free one. */
  readonly port?: number;
  /** 127.0.0.1 unless told, or all addresses with `lan`. */
  readonly host?: string;
  /** Listen on the network. Other devices have to be paired; the links are in the server's `pairing`. */
  readonly lan?: boolean;
  /** Announce plotwright.local by mDNS; with `lan` unless told. */
  readonly mdns?: boolean;
  /** PEM texts: serve https. */
  readonly tls?: { readonly cert: string; readonly key: string };
  /** Ask for pairing on this computer too (when a proxy here lets others in). */
  readonly pairAlways?: boolean;
  /** Serial path of the board, or "virtual"; without it the first EBB found, else the virtual board. */
  readonly device?: string;
  /** Board seconds a second on the virtual board: 1 is real time. */
  readonly virtualSpeed?: number;
  /** Folder for jobs and settings. */
  readonly dataDir?: string;
  /** Largest upload; 200 MB unless told. */
  readonly maxUploadBytes?: number;
  /** Host names to answer to, besides localhost and any address. */
  readonly allowedHosts?: readonly string[];
  /** Gets one line for each thing worth knowing; silent unless given. */
  readonly log?: (line: string) => void;
}

export interface PlotwrightServer {
  /** Where the page is, with the real port. */
  readonly url: string;
  /** Paths of the links that pair a device: add them to an address of this computer. */
  readonly pairing: { readonly operatePath: string; readonly watchPath: string };
  /** Stops plotting (the pen lifts), stores, and gives port, board and data folder back. */
  close(): Promise<void>;
}

const DEFAULT_PORT = 9080;
const DEFAULT_MAX_UPLOAD_BYTES = 200_000_000;

/** Throws `conflict` (port or data folder taken), `no-board` (a named device that isn't there), `bad-setting`. */
export async function createServer(options: ServerOptions = {}): Promise<PlotwrightServer> {
  const log = options.log ?? (() => undefined);
  const dataDir = options.dataDir ?? defaultDataDir();
  const undo: (() => Promise<void> | void)[] = [];
  const close = async (): Promise<void> => {
    for (const step of undo.splice(0).reverse()) await step();
  };
  try {
    prepareDataDir(dataDir);
    const store = Store.open(dataDir);
    undo.push(() => store.close());
    const maxUploadBytes = options.maxUploadBytes ?? DEFAULT_MAX_UPLOAD_BYTES;
    const files = new DrawingFiles(dataDir, maxUploadBytes);
    await files.sweep((drawing) => store.isUsed(drawing));

    const hub = new EventHub();
    const announce = (event: ServerEvent): void => hub.announce(event);
    const plotters = openPlotters(options, log);
    undo.push(() => closeAll(plotters));
    for (const plotter of plotters.values()) {
      plotter.onChange((state) => announce({ type: "plotter", plotter: state }));
    }
    const queue = new JobQueue({
      store,
      files,
      planning: createPlanning(files),
      plotters,
      announce,
      nowIso: () => new Date().toISOString(),
    });
    undo.push(() => queue.close());

    const access = new Access(store, { trustsLoopback: options.pairAlways !== true });
    access.onRevoke(() => hub.dropAll());
    const machines = new MachineFiles(dataDir);
    machines.warnings.forEach(log);
    const app = createApp({
      version: packageVersion(),
      machines,
      queue,
      files,
      plotters,
      hub,
      allowedHosts: allowedHosts(options),
      webDir: packagePath("dist/web"),
      samplesDir: packagePath("samples"),
      access,
      log,
    });
    const http = httpServer(options, app);
    await listen(
      http,
      options.port ?? DEFAULT_PORT,
      options.host ?? (options.lan === true ? "::" : "127.0.0.1"),
    );
    undo.push(() => stopListening(http, hub));
    const { port } = http.address() as AddressInfo;
    if (options.mdns ?? options.lan === true) undo.push(announceOnLan(port, options.tls !== undefined));
    const pairing = { operatePath: access.pairingPath("operate"), watchPath: access.pairingPath("watch") };
    return { url: urlOf(http, options.tls !== undefined), pairing, close };
  } catch (error) {
    await close();
    throw error;
  }
}

function allowedHosts({ allowedHosts = [], host, lan }: ServerOptions): string[] {
  const own = lan === true ? [`${MDNS_NAME}.local`, hostname()] : [];
  return [...allowedHosts, ...own, ...(host === undefined ? [] : [host])];
}

/** Slow uploads are cut off: headers within 20 s, the whole within 10 minutes. */
function httpServer({ tls }: ServerOptions, app: RequestListener): Server {
  const times = { headersTimeout: 20_000, requestTimeout: 10 * 60_000 };
  if (tls === undefined) return createHttpServer(times, app);
  try {
    return createHttpsServer({ ...times, ...tls }, app);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The certificate or its key can't be used (${(cause as Error).message}). Give PEM files with --cert and --key.`,
      { cause },
    );
  }
}

async function closeAll(plotters: ReadonlyMap<string, PlotterPort>): Promise<void> {
  await Promise.all([...plotters.values()].map((plotter) => plotter.close()));
}

function listen(http: Server, port: number, host: string): Promise<void> {
  return new Promise((resolve, reject) => {
    http.once("error", (cause: NodeJS.ErrnoException) => reject(listenFault(cause, port, host)));
    http.listen(port, host, resolve);
  });
}

function listenFault(cause: NodeJS.ErrnoException, port: number, host: string): PlotwrightError {
  if (cause.code === "EADDRINUSE") {
    return new PlotwrightError(
      "conflict",
      `Port ${port} is taken by another program. Stop it, or choose another with --port.`,
      { cause },
    );
  }
  return new PlotwrightError("bad-setting", `Can't listen on ${host}:${port} (${cause.message}).`, { cause });
}

function stopListening(http: Server, hub: EventHub): Promise<void> {
  return new Promise((resolve) => {
    http.close(() => resolve());
    hub.close();
    http.closeAllConnections();
  });
}

function urlOf(http: Server, isTls: boolean): string {
  const { address, port, family } = http.address() as AddressInfo;
  const isAny = address === "::" || address === "0.0.0.0";
  const host = isAny ? "127.0.0.1" : family === "IPv6" ? `[${address}]` : address;
  return `${isTls ? "https" : "http"}://${host}:${port}`;
}
