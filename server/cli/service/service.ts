/**
 * `plotwright service`: runs the server as a service of systemd or launchd, for example on a Raspberry Pi or a Mac mini: for one
 * user, or with --system for the whole computer.
 */
import { spawnSync } from "node:child_process";
import { chmodSync, existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { homedir } from "node:os";
import { dirname } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import { packagePath } from "../../storage/package-files.js";
import { fileFault } from "../../storage/file-fault.js";
import type { CliIo } from "../io.js";
import { launchd } from "./launchd.js";
import {
  splitSecrets,
  type ServiceHost,
  type ServiceManager,
  type ServiceOptions,
} from "./service-manager.js";
import { systemd } from "./systemd.js";

/** Options of the server that the service runs. */
export interface ServiceServer {
  /** As after `plotwright serve`; their paths are made absolute. */
  readonly args: readonly string[];
  readonly port: number;
  readonly host?: string;
}

/** How long a server may take to start, on a slow computer, and how often its port is tried meanwhile. */
const START_MS = 20_000;
const TRY_EVERY_MS = 500;

function thisHost(): ServiceHost {
  return {
    platform: process.platform,
    env: process.env,
    home: homedir(),
    isRoot: process.getuid?.() === 0,
    uid: process.getuid?.() ?? 0,
    systemDir: process.platform === "darwin" ? "/Library/LaunchDaemons" : "/etc/systemd/system",
    node: process.execPath,
    script: packagePath("dist/server/main.js"),
    run: (command, args) => {
      const { status, stdout, stderr, error } = spawnSync(command, args, { encoding: "utf8" });
      return { code: error === undefined ? (status ?? 1) : 127, text: `${stdout ?? ""}${stderr ?? ""}` };
    },
    isListening,
    wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
  };
}

export function isListening(host: string, port: number): Promise<boolean> {
  return new Promise((resolve) => {
    const socket = connect({ host, port, timeout: TRY_EVERY_MS });
    const end = (isOpen: boolean): void => {
      socket.destroy();
      resolve(isOpen);
    };
    socket.on("connect", () => end(true));
    socket.on("timeout", () => end(false));
    socket.on("error", () => end(false));
  });
}

const managerOf = (options: ServiceOptions, host: ServiceHost): ServiceManager =>
  host.platform === "darwin" ? launchd(options, host) : systemd(options, host);

/** Throws `conflict` if another program has the port, `disconnected` if the server does not answer in time. */
export async function installService(
  options: ServiceOptions,
  server: ServiceServer,
  io: CliIo,
  host: ServiceHost = thisHost(),
): Promise<void> {
  const manager = managerOf(options, host);
  const { path, secretsPath } = manager;
  const text = manager.text(server.args);
  const { secrets } = splitSecrets(server.args);
  const secretsText = [...secrets].map(([name, value]) => manager.secretLine(name, value)).join("");
  if (options.print === true) {
    io.out(`# ${path}\n${text}`);
    if (secretsText !== "") io.out(`# ${secretsPath}\n${secretsText.replace(/=.*$/gm, "=…")}`);
    return;
  }
  mustHaveManager(options, host);
  if (host.script.includes("/_npx/")) {
    throw new PlotwrightError(
      "bad-setting",
      "With npx, a program is kept only for a while. Install plotwright first: npm install -g plotwright.",
    );
  }
  await mustBeFree(manager, server, host);
  if (secretsText === "") rmSync(secretsPath, { force: true });
  else writePrivate(secretsPath, secretsText);
  writePrivate(path, text);
  await manager.start();
  io.out(`${path} is written.\n`);
  const hint = manager.loginHint();
  if (hint !== null) io.err(`${hint}\n`);
  await mustRun(manager, server, host);
  const state = server.port === 0 ? "was started" : `runs on port ${server.port}`;
  io.out(`The server ${state}. It starts again by itself.\n`);
}

function writePrivate(path: string, text: string): void {
  try {
    mkdirSync(dirname(path), { recursive: true });
    // The mode alone does not change that of a file which exists already.
    if (existsSync(path)) chmodSync(path, 0o600);
    writeFileSync(path, text, { mode: 0o600 });
  } catch (cause) {
    throw new PlotwrightError("bad-setting", `${path} can't be written: ${fileFault(cause)}.`, { cause });
  }
}

/** Another program on the port would look like the server. */
async function mustBeFree(manager: ServiceManager, server: ServiceServer, host: ServiceHost): Promise<void> {
  const { port } = server;
  // A service that runs already has the port itself, and is restarted.
  if (port === 0 || manager.isActive() || !(await host.isListening(hostOf(server), port))) return;
  throw new PlotwrightError(
    "conflict",
    `Another program has port ${port}, perhaps a plotwright server in a terminal. Stop it, or choose another port: plotwright service install -- --port 9381.`,
  );
}

/** Waits until the server listens. Port 0 is any free port, so then only the manager is asked. */
async function mustRun(manager: ServiceManager, server: ServiceServer, host: ServiceHost): Promise<void> {
  const { port } = server;
  for (let ms = 0; ms < START_MS; ms += TRY_EVERY_MS) {
    await host.wait(TRY_EVERY_MS);
    if (!manager.isActive()) break;
    if (port === 0 || (await host.isListening(hostOf(server), port))) return;
  }
  throw new PlotwrightError(
    "disconnected",
    `The service is installed, but its server ${manager.isActive() ? `does not answer on port ${port} yet` : "has ended"}. Its log says why: ${manager.logCommand}`,
  );
}

const hostOf = ({ host }: ServiceServer): string => host ?? "127.0.0.1";

export function uninstallService(options: ServiceOptions, io: CliIo, host: ServiceHost = thisHost()): void {
  const manager = managerOf(options, host);
  const { path, secretsPath } = manager;
  if (!existsSync(path)) {
    throw new PlotwrightError("not-found", `There is no ${path}, so no service is installed.`);
  }
  mustHaveManager(options, host);
  // Remove the files even if the server is not running.
  manager.stop();
  rmSync(path);
  rmSync(secretsPath, { force: true });
  manager.forget();
  io.out(`${path} is removed. Jobs and settings are kept.\n`);
}

/** 0 if it runs, otherwise 3, as systemctl returns. */
export function serviceStatus(options: ServiceOptions, io: CliIo, host: ServiceHost = thisHost()): number {
  const manager = managerOf(options, host);
  if (!existsSync(manager.path)) {
    io.out(`not installed (no ${manager.path})\n`);
    return 3;
  }
  const { code, text } = manager.status();
  io.out(text);
  return code === 0 ? 0 : 3;
}

function mustHaveManager({ system }: ServiceOptions, { platform, isRoot }: ServiceHost): void {
  if (platform !== "linux" && platform !== "darwin") {
    throw new PlotwrightError(
      "bad-setting",
      "Services are set up by systemd on Linux and by launchd on macOS. This system has neither.",
    );
  }
  if (system === true && !isRoot) {
    const where = platform === "darwin" ? "/Library" : "/etc";
    throw new PlotwrightError(
      "not-allowed",
      `--system writes to ${where}: run it with sudo, or leave it out.`,
    );
  }
}
