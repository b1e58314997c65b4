/** What users install: packages and MB, by npm from the packed product. */
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import type { Report } from "./run.js";
import { ROOT, ensureBuild } from "../scripts/setup.mjs";

/** Of an installation for planning only. */
const LIMIT_MB = 10;

export default function installBenchmark(report: Report): Promise<void> {
  ensureBuild();
  const folder = mkdtempSync(path.join(tmpdir(), "plotwright-install-"));
  try {
    run("npm", ["pack", "--ignore-scripts", "--pack-destination", folder], ROOT);
    run(process.execPath, ["scripts/pack-plan.mjs", folder], ROOT);
    const packed = (isPlan: boolean): string =>
      path.join(
        folder,
        readdirSync(folder).find((name) => name.endsWith(".tgz") && name.includes("-plan-") === isPlan) ?? "",
      );
    const installs: readonly (readonly [what: string, args: readonly string[], limitMb?: number])[] = [
      ["plotwright", [packed(false)]],
      ["plotwright --omit=optional", ["--omit=optional", packed(false)]],
      ["plotwright, mqtt", [packed(false), "mqtt"]],
      ["plotwright-plan", [packed(true)], LIMIT_MB],
      ["plotwright-plan, fontkit", [packed(true), "fontkit"]],
    ];
    const rows = installs.map(([what, args, limitMb], i) => {
      const { packages, mb } = installed(path.join(folder, String(i)), args);
      if (limitMb !== undefined && mb > limitMb) console.error(`${what}: ${mb} MB, more than ${limitMb}`);
      return { "npm install": what, packages, MB: mb, limit: limitMb ?? "" };
    });
    report("install", rows, "Without install scripts; the sum of the sizes of all files.");
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  return Promise.resolve();
}

function installed(folder: string, args: readonly string[]): { packages: number; mb: number } {
  mkdirSync(folder);
  writeFileSync(path.join(folder, "package.json"), '{ "private": true }');
  const flags = ["--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund"];
  run("npm", ["install", ...flags, ...args], folder);
  const lock = readFileSync(path.join(folder, "node_modules", ".package-lock.json"), "utf8");
  const { packages } = JSON.parse(lock) as { packages: object };
  const files = readdirSync(path.join(folder, "node_modules"), { recursive: true, encoding: "utf8" })
    .map((name) => statSync(path.join(folder, "node_modules", name)))
    .filter((file) => file.isFile());
  const bytes = files.reduce((sum, { size }) => sum + size, 0);
  return { packages: Object.keys(packages).length, mb: Math.round(bytes / 1e5) / 10 };
}

function run(command: string, args: readonly string[], cwd: string): string {
  const shell = command === "npm" && process.platform === "win32";
  const { status, stdout, stderr } = spawnSync(command, args, { cwd, encoding: "utf8", shell });
  if (status !== 0) throw new Error(stderr);
  return stdout;
}
