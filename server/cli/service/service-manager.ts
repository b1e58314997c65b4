/** What systemd and launchd have in common for `plotwright service`: the computer, the options, and what a manager does. */
import { resolve } from "node:path";
import { PlotwrightError } from "../../../src/index.js";

export interface ServiceOptions {
  /** For the whole computer, started at boot; needs root. */
  readonly system?: boolean;
  /** The user that runs the server, with `system`. Default: the user who called sudo. */
  readonly user?: string;
  /** Only print what would be written. */
  readonly print?: boolean;
}

export interface CommandResult {
  readonly code: number;
  readonly text: string;
}

/** The parts of the computer that the command uses, as an interface for tests. */
export interface ServiceHost {
  readonly platform: NodeJS.Platform;
  readonly env: NodeJS.ProcessEnv;
  readonly home: string;
  readonly isRoot: boolean;
  /** The user's number, for launchd. */
  readonly uid: number;
  /** Folder of the system's services. */
  readonly systemDir: string;
  /** The running program: node and its script. */
  readonly node: string;
  readonly script: string;
  readonly run: (command: string, args: readonly string[]) => CommandResult;
  /** Whether a program listens on the port. */
  readonly isListening: (host: string, port: number) => Promise<boolean>;
  readonly wait: (ms: number) => Promise<void>;
}

/** What starts the server by itself, and again after a failure. */
export interface ServiceManager {
  /** The file that describes the service. */
  readonly path: string;
  text(serveArgs: readonly string[]): string;
  /** The file that has the values which other users of this computer must not read. */
  readonly secretsPath: string;
  /** A line of that file. */
  secretLine(name: string, value: string): string;
  /** Reads the written file, and starts the service, or starts it again. */
  start(): Promise<void>;
  /** Whether the server was started, and has not ended since. */
  isActive(): boolean;
  /** Stops it, and no longer starts it; nothing happens if it does not run. */
  stop(): void;
  /** Call after the file was removed. */
  forget(): void;
  status(): CommandResult;
  /** Why it runs only while the user is logged in, and what to do; null: it does not. */
  loginHint(): string | null;
  /** The command that shows its log. */
  readonly logCommand: string;
}

/** Options of `serve` whose value is a path. */
const PATH_OPTIONS = ["--data", "--watch", "--cert", "--key"];
/**
 * Options of `serve` whose value may contain a password, and the environment variable that `serve` reads instead. Everyone
 * on this computer can read a process's options in process lists, so these values are in a file of their own.
 */
const SECRET_OPTIONS: Readonly<Record<string, string>> = {
  "--shared-queue": "PLOTWRIGHT_SHARED_QUEUE",
  "--mqtt": "PLOTWRIGHT_MQTT",
};

/** `secrets`: by environment variable; as for commander, the last of an option counts. The paths are absolute. */
export function splitSecrets(args: readonly string[]): {
  readonly open: readonly string[];
  readonly secrets: ReadonlyMap<string, string>;
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
  return { open: wholePaths(open), secrets };
}

function wholePaths(args: readonly string[]): string[] {
  return args.map((arg, index) => {
    const [name = "", ...value] = arg.split("=");
    if (PATH_OPTIONS.includes(name) && value.length > 0) return `${name}=${resolve(value.join("="))}`;
    return PATH_OPTIONS.includes(args[index - 1] ?? "") ? resolve(arg) : arg;
  });
}

/** Never root: a server on a network needs only its files and its port. */
export function userOf({ user }: ServiceOptions, { env }: ServiceHost): string {
  const name = user ?? env["SUDO_USER"] ?? "";
  if (name === "" || name === "root" || !/^[a-z_][a-z0-9_.-]*$/i.test(name)) {
    throw new PlotwrightError(
      "bad-setting",
      "The server must not run as root: give its user with --user NAME.",
    );
  }
  return name;
}

/** Throws `bad-setting` if the command of the manager failed. */
export function mustSucceed({ code, text }: CommandResult, command: string): void {
  if (code === 0) return;
  const why = text.trim() === "" ? `code ${code}` : text.trim();
  throw new PlotwrightError("bad-setting", `${command} failed: ${why}`);
}
