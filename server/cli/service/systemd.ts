/** `plotwright service` on Linux: a unit of systemd, of one user or of the system. */
import { join } from "node:path";
import {
  mustSucceed,
  splitSecrets,
  userOf,
  type ServiceHost,
  type ServiceManager,
  type ServiceOptions,
} from "./service-manager.js";

const UNIT = "plotwright.service";
/** The groups that serial ports belong to: uucp on Arch. Debian has both, and uses dialout. */
const SERIAL_GROUPS = ["dialout", "uucp"];

export function systemd(options: ServiceOptions, host: ServiceHost): ServiceManager {
  const systemctl = (...args: readonly string[]) => host.run("systemctl", [...scope(options), ...args]);
  const must = (...args: readonly string[]): void =>
    mustSucceed(systemctl(...args), `systemctl ${args.join(" ")}`);
  return {
    path: unitPath(options, host),
    text: (serveArgs) => unitText(options, serveArgs, host),
    secretsPath: secretsPathOf(options, host),
    // With the characters escaped that systemd interprets.
    secretLine: (name, value) => `${name}="${value.replace(/[\\"`$]/g, "\\$&")}"\n`,
    start: () => {
      must("daemon-reload");
      must("enable", UNIT);
      // Restart, not start: a running server must use the new unit.
      must("restart", UNIT);
      return Promise.resolve();
    },
    isActive: () => systemctl("is-active", "--quiet", UNIT).code === 0,
    stop: () => void systemctl("disable", "--now", UNIT),
    forget: () => must("daemon-reload"),
    status: () => systemctl("status", "--no-pager", "--lines=10", UNIT),
    loginHint: () =>
      options.system === true || host.run("loginctl", ["enable-linger"]).code === 0
        ? null
        : "It runs only while you are logged in. To change that: sudo loginctl enable-linger $USER",
    logCommand: `journalctl ${options.system === true ? "" : "--user "}-u ${UNIT}`,
  };
}

export function unitText(options: ServiceOptions, serveArgs: readonly string[], host: ServiceHost): string {
  const isSystem = options.system === true;
  const { open, secrets } = splitSecrets(serveArgs);
  const args = [host.node, host.script, "serve", ...open];
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

/** Quoted for systemd, with its special % and $ escaped. */
function quoted(arg: string): string {
  const text = arg.replace(/[\\"]/g, "\\$&").replace(/%/g, "%%").replace(/\$/g, "$$$$").replace(/\n/g, "\\n");
  return /^[\w@+=:,./-]+$/.test(arg) ? text : `"${text}"`;
}

const scope = ({ system }: ServiceOptions): string[] => (system === true ? [] : ["--user"]);
