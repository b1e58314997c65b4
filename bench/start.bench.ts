/** Start-up times: the command line's, and that of importing the library. */
import { spawnSync } from "node:child_process";
import path from "node:path";
import type { Report } from "./run.js";
import { ROOT, ensureBuild } from "../scripts/setup.mjs";

const RUNS = 9;

interface Start {
  readonly what: string;
  readonly args: readonly string[];
  readonly limitS: number;
}

const STARTS: readonly Start[] = [
  { what: "plotwright --version", args: ["dist/server/main.js", "--version"], limitS: 0.4 },
  {
    what: 'import "plotwright"',
    args: ["--input-type=module", "-e", 'import "plotwright"'],
    limitS: 0.25,
  },
];

export default function startBenchmark(report: Report): Promise<void> {
  ensureBuild();
  const rows = STARTS.map(({ what, args, limitS }) => ({ what, seconds: bestS(args), limit: limitS }));
  const note = `Whole processes, including Node's own start; the best of ${RUNS} warm ones.`;
  report("start", rows, note);
  for (const { what, seconds, limit } of rows) {
    if (seconds > limit) console.error(`${what} takes ${seconds} s: more than ${limit} s`);
  }
  return Promise.resolve();
}

/**
 * Of warm runs: the first one, which reads the files from disk, is left out. Other work on the computer can
 * only add to the time.
 */
function bestS(args: readonly string[]): number {
  const times = Array.from({ length: RUNS + 1 }, () => {
    const startedMs = performance.now();
    const { status, stderr } = spawnSync(process.execPath, args, {
      cwd: path.resolve(ROOT),
      encoding: "utf8",
    });
    if (status !== 0) throw new Error(stderr);
    return (performance.now() - startedMs) / 1_000;
  });
  return Number(Math.min(...times.slice(1)).toFixed(3));
}
