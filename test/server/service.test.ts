/** The systemd service and the logs, on a simulated computer that only records its commands. */
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { homedir, tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import type { CliIo } from "../../server/cli/io.js";
import { runCli } from "../../server/cli/program.js";
import { runLogs } from "../../server/cli/logs.js";
import {
  installService,
  serialGroup,
  serviceStatus,
  uninstallService,
  unitText,
  type ServiceHost,
} from "../../server/cli/service.js";
import { LogBook, readLog, withoutSecrets } from "../../server/storage/log-book.js";

let home: string;
let out: string;
let asked: string[];
let failing: string | null;
let groups: string;

beforeEach(() => {
  home = mkdtempSync(join(tmpdir(), "plotwright-service-"));
  [out, asked, failing, groups] = ["", [], null, "dialout:x:20:\n"];
});
afterEach(() => rmSync(home, { recursive: true, force: true }));

const io: CliIo = {
  out: (text) => (out += text),
  err: (text) => (out += text),
  isTerminal: false,
  hasKeyboard: false,
  onInterrupt: () => () => undefined,
  endWithin: () => undefined,
  onLine: () => () => undefined,
};
const host = (more: Partial<ServiceHost> = {}): ServiceHost => ({
  platform: "linux",
  env: {},
  home,
  isRoot: false,
  systemDir: join(home, "etc"),
  node: "/usr/bin/node",
  script: "/usr/lib/node_modules/plotwright/dist/server/main.js",
  run: (command, args) => {
    asked.push(`${command} ${args.join(" ")}`);
    if (command === "getent") return { code: 2, text: groups };
    return args.includes(failing ?? "")
      ? { code: 1, text: "no bus" }
      : { code: 0, text: "active (running)\n" };
  },
  ...more,
});
const userUnit = (): string => join(home, ".config/systemd/user/plotwright.service");

describe("plotwright service", () => {
  it("installs a user's unit, starts it, reports its state, and removes it again", () => {
    installService({}, ["--lan", "--data", "relative/plots"], io, host());
    const unit = readFileSync(userUnit(), "utf8");
    const script = "/usr/lib/node_modules/plotwright/dist/server/main.js";
    expect(unit).toContain(
      `\nExecStart=/usr/bin/node ${script} serve --lan --data ${join(process.cwd(), "relative/plots")}\n`,
    );
    expect(unit).toMatch(/\nType=exec\nExecStart=/);
    expect(unit).toMatch(/\nRestart=on-failure\n/);
    expect(unit).toMatch(/\nWantedBy=default\.target\n$/);
    expect(unit).not.toMatch(/User=/);
    expect(asked).toEqual([
      "systemctl --user daemon-reload",
      "systemctl --user enable plotwright.service",
      "systemctl --user restart plotwright.service",
      "loginctl enable-linger",
    ]);
    expect(serviceStatus({}, io, host())).toBe(0);
    uninstallService({}, io, host());
    expect(existsSync(userUnit())).toBe(false);
    expect(serviceStatus({}, io, host())).toBe(3);
    expect(() => uninstallService({}, io, host())).toThrow("no service is installed");
  });

  it("installs the system's unit for root only, and runs it as another user", () => {
    const system = { system: true };
    const asRoot = host({ isRoot: true, env: { SUDO_USER: "ada" } });
    expect(() => installService({ system: true, user: "ada" }, [], io, host())).toThrow("run it with sudo");
    expect(() => unitText(system, [], host({ isRoot: true }))).toThrow("--user NAME");
    expect(() => unitText({ system: true, user: "root" }, [], asRoot)).toThrow("must not run as root");
    expect(() => unitText({ system: true, user: "a\nExecStart=x" }, [], asRoot)).toThrow("--user NAME");
    installService(system, [], io, asRoot);
    const unit = readFileSync(join(home, "etc/plotwright.service"), "utf8");
    expect(unit).toMatch(/\nUser=ada\nSupplementaryGroups=dialout\n/);
    expect(unit).toMatch(/\nWantedBy=multi-user\.target\n$/);
    expect(asked).not.toContain("loginctl enable-linger");
  });

  it("gives the system's server the group of the serial ports, if there is one", () => {
    const unit = (): string => unitText({ system: true, user: "ada" }, [], host());
    groups = "uucp:x:986:\n";
    expect(unit()).toContain("\nSupplementaryGroups=uucp\n");
    groups = "";
    expect(unit()).not.toContain("SupplementaryGroups");
    expect(serialGroup("uucp:x:10:\ndialout:x:20:ada\n")).toBe("dialout");
    expect(serialGroup("mydialout:x:1:\nusers:x:100:dialout,uucp\n")).toBeUndefined();
  });

  it("only shows the unit with --print", async () => {
    expect(await runCli(["service", "install", "--print", "--", "--port", "9081"], io, "1.0.0")).toBe(0);
    expect(out).toMatch(/^# .*plotwright\.service\n\[Unit\]/);
    expect(out).toMatch(/ serve --port 9081\n/);
    expect(await runCli(["service", "install", "--print", "--", "--prot", "9081"], io, "1.0.0")).toBe(2);
  });

  it("quotes what systemd would interpret", () => {
    const unit = unitText({}, ["--watch", '/my "plots"/100%/$HOME'], host());
    expect(unit).toContain(' --watch "/my \\"plots\\"/100%%/$$HOME"\n');
  });

  it("explains if there is no systemd, or if it refuses", () => {
    expect(() => installService({}, [], io, host({ platform: "darwin" }))).toThrow("only Linux has");
    expect(() => installService({}, [], io, host({ script: "/home/a/.npm/_npx/1/main.js" }))).toThrow(
      "npm install -g",
    );
    failing = "enable";
    expect(() => installService({}, [], io, host())).toThrow(
      "systemctl enable plotwright.service failed: no bus",
    );
  });
});

describe("the logs", () => {
  it("are kept over restarts, at most two files, one line per entry", () => {
    new LogBook(home).write("first\nline");
    const book = new LogBook(home);
    for (let line = 0; line < 30; line++) book.write("x".repeat(100_000));
    book.write("last line");
    const text = readLog(home);
    expect(text).toMatch(/ last line\n$/);
    expect(text.length).toBeLessThan(2_300_000);
    expect(
      text
        .split("\n")
        .slice(0, -1)
        .every((line) => /^\d{4}-\d\d-\d\dT[\d:.]+Z /.test(line)),
    ).toBe(true);
  });

  it("are printed with versions, without secrets, also if no server runs", async () => {
    const book = new LogBook(home);
    book.write("paired 192.168.1.7");
    book.write("GET /pair?token=SECRETTOKEN with Bearer SECRETKEY at https://ada:SECRETWORD@example.org/x");
    await runLogs({ data: home, port: 1 }, io, "1.2.3");
    expect(out).toMatch(new RegExp(`^plotwright 1\\.2\\.3, Node ${process.version.replace(/\./g, "\\.")}, `));
    expect(out).toContain("paired 192.168.1.7");
    expect(out).not.toContain("SECRET");
    const file = join(home, "logs.txt");
    await runLogs({ data: home, port: 1, out: file }, io, "1.2.3");
    expect(readFileSync(file, "utf8")).toContain("paired 192.168.1.7");
  });

  it("do not contain the path of the user's folder", () => {
    expect(withoutSecrets(`${join(homedir(), "plots/a.svg")} is torn`)).toBe("~/plots/a.svg is torn");
  });

  it("do not stop the server if they can't be written", () => {
    expect(() => new LogBook(join(home, "none")).write("x")).not.toThrow();
  });
});
