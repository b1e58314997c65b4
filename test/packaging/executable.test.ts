/** The single-file executable, without Node.js in the PATH. Only in the full run: it copies 106 MB, and packs the product. */
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { IS_FULL } from "../support/runs/full-run.js";

const LIMIT_MS = 600_000;
const MAX_MB = 130;

describe.runIf(IS_FULL)("the executable", () => {
  const folder = mkdtempSync(path.join(tmpdir(), "plotwright-executable-test-"));
  const program = path.join(folder, process.platform === "win32" ? "plotwright.exe" : "plotwright");
  const cache = path.join(folder, "cache");
  const data = path.join(folder, "data");
  const env = {
    XDG_CACHE_HOME: cache,
    LOCALAPPDATA: cache,
    XDG_DATA_HOME: data,
    HOME: folder,
    PATH: folder,
  };
  const run = (...args: string[]) => spawnSync(program, args, { encoding: "utf8", env, cwd: folder });
  const sample = path.join(ROOT, "samples", "hello-paper.svg");

  beforeAll(() => {
    mkdirSync(cache);
    const script = path.join(ROOT, "scripts", "executable", "build.mjs");
    const { status, stderr } = spawnSync(process.execPath, [script, program], { encoding: "utf8" });
    expect([status, stderr]).toEqual([0, expect.any(String)]);
  }, LIMIT_MS);
  afterAll(() => rmSync(folder, { recursive: true, force: true }));

  it(`is at most ${MAX_MB} MB, and unpacks itself once`, () => {
    expect(statSync(program).size / 1e6).toBeLessThan(MAX_MB);
    expect(run("--version").stdout).toMatch(/^\d+\.\d+\.\d+\n$/);
    const unpacked = readdirSync(path.join(cache, "plotwright"));
    expect(run("--version").status).toBe(0);
    expect(readdirSync(path.join(cache, "plotwright"))).toEqual(unpacked);
  });

  it("plans in its threads, plots on the virtual board, and has the driver of the serial port", () => {
    expect(run("plan", sample).stdout).toContain("747 strokes");
    expect(run("plot", sample, "--device", "virtual", "--virtual-speed", "1000").stderr).toContain("Done");
    expect(run("devices")).toMatchObject({ status: 0, stdout: expect.stringContaining("virtual") as string });
  });

  it("names itself in a service", () => {
    const { stdout } = run("service", "install", "--print", "--", "--port", "9381");
    const [command = "", ...args] = /^ExecStart=(.*)$/m.exec(stdout)?.[1].split(" ") ?? [];
    expect(command).toBe(program);
    expect(existsSync(args[0] ?? "")).toBe(true);
    expect(run(args[0] ?? "", "--version").stdout).toMatch(/^\d+\.\d+\.\d+\n$/);
  });

  it("serves the page, and ends when it is told to", async () => {
    const server = spawn(program, ["serve", "--port", "0", "--device", "virtual"], { env, cwd: folder });
    let output = "";
    server.stdout.on("data", (chunk: Buffer) => (output += chunk.toString()));
    await expect.poll(() => output, { timeout: 60_000 }).toMatch(/http:\/\/127\.0\.0\.1:\d+/);
    const page = await fetch(/http:\/\/127\.0\.0\.1:\d+/.exec(output)?.[0] ?? "");
    expect(await page.text()).toContain("<title>");
    server.kill();
    await once(server, "exit");
  });
});
