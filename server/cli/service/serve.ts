/** `plotwright serve`: runs until it is stopped. */
import { spawn } from "node:child_process";
import { PlotwrightError } from "../../../src/index.js";
import type { Springs } from "../../../src/internal.js";
import { createServer, type PlotwrightServer, type ServerOptions } from "../../composition/create-server.js";
import { lanAddresses, pairingText } from "../../security/network.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { addressOfServer } from "../../storage/data-lock.js";
import { fileFault } from "../../storage/file-fault.js";
import { readText } from "../files.js";
import { printed, type CliIo } from "../io.js";

/** Time limit after everything has been closed. */
const LINGER_MS = 3_000;
/** Time to lift the pen, go home and store; each part has its own limit (closing.ts). */
const CLOSING_MS = 55_000;
/** Time limit if it is stopped while opening: nothing plots yet. */
const OPENING_MS = 5_000;

export interface ServeCommandOptions {
  readonly port: number;
  readonly host?: string;
  readonly allowHost?: readonly string[];
  readonly allowOrigin?: readonly string[];
  readonly device?: string;
  readonly virtualSpeed?: number;
  readonly virtualSprings?: Springs;
  readonly data?: string;
  readonly watch?: string;
  readonly sharedQueue?: string;
  readonly mqtt?: string;
  readonly maxUploadMb: number;
  readonly open?: boolean;
  readonly lan?: boolean;
  readonly mdns: boolean;
  readonly cert?: string;
  readonly key?: string;
  readonly pairAlways?: boolean;
}

export async function runServe(options: ServeCommandOptions, io: CliIo): Promise<void> {
  let isOpen = false;
  const stopped = new Promise<void>((resolve) =>
    io.onInterrupt(() => {
      io.endWithin(isOpen ? CLOSING_MS : OPENING_MS);
      resolve();
    }),
  );
  const server = await serverUnlessRunning(options, {
    port: options.port,
    ...(options.host === undefined ? {} : { host: options.host }),
    lan: options.lan === true,
    mdns: options.lan === true && options.mdns,
    pairAlways: options.pairAlways === true,
    ...tlsOf(options),
    maxUploadBytes: options.maxUploadMb * 1e6,
    ...(options.allowHost === undefined ? {} : { allowedHosts: options.allowHost }),
    ...(options.allowOrigin === undefined ? {} : { allowedOrigins: options.allowOrigin }),
    ...(options.device === undefined ? {} : { device: options.device }),
    ...(options.virtualSpeed === undefined ? {} : { virtualSpeed: options.virtualSpeed }),
    ...(options.virtualSprings === undefined ? {} : { virtualSprings: options.virtualSprings }),
    ...(options.data === undefined ? {} : { dataDir: options.data }),
    ...(options.watch === undefined ? {} : { watchDir: options.watch }),
    ...(options.sharedQueue === undefined ? {} : { sharedQueue: options.sharedQueue }),
    ...(options.mqtt === undefined ? {} : { mqtt: options.mqtt }),
    onNewPairing: () => void showPairing("A device was removed, so the links for pairing are new.\n"),
    log: (line) => io.err(printed`${line}\n`),
  });
  if (typeof server === "string") {
    io.out(`plotwright is already running: open ${server}\n`);
    if (io.isTerminal || options.open === true) openBrowser(server, io);
    return;
  }
  const showPairing = async (why: string): Promise<void> => {
    if (options.lan !== true && options.pairAlways !== true) return;
    io.out(`${why}${await pairing(server, options.lan === true)}`);
  };
  isOpen = true;
  io.out(`plotwright is at ${server.url}\n`);
  await showPairing("");
  if (options.open === true) openBrowser(server.url, io);
  await stopped;
  await server.close();
  io.endWithin(LINGER_MS);
}

/** The server, or the address of the one that already uses this data folder. */
async function serverUnlessRunning(
  { data = defaultDataDir() }: ServeCommandOptions,
  options: ServerOptions,
): Promise<PlotwrightServer | string> {
  try {
    return await createServer(options);
  } catch (error) {
    const url = error instanceof PlotwrightError && error.code === "conflict" ? addressOfServer(data) : null;
    if (url === null) throw error;
    return url;
  }
}

async function pairing(server: PlotwrightServer, isLan: boolean): Promise<string> {
  const { protocol, port, hostname } = new URL(server.url);
  const address = isLan ? (lanAddresses()[0] ?? hostname) : hostname;
  return pairingText(`${protocol}//${address}:${port}`, server.pairing);
}

function tlsOf({ cert, key }: ServeCommandOptions): Pick<ServerOptions, "tls"> {
  if (cert === undefined && key === undefined) return {};
  if (cert === undefined || key === undefined) {
    throw new PlotwrightError("bad-setting", "--cert and --key go together.");
  }
  return { tls: { cert: readPem("--cert", cert), key: readPem("--key", key) } };
}

function readPem(option: "--cert" | "--key", path: string): string {
  try {
    return readText(path, option);
  } catch (cause) {
    if (cause instanceof PlotwrightError) throw cause;
    throw new PlotwrightError("bad-setting", `${option} ${path} can't be read: ${fileFault(cause)}.`, {
      cause,
    });
  }
}

function openBrowser(url: string, io: CliIo): void {
  const [command, ...args] =
    process.platform === "darwin"
      ? ["open"]
      : process.platform === "win32"
        ? ["cmd", "/c", "start", ""]
        : ["xdg-open"];
  const child = spawn(command, [...args, url], { stdio: "ignore", detached: true });
  child.on("error", () => io.err(`No browser could be opened: go to ${url}\n`));
  child.unref();
}
