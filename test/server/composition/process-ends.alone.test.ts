/** How the process ends, and what must not end it, with the built program as a user starts it. */
import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { chmodSync, cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it, onTestFinished } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";
import { jobSchema, snapshotSchema, type Job } from "../../../src/schema/index.js";
import { PtyBoard } from "../../support/processes/pty-board.js";
import { folderOfTest } from "../../support/processes/folders.js";

const MAIN = join(ROOT, "dist/server/main.js");
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="60mm" viewBox="0 0 90 60" stroke="black">' +
  `${Array.from({ length: 300 }, (_, i) => `<path d="M5 ${5 + i / 8}h80"/>`).join("")}</svg>`;

async function board(): Promise<PtyBoard> {
  const made = await PtyBoard.open({ speed: 5 });
  onTestFinished(() => made.close());
  return made;
}

interface Started {
  readonly child: ChildProcess;
  readonly said: () => string;
  readonly ended: Promise<{ code: number | null; signal: string | null }>;
}
function start(
  command: string,
  args: readonly string[],
  options: { uid?: number; env?: object } = {},
): Started {
  const child = spawn(command, args, {
    cwd: ROOT,
    stdio: ["ignore", "pipe", "pipe"],
    ...(options.uid === undefined ? {} : { uid: options.uid }),
    env: { ...process.env, ...options.env },
  });
  onTestFinished(() => void child.kill("SIGKILL"));
  let text = "";
  for (const stream of [child.stdout, child.stderr])
    stream.on("data", (data: Buffer) => (text += data.toString()));
  const ended = once(child, "exit").then(([code, signal]) => ({
    code: code as number | null,
    signal: signal as string | null,
  }));
  return { child, said: () => text, ended };
}
const serve = (...args: string[]): Started =>
  start(process.execPath, [MAIN, "serve", "--port", "0", ...args]);
async function urlOf(started: Started): Promise<string> {
  await expect.poll(started.said).toMatch(/at http:\/\/127\.0\.0\.1:\d+/);
  return /http:\/\/127\.0\.0\.1:\d+/.exec(started.said())![0];
}
async function stateOf(url: string): Promise<Job> {
  return snapshotSchema.parse(await (await fetch(`${url}/api/v1/state`)).json()).jobs[0];
}
/** A plot that has progressed so far that the pen is drawing. */
async function plotting(url: string, line: PtyBoard): Promise<void> {
  await expect
    .poll(
      async () =>
        snapshotSchema.parse(await (await fetch(`${url}/api/v1/state`)).json()).plotters[0]?.connection,
    )
    .toBe("idle");
  const added = await fetch(`${url}/api/v1/jobs?name=a`, { method: "POST", body: SVG });
  const { id } = jobSchema.parse(await added.json());
  expect((await fetch(`${url}/api/v1/jobs/${id}/start`, { method: "POST" })).status).toBe(200);
  await expect.poll(async () => (await line.report()).statistics.drawnMm).toBeGreaterThan(10);
}
async function penIsUpAtHome(line: PtyBoard): Promise<void> {
  const { penUp, xMm, yMm, isBusy } = (await line.report()).state;
  expect({ penUp, isBusy, x: Math.abs(xMm) < 0.1, y: Math.abs(yMm) < 0.1 }).toEqual({
    penUp: true,
    isBusy: false,
    x: true,
    y: true,
  });
}
const refuses = (url: string): Promise<boolean> =>
  fetch(url, { signal: AbortSignal.timeout(1_000) }).then(
    () => false,
    () => true,
  );

describe("a server that plots", () => {
  it("continues if its output is not read, and on SIGHUP lifts the pen, goes home and ends", async () => {
    const line = await board();
    const server = serve("--data", folderOfTest(), "--device", line.path, "--virtual-speed", "5");
    const url = await urlOf(server);
    await plotting(url, line);
    server.child.stdout?.destroy();
    server.child.stderr?.destroy();
    // Each refusal is a line without a reader.
    const headers = { "Sec-Fetch-Site": "cross-site" };
    for (let i = 0; i < 5; i++) expect((await fetch(`${url}/api/v1/state`, { headers })).status).toBe(403);
    const { drawnMm } = (await line.report()).statistics;
    await expect.poll(async () => (await line.report()).statistics.drawnMm).toBeGreaterThan(drawnMm + 50);
    expect((await stateOf(url)).state).toBe("plotting");
    server.child.kill("SIGHUP");
    expect(await server.ended).toEqual({ code: 0, signal: null });
    await penIsUpAtHome(line);
  });
});

describe("plot without a terminal", () => {
  it("is cancelled by SIGINT: the pen lifts and goes home", async () => {
    const line = await board();
    const file = join(folderOfTest(), "a.svg");
    writeFileSync(file, SVG);
    const plot = start(process.execPath, [MAIN, "plot", file, "--device", line.path, "--virtual-speed", "5"]);
    await expect.poll(async () => (await line.report()).statistics.drawnMm).toBeGreaterThan(10);
    plot.child.kill("SIGINT");
    expect(await plot.ended).toEqual({ code: 5, signal: null });
    await penIsUpAtHome(line);
  });
});

describe("plot at a terminal", () => {
  it("draws the next drawing after Enter, and resumes a pause in it", async () => {
    const { spawn: spawnAtTerminal } = await import("@lydell/node-pty");
    const file = join(folderOfTest(), "a.svg");
    writeFileSync(file, SVG.replace(/<path.*<\/svg>/, '<path d="M5 5h80v50"/></svg>'));
    const args = ["--device", "virtual", "--virtual-speed", "4", "--data", folderOfTest()];
    const plot = spawnAtTerminal(process.execPath, [MAIN, "plot", file, file, ...args], { cwd: ROOT });
    let ended: number | null = null;
    let said = "";
    plot.onExit(({ exitCode }) => (ended = exitCode));
    plot.onData((text) => (said += text));
    onTestFinished(() => void (ended ?? plot.kill("SIGKILL")));
    const saying = (words: RegExp) =>
      expect.poll(() => said.match(words), { timeout: 60_000 }).not.toBeNull();
    await saying(/press Enter/);
    said = "";
    plot.write("\r");
    await saying(/[1-9] %/);
    plot.write("\u0003");
    await saying(/Paused/);
    plot.write("\r");
    await expect.poll(() => ended, { timeout: 60_000 }).toBe(0);
  });
});

describe("npm start", () => {
  const args = (): string[] => ["--port", "0", "--device", "virtual", "--data", folderOfTest()];
  it.each([
    ["node", "SIGKILL"],
    ["node", "SIGTERM"],
    ["node", "SIGINT"],
    ["npm", "SIGTERM"],
  ] as const)("run by %s and ended by %s leaves no server running", async (by, signal) => {
    const started =
      by === "npm"
        ? start("npm", ["start", "--", ...args()])
        : start(process.execPath, [join(ROOT, "scripts/start.mjs"), ...args()]);
    const url = await urlOf(started);
    started.child.kill(signal);
    await started.ended;
    await expect.poll(() => refuses(url)).toBe(true);
  });
});

describe("npm start without --", () => {
  it.each([["--port", "9381"], ["--port=9381"]])(
    "%s %s says how to pass the option, and does not start",
    async (...args) => {
      const started = start("npm", ["start", ...args]);
      expect((await started.ended).code).toBe(2);
      expect(started.said()).toMatch(/npm took --port for itself\. .* npm start -- --port 9381/);
      expect(started.said()).not.toMatch(/building|plotwright is at/);
    },
  );
});

describe("a data folder that can't be used", () => {
  it("a data folder below /proc is refused at once", async () => {
    const server = serve("--data", "/proc/x", "--device", "virtual");
    expect(await server.ended).toEqual({ code: 2, signal: null });
    expect(server.said()).toMatch(
      /^plotwright: The data folder \/proc\/x can't be created: no folder can be made there\. .*--data\.\n$/,
    );
  });

  it("a read-only data folder is named in the message", async () => {
    const data = join(folderOfTest(), "data");
    mkdirSync(join(data, "drawings"), { recursive: true });
    // Root may write here too: then another user starts the server.
    const isRoot = process.getuid?.() === 0;
    for (const path of [join(data, ".."), data, join(data, "drawings")]) chmodSync(path, 0o555);
    onTestFinished(() => [join(data, ".."), data].forEach((path) => chmodSync(path, 0o755)));
    const server = start(
      process.execPath,
      [MAIN, "serve", "--port", "0", "--data", data, "--device", "virtual"],
      isRoot ? { uid: 65534 } : {},
    );
    expect(await server.ended).toEqual({ code: 2, signal: null });
    expect(server.said()).toMatch(
      /^plotwright: The data folder [^\n]* can't be written to\. [^\n]*--data\.\n$/,
    );
  });

  it("a data folder of sources for npm start is reported, without a question about the network", async () => {
    const copy = join(folderOfTest(), "copy");
    mkdirSync(copy);
    for (const name of ["scripts", "package.json", "package-lock.json"]) {
      cpSync(join(ROOT, name), join(copy, name), { recursive: true });
    }
    const isRoot = process.getuid?.() === 0;
    chmodSync(join(copy, ".."), 0o755);
    chmodSync(copy, 0o555);
    onTestFinished(() => chmodSync(copy, 0o755));
    const started = start(process.execPath, [join(copy, "scripts/start.mjs")], isRoot ? { uid: 65534 } : {});
    expect((await started.ended).code).toBe(1);
    expect(started.said()).toMatch(/copy\/ can't be written to/);
    expect(started.said()).not.toMatch(/network/);
  });
});
