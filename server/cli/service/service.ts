/**
 * `plotwright service`: runs the server as a systemd service, for example on a Raspberry Pi: for one user, or
 * with --system for the whole computer.
 */
import { spawnSync } from "node:child_process";
import { chmodSync, existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { homedir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import { packagePath } from "../../storage/package-files.js";
import { fileFault } from "../../storage/file-fault.js";
import type { CliIo } from "../io.js";

export interface ServiceOptions {
  /** For the whole computer, started at boot; needs root. */
  readonly system?: boolean;
  /** The user that runs the server, with `system`. Default: the user who called sudo. */
  readonly user?: string;
  /** Only print what would be written. */
  readonly print?: boolean;
}

/** Options of the server that the service runs. */
export interface ServiceServer {
  /** As after `plotwright serve`; their paths are made absolute. */
  readonly args: readonly string[];
  readonly port: number;
  readonly host?: string;
}

interface CommandResult {
  readonly code: number;
  readonly text: string;
}

/** The parts of the computer that the command uses, as an interface for tests. */
export interface ServiceHost {
  readonly platform: NodeJS.Platform;
  readonly env: NodeJS.ProcessEnv;
  readonly home: string;
  readonly isRoot: boolean;
  /** Folder of the system's units. */
  readonly systemDir: string;
  /** The running program: node and its script. */
  readonly node: string;
  readonly script: string;
  readonly run: (command: string, args: readonly string[]) => CommandResult;
  /** Whether a program listens on the port. */
  readonly isListening: (host: string, port: number) => Promise<boolean>;
  readonly wait: (ms: number) => Promise<void>;
}

const UNIT = "plotwright.service";
/** The groups that serial ports belong to: uucp on Arch. Debian has both, and uses dialout. */
const SERIAL_GROUPS = ["dialout", "uucp"];
/** Options of `serve` whose value is a path. */
const PATH_OPTIONS = ["--data", "--watch", "--cert", "--key"];
/**
 * Options of `serve` whose value may contain a password, and the environment variable that `serve` reads instead. Everyone
 * on this computer can read a process's options in process lists and in `systemctl show`, so these values are in an
 * EnvironmentFile.
 */
const SECRET_OPTIONS: Readonly<Record<string, string>> = {
  "--shared-queue": "PLOTWRIGHT_SHARED_QUEUE",
  "--mqtt": "PLOTWRIGHT_MQTT",
};

/** How long a server may take to start, on a slow computer, and how often its port is tried meanwhile. */
const START_MS = 20_000;
const TRY_EVERY_MS = 500;

function thisHost(): ServiceHost {
  return {
    platform: process.platform,
    env: process.env,
    home: homedir(),
    isRoot: process.getuid?.() === 0,
    systemDir: "/etc/systemd/system",
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

/** Throws `conflict` if another program has the port, `disconnected` if the server does not answer in time. */
export async function installService(
  options: ServiceOptions,
  server: ServiceServer,
  io: CliIo,
  host: ServiceHost = thisHost(),
): Promise<void> {
  const unit = unitText(options, server.args, host);
  const secrets = secretsText(server.args);
  const path = unitPath(options, host);
  const secretsPath = secretsPathOf(options, host);
  if (options.print === true) {
    io.out(`# ${path}\n${unit}`);
    if (secrets !== "") io.out(`# ${secretsPath}\n${secrets.replace(/=.*$/gm, "=…")}`);
    return;
  }
  mustHaveSystemd(options, host);
  if (host.script.includes("/_npx/")) {
    throw new PlotwrightError(
      "bad-setting",
      "npx keeps programs only for a while. Install plotwright first: npm install -g plotwright.",
    );
  }
  await mustBeFree(options, server, host);
  if (secrets === "") rmSync(secretsPath, { force: true });
  else writePrivate(secretsPath, secrets);
  writePrivate(path, unit);
  systemctl(options, host, ["daemon-reload"]);
  systemctl(options, host, ["enable", UNIT]);
  // Restart, not start: a running server must use the new unit.
  systemctl(options, host, ["restart", UNIT]);
  io.out(`${path} is written.\n`);
  if (options.system !== true && host.run("loginctl", ["enable-linger"]).code !== 0) {
    io.err("It runs only while you are logged in. To change that: sudo loginctl enable-linger $USER\n");
  }
  await mustRun(options, server, host);
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
async function mustBeFree(options: ServiceOptions, server: ServiceServer, host: ServiceHost): Promise<void> {
  const { port } = server;
  // A service that runs already has the port itself, and is restarted.
  if (port === 0 || isActive(options, host) || !(await host.isListening(hostOf(server), port))) return;
  throw new PlotwrightError(
    "conflict",
    `Another program has port ${port}, perhaps a plotwright server in a terminal. Stop it, or choose another port: plotwright service install -- --port 9381.`,
  );
}

/** Waits until the server listens. Port 0 is any free port, so then only systemd is asked. */
async function mustRun(options: ServiceOptions, server: ServiceServer, host: ServiceHost): Promise<void> {
  const { port } = server;
  for (let ms = 0; ms < START_MS; ms += TRY_EVERY_MS) {
    await host.wait(TRY_EVERY_MS);
    if (!isActive(options, host)) break;
    if (port === 0 || (await host.isListening(hostOf(server), port))) return;
  }
  const user = options.system === true ? "" : "--user ";
  throw new PlotwrightError(
    "disconnected",
    `The service is installed, but its server ${isActive(options, host) ? `does not answer on port ${port} yet` : "has ended"}. Its log says why: journalctl ${user}-u ${UNIT}`,
  );
}

const hostOf = ({ host }: ServiceServer): string => host ?? "127.0.0.1";

/** Whether systemd has started the server, and it has not ended since. */
const isActive = (options: ServiceOptions, host: ServiceHost): boolean =>
  host.run("systemctl", [...scope(options), "is-active", "--quiet", UNIT]).code === 0;

export function uninstallService(options: ServiceOptions, io: CliIo, host: ServiceHost = thisHost()): void {
  const path = unitPath(options, host);
  if (!existsSync(path)) {
    throw new PlotwrightError("not-found", `There is no ${path}, so no service is installed.`);
  }
  mustHaveSystemd(options, host);
  // Remove the unit even if the server is not running.
  host.run("systemctl", [...scope(options), "disable", "--now", UNIT]);
  rmSync(path);
  rmSync(secretsPathOf(options, host), { force: true });
  systemctl(options, host, ["daemon-reload"]);
  io.out(`${path} is removed. Jobs and settings are kept.\n`);
}

/** 0 if it runs, otherwise 3, as systemctl returns. */
export function serviceStatus(options: ServiceOptions, io: CliIo, host: ServiceHost = thisHost()): number {
  const path = unitPath(options, host);
  if (!existsSync(path)) {
    io.out(`not installed (no ${path})\n`);
    return 3;
  }
  const { code, text } = host.run("systemctl", [
    ...scope(options),
    "status",
    "--no-pager",
    "--lines=10",
    UNIT,
  ]);
  io.out(text);
  return code === 0 ? 0 : 3;
}

export function unitText(options: ServiceOptions, serveArgs: readonly string[], host: ServiceHost): string {
  const isSystem = options.system === true;
  const { open, secrets } = splitSecrets(serveArgs);
  const args = [host.node, host.script, "serve", ...wholePaths(open)];
  return [
    "[Unit]",
    "Description=plotwright, the pen plotter's server",
    ...(isSystem ? ["Wants=network-online.target", "After=network-online.target"] : []),
    "",
    "[Service]",
    // With the default, simple, a restart succeeds even if the user or node does not exist.
    "Type=exec",
    `ExecStart=${args.map(quoted).join(" ")}`,
    // Not quoted: systemd takes the rest of the line as the path.
    ...(secrets.size > 0 ? [`EnvironmentFile=${secretsPathOf(options, host).replace(/%/g, "%%")}`] : []),
    ...(isSystem ? [`User=${userOf(options, host)}`, ...serialGroupLine(host)] : []),
    "Restart=on-failure",
    "RestartSec=3",
    "# The pen is lifted and the carriage goes home before the server ends; a held plot stays where it is.",
    "TimeoutStopSec=60",
    "NoNewPrivileges=yes",
    "",
    "[Install]",
    `WantedBy=${isSystem ? "multi-user.target" : "default.target"}`,
    "",
  ].join("\n");
}

/** `secrets`: by environment variable; as for commander, the last of an option counts. */
function splitSecrets(args: readonly string[]): {
  open: readonly string[];
  secrets: ReadonlyMap<string, string>;
} {
  const open: string[] = [];
  const secrets = new Map<string, string>();
  for (let i = 0; i < args.length; i++) {
    const arg = args[i] ?? "";
    const [name = "", ...value] = arg.split("=");
    const variable = SECRET_OPTIONS[name];
    if (variable === undefined) open.push(arg);
    else secrets.set(variable, value.length > 0 ? value.join("=") : (args[++i] ?? ""));
  }
  return { open, secrets };
}

/** The text of the EnvironmentFile, with the characters escaped that systemd interprets; "" if nothing is secret. */
const secretsText = (args: readonly string[]): string =>
  [...splitSecrets(args).secrets]
    .map(([name, value]) => `${name}="${value.replace(/[\\"`$]/g, "\\$&")}"\n`)
    .join("");

const secretsPathOf = (options: ServiceOptions, host: ServiceHost): string =>
  unitPath(options, host).replace(/\.service$/, ".env");

/** Left out if this computer has neither group: systemd would not start the server. */
function serialGroupLine({ run }: ServiceHost): string[] {
  // Not /etc/group: getent finds the groups that systemd finds, also those kept elsewhere, as Fedora Atomic does.
  const group = serialGroup(run("getent", ["group", ...SERIAL_GROUPS]).text);
  return group === undefined ? [] : [`SupplementaryGroups=${group}`];
}

/** `groups`: lines as in /etc/group. */
export const serialGroup = (groups: string): string | undefined =>
  SERIAL_GROUPS.find((name) => groups.split("\n").some((line) => line.startsWith(`${name}:`)));

function unitPath({ system }: ServiceOptions, { systemDir, env, home }: ServiceHost): string {
  if (system === true) return join(systemDir, UNIT);
  const config = env["XDG_CONFIG_HOME"];
  const base = config !== undefined && config !== "" ? config : join(home, ".config");
  return join(base, "systemd", "user", UNIT);
}

/** Never root: a server on a network needs only its files and its port. */
function userOf({ user }: ServiceOptions, { env }: ServiceHost): string {
  const name = user ?? env["SUDO_USER"] ?? "";
  if (name === "" || name === "root" || !/^[a-z_][a-z0-9_.-]*$/i.test(name)) {
    throw new PlotwrightError(
      "bad-setting",
      "The server must not run as root: give its user with --user NAME.",
    );
  }
  return name;
}

function wholePaths(args: readonly string[]): string[] {
  return args.map((arg, index) => {
    const [name = "", ...value] = arg.split("=");
    if (PATH_OPTIONS.includes(name) && value.length > 0) return `${name}=${resolve(value.join("="))}`;
    return PATH_OPTIONS.includes(args[index - 1] ?? "") ? resolve(arg) : arg;
  });
}

/** Quoted for systemd, with its special % and $ escaped. */
function quoted(arg: string): string {
  const text = arg.replace(/[\\"]/g, "\\$&").replace(/%/g, "%%").replace(/\$/g, "$$$$").replace(/\n/g, "\\n");
  return /^[\w@+=:,./-]+$/.test(arg) ? text : `"${text}"`;
}

const scope = ({ system }: ServiceOptions): string[] => (system === true ? [] : ["--user"]);

function systemctl(options: ServiceOptions, host: ServiceHost, args: readonly string[]): void {
  const { code, text } = host.run("systemctl", [...scope(options), ...args]);
  if (code === 0) return;
  throw new PlotwrightError(
    "bad-setting",
    `systemctl ${args.join(" ")} failed: ${text.trim() === "" ? `code ${code}` : text.trim()}`,
  );
}

function mustHaveSystemd({ system }: ServiceOptions, { platform, isRoot }: ServiceHost): void {
  if (platform !== "linux") {
    throw new PlotwrightError("bad-setting", "Services are set up by systemd, which only Linux has.");
  }
  if (system === true && !isRoot) {
    throw new PlotwrightError("not-allowed", "--system writes to /etc: run it with sudo, or leave it out.");
  }
}
