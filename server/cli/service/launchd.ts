/** `plotwright service` on macOS: an agent of one user, or with --system a daemon, of launchd. */
import { existsSync } from "node:fs";
import { join } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import {
  mustSucceed,
  splitSecrets,
  userOf,
  type ServiceHost,
  type ServiceManager,
  type ServiceOptions,
} from "./service-manager.js";

const LABEL = "plotwright.server";
/** launchd refuses to load a service while it still ends the one before, which first lifts the pen and goes home. */
const ENDING_MS = 60_000;
const TRY_EVERY_MS = 1_000;

export function launchd(options: ServiceOptions, host: ServiceHost): ServiceManager {
  const isSystem = options.system === true;
  const domain = isSystem ? "system" : `gui/${host.uid}`;
  const target = `${domain}/${LABEL}`;
  const path = isSystem
    ? join(host.systemDir, `${LABEL}.plist`)
    : join(host.home, "Library", "LaunchAgents", `${LABEL}.plist`);
  const secretsPath = path.replace(/\.plist$/, ".env");
  // launchd may open it as root or as that user.
  const logs = isSystem ? join("/Users", userOf(options, host)) : host.home;
  const logPath = join(logs, "Library", "Logs", "plotwright.log");
  const printed = () => host.run("launchctl", ["print", target]);
  const isLoaded = (): boolean => printed().code === 0;
  const stop = (): void => void host.run("launchctl", ["bootout", target]);
  return {
    path,
    secretsPath,
    text: (serveArgs) =>
      plist(serveArgs, { host, logPath, secretsPath, user: isSystem ? userOf(options, host) : null }),
    secretLine: nodeEnvLine,
    start: async () => {
      if (isLoaded()) stop();
      for (let ms = 0; ms < ENDING_MS && isLoaded(); ms += TRY_EVERY_MS) await host.wait(TRY_EVERY_MS);
      // It may have been disabled by hand.
      host.run("launchctl", ["enable", target]);
      // Node reads it as that user.
      if (isSystem && existsSync(secretsPath)) host.run("chown", [userOf(options, host), secretsPath]);
      mustSucceed(
        host.run("launchctl", ["bootstrap", domain, path]),
        `launchctl bootstrap ${domain} ${path}`,
      );
    },
    isActive: () => /^\s*state = running$/m.test(printed().text),
    stop,
    forget: () => undefined,
    status: () => {
      const { code, text } = printed();
      const shown = text.split("\n").filter((line) => /^\s(path|state|pid|last exit code) = /.test(line));
      const isRunning = /^\s*state = running$/m.test(text);
      return {
        code: code === 0 && isRunning ? 0 : 3,
        text: `${shown.map((line) => line.trim()).join("\n")}\nlog: ${logPath}\n`,
      };
    },
    loginHint: () =>
      isSystem
        ? null
        : "It runs while you are logged in. To start it at boot, install it with sudo and --system.",
    logCommand: `tail -n 50 ${logPath}`,
  };
}

interface PlistParts {
  readonly host: ServiceHost;
  readonly logPath: string;
  readonly secretsPath: string;
  /** Null: the one whose agent it is. */
  readonly user: string | null;
}

function plist(serveArgs: readonly string[], { host, logPath, secretsPath, user }: PlistParts): string {
  const { open, secrets } = splitSecrets(serveArgs);
  // Node reads the file, since launchd has none for variables, and shows those of a plist to everyone.
  const env = secrets.size > 0 ? [`--env-file=${secretsPath}`] : [];
  const args = [host.node, ...env, host.script, "serve", ...open];
  const text = (value: string): string => `<string>${inXml(value)}</string>`;
  return [
    '<?xml version="1.0" encoding="UTF-8"?>',
    '<!DOCTYPE plist PUBLIC "-//Apple//DTD PLIST 1.0//EN" "http://www.apple.com/DTDs/PropertyList-1.0.dtd">',
    '<plist version="1.0">',
    "<dict>",
    `  <key>Label</key>${text(LABEL)}`,
    "  <key>ProgramArguments</key>",
    "  <array>",
    ...args.map((arg) => `    ${text(arg)}`),
    "  </array>",
    ...(user === null ? [] : [`  <key>UserName</key>${text(user)}`]),
    "  <key>RunAtLoad</key><true/>",
    "  <key>KeepAlive</key><dict><key>SuccessfulExit</key><false/></dict>",
    "  <!-- The pen is lifted and the carriage goes home before the server ends; a held plot stays where it is. -->",
    "  <key>ExitTimeOut</key><integer>60</integer>",
    "  <!-- Otherwise macOS may slow it down while it streams to the plotter. -->",
    "  <key>ProcessType</key><string>Interactive</string>",
    `  <key>StandardErrorPath</key>${text(logPath)}`,
    `  <key>StandardOutPath</key>${text(logPath)}`,
    "</dict>",
    "</plist>",
    "",
  ].join("\n");
}

/** Node takes the text between quotes as it is. */
function nodeEnvLine(name: string, value: string): string {
  const quote = ["'", '"', "`"].find((one) => !value.includes(one) && !(one === '"' && value.includes("\\")));
  if (quote === undefined || /[\r\n]/.test(value)) {
    throw new PlotwrightError(
      "bad-setting",
      `${name}: write the quotes in this address as %27, %22 and %60.`,
    );
  }
  return `${name}=${quote}${value}${quote}\n`;
}

const inXml = (text: string): string =>
  text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
