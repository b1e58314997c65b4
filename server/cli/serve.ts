/** `plotwright serve`: runs until it is told to stop. */
import { spawn } from "node:child_process";
import { createServer } from "../index.js";
import type { CliIo } from "./io.js";

export interface ServeCommandOptions {
  readonly port: number;
  readonly host: string;
  readonly allowHost?: readonly string[];
  readonly device?: string;
  readonly virtualSpeed?: number;
  readonly data?: string;
  readonly maxUploadMb: number;
  readonly open?: boolean;
}

export async function runServe(options: ServeCommandOptions, io: CliIo): Promise<void> {
  const stopped = new Promise<void>((resolve) => io.onInterrupt(() => resolve()));
  const server = await createServer({
    port: options.port,
    host: options.host,
    maxUploadBytes: options.maxUploadMb * 1e6,
    ...(options.allowHost === undefined ? {} : { allowedHosts: options.allowHost }),
    ...(options.device === undefined ? {} : { device: options.device }),
    ...(options.virtualSpeed === undefined ? {} : { virtualSpeed: options.virtualSpeed }),
    ...(options.data === undefined ? {} : { dataDir: options.data }),
    log: (line) => io.err(`${line}\n`),
  });
  io.out(`plotwright is at ${server.url}\n`);
  if (options.open === true) openBrowser(server.url, io);
  await stopped;
  await server.close();
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
