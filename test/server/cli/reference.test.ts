/** docs/cli.md: its commands are those of the program's help, and each of their examples runs. */
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { Command } from "commander";
import { COMMANDS } from "../../../server/cli/commands.js";
import { usualConfigPath } from "../../../server/cli/config-file.js";
import { buildProgram } from "../../../server/cli/program.js";
import { SETTING_OPTIONS } from "../../../server/cli/setting-table.js";
import { addSettingOptions, settingsFromOptions } from "../../../server/cli/settings-options.js";
import { serverClient } from "../../../host/handle/server-client.js";
import { PlotRecord } from "../../../server/cli/plot/plot-record.js";
import type { PlanOutput } from "../../../server/cli/plan/plan.js";
import type { PlanThreadInput } from "../../../server/cli/plan/plan-thread.js";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import { machineById } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type JobState } from "../../../src/schema/index.js";
import { cliReference } from "../../../scripts/cli-reference.js";
import { CaughtIo, cliWith, type CliRun } from "../../support/processes/command-line.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black"><path d="M1 2h9"/></svg>`;
/** It takes minutes to plot. */
const LONG_SVG = SVG.replace("M1 2h9", "M1 2h18v16h-18z".repeat(100));
vi.mock("../../../server/cli/stdin.js", () => ({ readStdin: () => Buffer.from(SVG) }));
// Ignores any board connected to this computer.
vi.mock("../../../server/serial/find-boards.js", () => ({ findBoards: () => Promise.resolve([]) }));
// Plans in this thread: to start one for each line takes longer than its plan. plan.test.ts has the thread.
vi.mock("../../../server/cli/plan/plan-thread.js", async () => {
  const { runPlan } = await import("../../../server/cli/plan/plan.js");
  const runPlanInThread = ({ file, settings, options }: PlanThreadInput, io: PlanOutput): Promise<void> =>
    runPlan(file, settings, options, {
      out: (text) => io.out(text),
      err: () => undefined,
      imported: () => undefined,
      begin: () => undefined,
    });
  return { runPlanInThread };
});

const LIMIT_MS = 120_000;
const startedIn = process.cwd();
const tlsFile = (name: string): string =>
  fileURLToPath(new URL(`../../fixtures/tls/${name}.pem`, import.meta.url));
const TLS = { cert: tlsFile("cert"), key: tlsFile("key") };
let folder: string;
let server: PlotwrightServer;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "plotwright-reference-"));
  for (const name of ["drawing.svg", "other.svg"]) writeFileSync(join(folder, name), SVG);
  writeFileSync(join(folder, "wide.svg"), SVG.replaceAll("20", "90").replace("M1 2h9", "M30 40h30"));
  const machine = { ...machineById("axidraw-v3"), id: "own" };
  const springs = { xHz: 15, yHz: 25, damping: 0.1 };
  writeFileSync(join(folder, "machine.json"), JSON.stringify(machine));
  writeFileSync(join(folder, "measured.json"), JSON.stringify({ ...machine, springs }));
  writeFileSync(join(folder, "settings.json"), "{}");
  for (const name of ["drawings", "data"]) mkdirSync(join(folder, name));
  vi.stubEnv("XDG_CONFIG_HOME", folder);
  vi.stubEnv("XDG_DATA_HOME", folder);
  process.chdir(folder);
  const options = { port: 0, dataDir: join(folder, "server"), device: "virtual", log: () => undefined };
  server = await createServer({ ...options, maxUploadBytes: 1e6 });
  for (const where of [
    ["--url", server.url],
    ["--data", "data"],
  ])
    await cliWith(new CaughtIo(), "settings", "save", "Fine", ...where);
});
afterAll(async () => {
  await server.close();
  process.chdir(startedIn);
  vi.unstubAllEnvs();
  rmSync(folder, { recursive: true, force: true });
});

/** Added by the test, so that a line touches nothing outside its folder and takes no real time. */
function additionsOf(command: string, args: readonly string[] = []): string[] {
  const data = ["--data", join(folder, "data")];
  const board = ["--device", "virtual", "--virtual-speed", "100", ...data];
  switch (command) {
    case "completion":
    case "devices":
    case "service":
      return [];
    case "plan":
    case "machines":
    case "settings":
    case "pen-times":
    case "ringing":
    case "logs":
      return data;
    case "serve":
      return ["--port", "0", "--no-mdns", ...board];
    case "plot":
      return args.includes("--resume") ? board : ["--paper-s", "0", ...board];
    case "add":
    case "queue":
    case "start":
    case "pause":
    case "resume":
    case "cancel":
    case "remove":
    case "follow":
    case "mcp":
      return ["--url", server.url];
    case "inkscape":
      return ["--folder", join(folder, "extensions")];
    case "board":
      return ["--pty", join(folder, "plotter")];
    default:
      return board;
  }
}

/** Commands that run until the user ends them. */
const READY: Readonly<Record<string, RegExp>> = {
  serve: /plotwright is at/,
  board: /plotter/,
  follow: /[Ff]ollow/,
  mcp: /assistant can use/,
};

/** The state in which these commands find their job. */
const JOB_BEFORE: Readonly<Record<string, JobState>> = {
  start: "queued",
  pause: "plotting",
  resume: "paused",
  cancel: "plotting",
  remove: "queued",
  follow: "plotting",
};
const JOB_ARGUMENTS = ["--url", "--key"];
/** As systemctl reports that a service does not run. */
const CODES: Readonly<Record<string, number>> = { "plotwright service status": 3 };

/** These have all settings, with the same code. Each setting runs with `plan`, in a separate test. */
const TAKE_DRAWINGS = ["plan", "plot", "add", "frame"];
/** Options that a test cannot run, and why. `service` has options only in its own commands. */
const NOT_RUN: Readonly<Record<string, string>> = {
  "serve --open": "it would open a browser: it has a test below",
  "add --url": "every line of add has it, and it has a test below",
  "queue --url": "every line of queue has it, and it has a test below",
  "mcp --url": "every line of mcp has it",
  "add --font": "a server does not take it: it has a test in test/server/cli/beside-server.test.ts",
  "pen-times --url": "it has a test in test/server/cli/measuring-commands.test.ts",
  "ringing --url": "it has a test in test/server/cli/measuring-commands.test.ts",
  "serve --mqtt": "it needs a broker: it has a test in test/server/plugins/mqtt/mqtt.test.ts",
  "serve --shared-queue":
    "it needs a PostgreSQL database: it has a test in test/server/plugins/shared-queue/shared-begin.test.ts",
};

/** A value for each option that takes one and has no default or choices; some for one command only. */
const VALUES: Readonly<Record<string, string>> = {
  "--device": "virtual",
  "--virtual-speed": "10",
  "--data": "data",
  "--machine": "axidraw-v3",
  "--machine-file": "machine.json",
  "--config": "settings.json",
  "--preset": "Fine",
  "--font": join(
    process.cwd(),
    "node_modules/@fontsource/dejavu-sans/files/dejavu-sans-latin-400-normal.woff",
  ),
  "--only": "Layer 1",
  "--tile-columns": "2",
  "--tile-rows": "2",
  "--pen": "Layer 1=Blue",
  "serve --port": "0",
  "logs --port": "1",
  "board --pty": "plotter",
  "board --firmware": "3.0.3",
  "--ripples-x": "2,19.5",
  "--ripples-y": "3,18",
  "--right": "20",
  "--lift": "20",
  "--drop": "-20",
  "--commands": "-",
  "--preview": "-",
  "--svg": "-",
  "--strokes": "-",
  "--paper": "20x20cm",
  "--paper-s": "0",
  "--key": "key",
  "--plotter": "main",
  "--host": "127.0.0.1",
  "--cert": TLS.cert,
  "serve --key": TLS.key,
  "--allow-host": "studio.local",
  "--allow-origin": "https://editor.example",
  "--watch": "drawings",
  "--max-upload-mb": "20",
  "--out": "plotwright.log",
  "--pty": "plotter",
  "--margins": "5,1cm,5,1in",
  "--place": "20,20,50,50",
  "--spring-x": "15",
  "--spring-y": "25",
  "--damping": "0.1",
  "--virtual-springs": "15,25",
  "--springs": "15,25,0.1",
  "--pen-up": "70",
  "--send-ahead-ms": "200",
};
/** Options that only make sense with others. How a machine swings is two frequencies. */
const WITH: Readonly<Record<string, readonly string[]>> = {
  "serve --cert": ["--key", TLS.key],
  "serve --key": ["--cert", TLS.cert],
  "test-patch --shaper": ["--machine-file", "measured.json"],
  "live --shaper": ["--machine-file", "measured.json"],
  "plan --pen-error": ["--spring-x", "15", "--spring-y", "25"],
  "ringing --damping": ["--ripples-x", "2,19.5"],
  "ringing --store": ["--ripples-x", "2,19.5", "--ripples-y", "3,18"],
  "ringing --plotter": ["--ripples-x", "2,19.5", "--ripples-y", "3,18", "--store"],
  "ringing --spring-x": ["--check", "--spring-y", "25"],
  "ringing --spring-y": ["--check", "--spring-x", "15"],
  "ringing --check": ["--spring-x", "15", "--spring-y", "25"],
  "--tile-columns": ["--tile", "2"],
  "--tile-rows": ["--tile", "2"],
  "--spring-x": ["--spring-y", "25"],
  "--spring-y": ["--spring-x", "15"],
  "--damping": ["--spring-x", "15", "--spring-y", "25"],
  "--shaper": ["--spring-x", "15", "--spring-y", "25"],
  "--quality": ["--spring-x", "15", "--spring-y", "25"],
};
const ARGUMENTS: Readonly<Record<string, readonly string[]>> = {
  plan: ["drawing.svg"],
  plot: ["drawing.svg"],
  add: ["drawing.svg"],
  frame: ["drawing.svg"],
  pen: ["up"],
  jog: ["1", "2"],
  "move-to": ["1", "2"],
  raw: ["QM"],
  remove: ["drawing.svg"],
};

/** What the other options do, with what shows it. */
const EFFECTS: readonly (readonly [string, readonly string[], RegExp])[] = [
  ["plan", ["drawing.svg", "--json"], /^\{.*\}\s*$/s],
  ["plan", ["drawing.svg", "--commands", "-", "--firmware", "2.5.3"], /\nLM,/],
  ["plan", ["drawing.svg", "--commands", "-", "--firmware", "3.0.3"], /\nLT,/],
  ["plan", ["drawing.svg", "--svg", "-"], /<svg[^>]* width="297mm"/],
  [
    "plan",
    ["drawing.svg", "--svg", "-", "--machine", "axidraw-v3-a3", "--paper", "A3"],
    /<svg[^>]* width="420mm"/,
  ],
  ["plan", ["drawing.svg", "--preview", "-"], /<svg/],
  ["plan", ["drawing.svg", "--strokes", "-"], /^\{"/],
  ["plan", ["drawing.svg", "--only", "Ink"], /no layer .*Ink|Ink.* no layer|Layers?/i],
  ["plan", ["drawing.svg", "--machine", "typewriter"], /no machine "typewriter"/],
  ["plan", ["drawing.svg", "--machine-file", "none.json"], /none\.json/],
  ["plan", ["drawing.svg", "--config", "none.json"], /none\.json/],
  [
    "devices",
    ["--json"],
    /^\[\{"path":"virtual","description":"the built-in virtual board","serialNumber":null\}\]\s*$/,
  ],
  ["machines", ["--json"], /^\[\{"id":"axidraw-v3"/],
  ["info", ["--json"], /"firmware":/],
  ["queue", ["--json"], /^[[{]/],
  ["raw", ["QM"], /^QM,0,0,0/],
  ["raw", ["XX"], /The board refused XX: !8 Err: Unknown command/],
  ["logs", ["--port", "1", "--out", "log.txt"], /log\.txt is written/],
  ["pen", ["40"], /^$/],
  ["plot", ["drawing.svg", "--quiet"], /^$/],
  ["plot", ["drawing.svg", "--copies", "2"], /Done: drawing\.svg.*Done: drawing\.svg/s],
  ["plot", ["--resume"], /nothing to resume/],
  ["add", ["drawing.svg", "--copies", "2"], /drawing\.svg/],
];

/** One line of a table in docs/cli.md. */
interface OptionCase {
  readonly name: string;
  readonly flag: string;
  readonly args: readonly string[];
}
async function optionCases(): Promise<OptionCase[]> {
  const names = COMMANDS.map(({ name }) => name);
  const context = { io: new CaughtIo(), version: "0.0.0", setExitCode: () => undefined };
  const { commands } = await buildProgram(names, context);
  const isTried = ([name, flag]: readonly [string, string]): boolean =>
    !(`${name} ${flag}` in NOT_RUN) &&
    // Every line of these commands has the address, and the key has the tests of queue.
    !(name in JOB_BEFORE && JOB_ARGUMENTS.includes(flag)) &&
    !(TAKE_DRAWINGS.includes(name) && SETTING_OPTIONS.some(({ flags }) => flags.split(" ")[0] === flag));
  return commands.flatMap((command) =>
    command.options.flatMap(({ long, required, defaultValue, argChoices }) => {
      const [name, flag] = [command.name(), long ?? ""];
      if (!isTried([name, flag])) return [];
      const known = argChoices?.at(-1) ?? VALUES[`${name} ${flag}`] ?? VALUES[flag];
      const value = known ?? (defaultValue === undefined ? "1" : String(defaultValue));
      const others = WITH[`${name} ${flag}`] ?? WITH[flag] ?? [];
      const words = flag === "--resume" ? [] : (ARGUMENTS[name] ?? []);
      return [{ name, flag, args: [...words, flag, ...(required ? [value] : []), ...others] }];
    }),
  );
}

describe("each option in docs/cli.md", async () => {
  it.each(await optionCases())(
    "$name $flag runs",
    async ({ name, flag, args }) => {
      if (flag === "--resume") leaveInterruptedPlot();
      const { code, err } = await runLine(name, [name, ...additionsOf(name, args), ...args]);
      expect([args, code, err]).toEqual([args, 0, expect.any(String)]);
    },
    LIMIT_MS,
  );

  it.each(SETTING_OPTIONS.map(({ flags }) => flags.split(" ")[0]))(
    "%s changes the plan's settings",
    async (flag) => {
      const command = addSettingOptions(new Command()).exitOverride();
      const option = command.options.find(({ long }) => long === flag)!;
      const value =
        flag === "--machine" ? "axidraw-v3-a3" : (option.argChoices?.at(-1) ?? VALUES[flag] ?? "1");
      // A switch is tried after its opposite, so that its default does not matter.
      const opposite = flag.startsWith("--no-") ? flag.replace("--no-", "--") : flag.replace("--", "--no-");
      const before = option.required ? [] : [opposite];
      const args = [...before, flag, ...(option.required ? [value] : []), ...(WITH[flag] ?? [])];
      const settingsOf = (given: readonly string[]): unknown =>
        settingsFromOptions(
          addSettingOptions(new Command())
            .parse([...given], { from: "user" })
            .opts(),
        );
      expect(settingsOf(args)).not.toEqual(settingsOf(before));
      const { code, err } = await cliWith(new CaughtIo(), "plan", "wide.svg", ...args);
      expect([err, code]).toEqual([expect.any(String), 0]);
    },
  );

  it.each(EFFECTS)("%s takes effect: %j", { timeout: LIMIT_MS }, async (name, args, expected) => {
    const io = new CaughtIo();
    await cliWith(io, name, ...args, ...additionsOf(name, args));
    expect(io.outText + io.errText).toMatch(expected);
  });
});

describe("serve", () => {
  // On Windows a browser is opened by a built-in command, which cannot be replaced.
  it.runIf(process.platform !== "win32")(
    "--open passes the page's address to the program that opens browsers",
    async () => {
      const bin = join(folder, "bin");
      const opened = join(folder, "opened");
      mkdirSync(bin);
      for (const name of ["xdg-open", "open"])
        writeFileSync(join(bin, name), `#!/bin/sh\nprintf '%s' "$1" > '${opened}'\n`, { mode: 0o755 });
      vi.stubEnv("PATH", `${bin}:${process.env["PATH"] ?? ""}`);
      const io = new CaughtIo();
      const running = cliWith(io, "serve", "--open", ...additionsOf("serve"));
      try {
        await expect.poll(() => existsSync(opened) && readFileSync(opened, "utf8")).toMatch(/^http/);
      } finally {
        io.interrupt();
        await running;
      }
      expect(await running).toMatchObject({
        code: 0,
        out: `plotwright is at ${readFileSync(opened, "utf8")}\n`,
      });
    },
    LIMIT_MS,
  );
});

describe("serve --shared-queue", () => {
  it.each([
    ["plots", "--shared-queue: it must be the address of a PostgreSQL database"],
    ["postgres://127.0.0.1:1/x", "ECONNREFUSED 127.0.0.1:1. Check that it runs, and its address"],
  ])(
    "%s: the fault is explained",
    async (url, message) => {
      const { code, err } = await cliWith(
        new CaughtIo(),
        ...["serve", "--shared-queue", url],
        ...additionsOf("serve"),
      );
      expect([code, err]).toEqual([2, expect.stringContaining(message)]);
    },
    LIMIT_MS,
  );
});

describe("docs/cli.md", () => {
  it("has the commands that `npm run docs` writes", async () => {
    const text = readFileSync(new URL("../../../docs/cli.md", import.meta.url), "utf8");
    expect(text).toContain(await cliReference());
  });

  const lines = COMMANDS.flatMap(({ name, examples }) => examples.map((line) => ({ name, line })));
  it.each(lines)(
    "$line",
    async ({ name, line }) => {
      if (line.endsWith("--resume")) leaveInterruptedPlot();
      const args = line.split(" ").slice(1);
      const { code, err } = await runLine(name, [...args, ...additionsOf(name, args)]);
      expect([err, code]).toEqual([expect.any(String), CODES[line] ?? 0]);
      if (line.includes("--out plotwright.log")) expect(existsSync("plotwright.log")).toBe(true);
    },
    LIMIT_MS,
  );
});

/** Without a keyboard. A command that runs until it is ended is ended as soon as it is ready. */
async function runLine(name: string, args: readonly string[]): Promise<CliRun> {
  if (name === "add") await clearQueue();
  const before = JOB_BEFORE[name];
  if (before !== undefined) await leaveJob(before);
  const io = new CaughtIo();
  io.hasKeyboard = false;
  const running = cliWith(io, ...args);
  const ready = READY[name];
  if (ready !== undefined) {
    await Promise.race([running, expect.poll(() => io.outText + io.errText).toMatch(ready)]);
    io.interrupt();
  }
  const run = await running;
  // The other lines are for someone without it.
  if (name === "settings") rmSync(usualConfigPath(), { force: true });
  return run;
}

/** Leaves one job in the server's queue, in that state. */
async function leaveJob(state: JobState): Promise<void> {
  await clearQueue();
  const { jobs } = serverClient(server);
  const { id } = await jobs.add({ name: "drawing.svg", drawing: LONG_SVG });
  if (state !== "queued") await jobs.start(id);
  if (state === "paused") await jobs.pause(id);
  await expect.poll(async () => (await jobs.get(id)).state).toBe(state);
}

async function clearQueue(): Promise<void> {
  const { jobs, state } = serverClient(server);
  for (const { id, state: before } of (await state.get()).jobs) {
    if (before === "plotting" || before === "paused") await jobs.cancel(id);
    // Not before the pen is up and home.
    await expect.poll(() => jobs.remove(id).then(() => true, () => false)).toBe(true); // prettier-ignore
  }
}

function leaveInterruptedPlot(): void {
  const record = new PlotRecord(join(folder, "data"), "virtual");
  record.begin(join(folder, "drawing.svg"), {
    name: "drawing.svg",
    settings: DEFAULT_PLOT_SETTINGS,
    only: undefined,
  });
  const place = { stroke: 0, alongMm: 2 };
  record.save({ place, xMm: 0, yMm: 0, penUp: false, elapsedS: 1 }, 0.4);
}
