/** The services of systemd and launchd, and the logs, on a simulated computer that only records its commands. */
import { spawnSync } from "node:child_process";
import { Readable } from "node:stream";
import { chmodSync, existsSync, readFileSync, statSync } from "node:fs";
import { createServer, type AddressInfo } from "node:net";
import { homedir } from "node:os";
import { join } from "node:path";
import { beforeEach, describe, expect, it } from "vitest";
import type { CliIo } from "../../../server/cli/io.js";
import { runCli } from "../../../server/cli/program.js";
import { runLogs } from "../../../server/cli/service/server-commands.js";
import {
  installService,
  isListening,
  serviceStatus,
  uninstallService,
  type ServiceServer,
} from "../../../server/cli/service/service.js";
import type { ServiceHost } from "../../../server/cli/service/service-manager.js";
import { serialGroup, unitText } from "../../../server/cli/service/systemd.js";
import { LogBook, readLog, withoutSecrets } from "../../../server/storage/log-book.js";
import { folderOfTest } from "../../support/processes/folders.js";

let home: string;
let out: string;
let asked: string[];
let failing: string | null;
let groups: string;
/** Whether systemd counts the server as running, and whether its port answers, by the number of the question. */
let active: (question: number) => boolean;
let answering: (question: number) => boolean;
let waitedMs: number;

beforeEach(() => {
  home = folderOfTest();
  [out, asked, failing, groups] = ["", [], null, "dialout:x:20:\n"];
  [active, answering, waitedMs] = [(question) => question > 0, (question) => question > 0, 0];
});

const io: CliIo = {
  out: (text) => (out += text),
  err: (text) => (out += text),
  isTerminal: false,
  status: () => undefined,
  hasKeyboard: false,
  onInterrupt: () => () => undefined,
  endWithin: () => undefined,
  onLine: () => () => undefined,
  inputLines: () => Readable.from([]),
};
const host = (more: Partial<ServiceHost> = {}): ServiceHost => ({
  platform: "linux",
  env: {},
  home,
  isRoot: false,
  uid: 501,
  systemDir: join(home, "etc"),
  node: "/usr/bin/node",
  script: "/usr/lib/node_modules/plotwright/dist/server/main.js",
  run: (command, args) => {
    asked.push(`${command} ${args.join(" ")}`);
    if (command === "getent") return { code: 2, text: groups };
    if (args.includes("is-active")) return { code: active(questionsBefore("is-active")) ? 0 : 3, text: "" };
    return args.includes(failing ?? "")
      ? { code: 1, text: "no bus" }
      : { code: 0, text: "active (running)\n" };
  },
  isListening: (address, port) => {
    asked.push(`connect ${address} ${port}`);
    return Promise.resolve(answering(questionsBefore("connect")));
  },
  wait: (ms) => {
    waitedMs += ms;
    return Promise.resolve();
  },
  ...more,
});
/** Not counting the one that is asked now. */
const questionsBefore = (what: string): number => asked.filter((line) => line.includes(what)).length - 1;
const serve = (...args: string[]): ServiceServer => ({ args, port: 9080 });
const userUnit = (): string => join(home, ".config/systemd/user/plotwright.service");

describe("plotwright service", () => {
  it("installs a user's unit, starts it, reports its state, and removes it again", async () => {
    await installService({}, serve("--lan", "--data", "relative/plots"), io, host());
    const unit = readFileSync(userUnit(), "utf8");
    const script = "/usr/lib/node_modules/plotwright/dist/server/main.js";
    expect(unit).toContain(
      `\nExecStart=/usr/bin/node ${script} serve --lan --data ${join(process.cwd(), "relative/plots")}\n`,
    );
    expect(statSync(userUnit()).mode & 0o777).toBe(0o600);
    expect(unit).toMatch(/\nType=exec\nExecStart=/);
    expect(unit).toMatch(/\nRestart=on-failure\n/);
    expect(unit).toMatch(/\nWantedBy=default\.target\n$/);
    expect(unit).not.toMatch(/User=/);
    const isActive = "systemctl --user is-active --quiet plotwright.service";
    const connect = "connect 127.0.0.1 9080";
    expect(asked).toEqual([
      ...[isActive, connect],
      "systemctl --user daemon-reload",
      "systemctl --user enable plotwright.service",
      "systemctl --user restart plotwright.service",
      "loginctl enable-linger",
      ...[isActive, connect],
    ]);
    expect(out).toBe(`${userUnit()} is written.\nThe server runs on port 9080. It starts again by itself.\n`);
    expect(serviceStatus({}, io, host())).toBe(0);
    uninstallService({}, io, host());
    expect(existsSync(userUnit())).toBe(false);
    expect(serviceStatus({}, io, host())).toBe(3);
    expect(() => uninstallService({}, io, host())).toThrow("no service is installed");
  });

  it("installs the system's unit for root only, and runs it as another user", async () => {
    const system = { system: true };
    const asRoot = host({ isRoot: true, env: { SUDO_USER: "ada" } });
    await expect(installService({ system: true, user: "ada" }, serve(), io, host())).rejects.toThrow(
      "run it with sudo",
    );
    expect(() => unitText(system, [], host({ isRoot: true }))).toThrow("--user NAME");
    expect(() => unitText({ system: true, user: "root" }, [], asRoot)).toThrow("must not run as root");
    expect(() => unitText({ system: true, user: "a\nExecStart=x" }, [], asRoot)).toThrow("--user NAME");
    await installService(system, serve(), io, asRoot);
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

  it.each([
    { system: false, given: (url: string) => ["--shared-queue", url] },
    { system: true, given: (url: string) => [`--shared-queue=${url}`] },
  ])("keeps a database's password out of the unit, in a private file (%o)", async ({ system, given }) => {
    const url = 'postgres://ada:s3cret$1"\\=x@db.example/plots?sslmode=require';
    const options = { system, ...(system && { user: "ada" }) };
    const computer = host({ isRoot: system });
    const path = system ? join(home, "etc/plotwright.service") : userUnit();
    const secrets = path.replace(".service", ".env");
    await installService(options, serve("--lan", ...given(url), "--no-mdns"), io, computer);
    const unit = readFileSync(path, "utf8");
    expect(unit).toMatch(/ serve --lan --no-mdns\nEnvironmentFile=/);
    expect(unit).toContain(`\nEnvironmentFile=${secrets}\n`);
    expect(unit).not.toMatch(/s3cret|postgres/);
    expect(readFileSync(secrets, "utf8")).toBe(
      'PLOTWRIGHT_SHARED_QUEUE="postgres://ada:s3cret\\$1\\"\\\\=x@db.example/plots?sslmode=require"\n',
    );
    expect(statSync(secrets).mode & 0o777).toBe(0o600);
    expect(out + asked.join("\n")).not.toContain("s3cret");
    // Private again, also if someone has opened it, and gone with the option.
    chmodSync(secrets, 0o644);
    active = () => true;
    await installService(options, serve(...given("postgres://db/plots")), io, computer);
    expect(statSync(secrets).mode & 0o777).toBe(0o600);
    await installService(options, serve("--lan"), io, computer);
    expect(existsSync(secrets)).toBe(false);
    expect(readFileSync(path, "utf8")).not.toContain("EnvironmentFile");
    await installService(options, serve(...given(url)), io, computer);
    uninstallService(options, io, computer);
    expect(existsSync(secrets)).toBe(false);
  });

  it("shows where a password goes with --print, but not the password", async () => {
    const args = ["service", "install", "--print", "--", "--shared-queue", "postgres://ada:s3cret@db/plots"];
    expect(await runCli(args, io, "1.0.0")).toBe(0);
    expect(out).toMatch(/\n# .*plotwright\.env\nPLOTWRIGHT_SHARED_QUEUE=…\n$/);
    expect(out).not.toContain("s3cret");
  });

  it("keeps the address of an MQTT broker, which may have a password, in that file too", async () => {
    await installService({}, serve("--mqtt", "mqtt://ada:s3cret@broker.example"), io, host());
    expect(readFileSync(userUnit(), "utf8")).not.toContain("s3cret");
    const secrets = readFileSync(userUnit().replace(".service", ".env"), "utf8");
    expect(secrets).toBe('PLOTWRIGHT_MQTT="mqtt://ada:s3cret@broker.example"\n');
  });

  it("quotes what systemd would interpret", () => {
    const unit = unitText({}, ["--watch", '/my "plots"/100%/$HOME'], host());
    expect(unit).toContain(' --watch "/my \\"plots\\"/100%%/$$HOME"\n');
  });

  it("explains if there is no systemd, or if it refuses", async () => {
    const install = (more: Partial<ServiceHost> = {}): Promise<void> =>
      installService({}, serve(), io, host(more));
    await expect(install({ platform: "win32" })).rejects.toThrow("This system has neither");
    await expect(install({ script: "/home/a/.npm/_npx/1/main.js" })).rejects.toThrow("npm install -g");
    failing = "enable";
    await expect(install()).rejects.toThrow("systemctl enable plotwright.service failed: no bus");
  });

  it("waits until the server answers on its port, and says so only then", async () => {
    answering = (question) => question > 4;
    await installService({}, { args: [], port: 9381, host: "192.168.1.7" }, io, host());
    expect([asked.at(-1), waitedMs]).toEqual(["connect 192.168.1.7 9381", 2_500]);
    expect(out).toContain("The server runs on port 9381.");
  });

  it("names the log if the server has ended, or does not answer", async () => {
    // It starts, and ends because another server has its data folder.
    active = (question) => question === 1;
    answering = () => false;
    await expect(installService({}, serve(), io, host())).rejects.toThrow(
      "its server has ended. Its log says why: journalctl --user -u plotwright.service",
    );
    expect(waitedMs).toBeLessThan(2_000);
    active = () => true;
    const asRoot = host({ isRoot: true });
    await expect(installService({ system: true, user: "ada" }, serve(), io, asRoot)).rejects.toThrow(
      "does not answer on port 9080 yet. Its log says why: journalctl -u plotwright.service",
    );
    expect(out).not.toContain("The server");
  });

  it("installs nothing while another program has the port, unless the service itself has it", async () => {
    answering = () => true;
    await expect(installService({}, serve(), io, host())).rejects.toThrow("Another program has port 9080");
    expect(existsSync(userUnit())).toBe(false);
    active = () => true;
    await installService({}, serve(), io, host());
    expect(existsSync(userUnit())).toBe(true);
  });

  it("finds out whether a program listens on a port", async () => {
    const other = createServer();
    await new Promise<void>((resolve) => other.listen(0, "127.0.0.1", resolve));
    const { port } = other.address() as AddressInfo;
    expect(await isListening("127.0.0.1", port)).toBe(true);
    await new Promise((resolve) => other.close(resolve));
    expect(await isListening("127.0.0.1", port)).toBe(false);
  });

  it("asks only systemd about a server on any free port", async () => {
    active = () => true;
    await installService({}, { args: ["--port", "0"], port: 0 }, io, host());
    expect(out).toContain("The server was started.");
    expect(asked.filter((line) => line.startsWith("connect"))).toEqual([]);
  });
});

describe("the logs", () => {
  it("are kept over restarts, at most two files, one line per entry, long lines cut", async () => {
    const before = new LogBook(home);
    before.write("first\nline");
    await before.written();
    expect(readLog(home)).toMatch(/ first \| line\n$/);
    const book = new LogBook(home);
    for (let line = 0; line < 1_000; line++) {
      book.write("x".repeat(100_000));
      await book.written();
    }
    book.write("last line");
    await book.written();
    const text = readLog(home);
    expect(text).toMatch(/ last line\n$/);
    expect(text.length).toBeLessThan(2_300_000);
    expect(text.length).toBeGreaterThan(1_000_000);
    expect(Math.max(...text.split("\n").map(({ length }) => length))).toBeLessThan(5_000);
    expect(
      text
        .split("\n")
        .slice(0, -1)
        .every((line) => /^\d{4}-\d\d-\d\dT[\d:.]+Z /.test(line)),
    ).toBe(true);
  });

  it("keep the lines of one moment in their order, and leave out what a slow disk can't take", async () => {
    const book = new LogBook(home);
    for (let line = 0; line < 100_000; line++) book.write(`line ${line}`);
    await book.written();
    const numbers = [...readLog(home).matchAll(/ line (\d+)\n/g)].map(([, number]) => Number(number));
    expect(numbers.slice(0, 1_000)).toEqual(Array.from({ length: 1_000 }, (_, index) => index));
    expect(readLog(home).length).toBeLessThan(300_000);
    book.write("later");
    await book.written();
    expect(readLog(home)).toMatch(/ later\n$/);
  });

  it("are printed with versions, without secrets, also if no server runs", async () => {
    const book = new LogBook(home);
    book.write("paired 192.168.1.7");
    book.write("GET /pair?token=SECRETTOKEN with Bearer SECRETKEY at https://ada:SECRETWORD@example.org/x");
    await book.written();
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

  it("do not stop the server if they can't be written", async () => {
    const book = new LogBook(join(home, "none"));
    book.write("x");
    await expect(book.written()).resolves.toBeUndefined();
  });
});

describe("the service of launchd", () => {
  /** A Mac whose launchd loads what it is told to; the service before needs a while to end. */
  function mac({ isRoot = false, endsAfter = 0 } = {}) {
    const state = { loaded: false, ending: 0 };
    const computer = host({
      platform: "darwin",
      isRoot,
      systemDir: join(home, "LaunchDaemons"),
      env: isRoot ? { SUDO_USER: "ada" } : {},
      run: (command, args) => {
        asked.push(`${command} ${args.join(" ")}`);
        const [verb] = args;
        if (verb === "bootout") state.ending = endsAfter + 1;
        if (verb === "print" && state.ending > 0 && --state.ending === 0) state.loaded = false;
        if (verb === "bootstrap" && state.loaded) return { code: 5, text: "Bootstrap failed: 5" };
        if (verb === "bootstrap") state.loaded = true;
        if (verb !== "print") return { code: 0, text: "" };
        const text =
          "gui/501/plotwright.server = {\n\tpath = /x\n\tstate = running\n\tpid = 77\n\tx = y\n}\n";
        return state.loaded ? { code: 0, text } : { code: 113, text: "Could not find service" };
      },
    });
    return { computer, state };
  }
  const agent = (): string => join(home, "Library", "LaunchAgents", "plotwright.server.plist");

  it("is an agent that starts at login, restarts after a failure and has time to lift the pen", async () => {
    answering = () => true;
    const { computer } = mac();
    await installService({}, serve("--lan", "--watch", "plots & <more>"), io, {
      ...computer,
      isListening: freeFirst(),
    });
    const plist = readFileSync(agent(), "utf8");
    expect(plist).toContain("<key>KeepAlive</key><dict><key>SuccessfulExit</key><false/></dict>");
    expect(plist).toContain("<key>ExitTimeOut</key><integer>60</integer>");
    const args = [...plist.matchAll(/^ {4}<string>(.*)<\/string>$/gm)].map(([, arg]) => arg);
    expect(args.slice(0, 4)).toEqual([
      "/usr/bin/node",
      "/usr/lib/node_modules/plotwright/dist/server/main.js",
      "serve",
      "--lan",
    ]);
    expect(args[5]).toMatch(/^\/.*\/plots &amp; &lt;more&gt;$/);
    expect(asked.filter((one) => /enable|boot/.test(one))).toEqual([
      "launchctl enable gui/501/plotwright.server",
      `launchctl bootstrap gui/501 ${agent()}`,
    ]);
    expect(out).toContain("runs on port");
    expect(out).toContain("It runs while you are logged in.");
  });

  it("waits until the service before has ended, which may take a minute, and then starts the new one", async () => {
    const { computer, state } = mac({ endsAfter: 5 });
    state.loaded = true;
    await installService({}, serve("--lan"), io, computer);
    expect(asked.findIndex((one) => one.includes("bootout"))).toBeLessThan(
      asked.findIndex((one) => one.includes("bootstrap")),
    );
    expect(waitedMs).toBeGreaterThanOrEqual(4_000);
    expect(state.loaded).toBe(true);
  });

  it("is a daemon of the whole computer with --system, which runs as the user, not as root", async () => {
    const { computer } = mac({ isRoot: true });
    await installService({ system: true }, serve("--mqtt", "mqtt://a:s3cret'@b"), io, {
      ...computer,
      isListening: freeFirst(),
    });
    const path = join(home, "LaunchDaemons", "plotwright.server.plist");
    const plist = readFileSync(path, "utf8");
    expect(plist).toContain("<key>UserName</key><string>ada</string>");
    expect(plist).not.toContain("s3cret");
    const secrets = path.replace(".plist", ".env");
    expect(plist).toContain(`<string>--env-file=${secrets}</string>`);
    expect(readFileSync(secrets, "utf8")).toBe(`PLOTWRIGHT_MQTT="mqtt://a:s3cret'@b"\n`);
    expect(statSync(secrets).mode & 0o777).toBe(0o600);
    expect(asked).toContain(`chown ada ${secrets}`);
    expect(asked).toContain(`launchctl bootstrap system ${path}`);
  });

  it.each(["plain", "with'quote", 'with"quote', "back\\slash'x", "`tick'"])(
    "gives Node the secret %s unchanged",
    async (secret) => {
      const { computer } = mac();
      await installService({}, serve("--mqtt", `mqtt://${secret}`), io, {
        ...computer,
        isListening: freeFirst(),
      });
      const file = agent().replace(".plist", ".env");
      const program = "console.log(process.env.PLOTWRIGHT_MQTT)";
      const { stdout } = spawnSync(process.execPath, [`--env-file=${file}`, "-e", program], {
        encoding: "utf8",
      });
      expect(stdout).toBe(`mqtt://${secret}\n`);
    },
  );

  it("shows whether it runs, and goes with all its files", async () => {
    const { computer, state } = mac();
    await installService({}, serve("--mqtt", "mqtt://a:b@c"), io, { ...computer, isListening: freeFirst() });
    out = "";
    expect(serviceStatus({}, io, computer)).toBe(0);
    expect(out).toMatch(/^path = \/x\nstate = running\npid = 77\nlog: .*plotwright\.log\n$/);
    state.loaded = false;
    expect(serviceStatus({}, io, computer)).toBe(3);
    uninstallService({}, io, computer);
    expect(existsSync(agent())).toBe(false);
    expect(existsSync(agent().replace(".plist", ".env"))).toBe(false);
    expect(serviceStatus({}, io, computer)).toBe(3);
  });

  /** The port is free before the server has started. */
  function freeFirst(): ServiceHost["isListening"] {
    let count = 0;
    return () => Promise.resolve(count++ > 0);
  }
});
