/**
 * SVG text to drawing, each in a fresh process, and text to plan in a warm one. The most expensive kinds of
 * files: many short lines, long polylines, and circles, whose outlines are many times their text.
 * import-child.mjs describes what is counted.
 */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, loadavg, tmpdir } from "node:os";
import path from "node:path";
import { ensureBuild } from "../scripts/setup.mjs";
import type { Report, Row } from "./run.js";

const RUNS = 3;
const BIG_BYTES = 25_000_000;

interface Result {
  readonly importMs: number;
  /** Warm; null if no plan was requested. */
  readonly planMs: number | null;
  readonly shapes: number;
  /** null if the system does not report it. */
  readonly timesFile: number | null;
}

export default function importBench(report: Report): Promise<void> {
  ensureBuild();
  const folder = mkdtempSync(path.join(tmpdir(), "plotwright-import-"));
  try {
    report("Text to plan, 20 000 lines of two points", [textToPlan(folder)], load());
    const rows = BIG_FILES.map(([what, element]) => {
      const text = fileOf(BIG_BYTES, element);
      const best = bestOf(folder, text, "");
      return {
        what,
        shapes: best.shapes,
        "import s": seconds(best.importMs),
        "memory, × file": Number((best.timesFile ?? NaN).toFixed(1)),
      };
    });
    report("Import of 25 MB", rows, load());
  } finally {
    rmSync(folder, { recursive: true });
  }
  return Promise.resolve();
}

function textToPlan(folder: string): Row {
  const random = generator();
  let count = 0;
  const lines = fileOf(Infinity, () => {
    if (count++ === 20_000) return null;
    const [x, y] = [10 + 180 * random(), 10 + 270 * random()];
    const end = `${(x + 5 * (random() - 0.5)).toFixed(3)} ${(y + 5 * (random() - 0.5)).toFixed(3)}`;
    return `<path d="M${x.toFixed(3)} ${y.toFixed(3)} L${end}" stroke-width="0.3"/>\n`;
  });
  const best = bestOf(folder, lines, "plan");
  return {
    MB: Number((lines.length / 1e6).toFixed(2)),
    "text to plan s": seconds(best.planMs ?? NaN),
  };
}

/** The fastest of a few runs: the others were slowed by other work on the machine. */
function bestOf(folder: string, text: string, then: string): Result {
  const file = path.join(folder, "drawing.svg");
  writeFileSync(file, text);
  const child = path.join(import.meta.dirname, "import-child.mjs");
  const results = Array.from({ length: RUNS }, () => {
    const out = execFileSync(process.execPath, [child, file, then], { encoding: "utf8" });
    return JSON.parse(out) as Result;
  });
  return results.sort((a, b) => (a.planMs ?? a.importMs) - (b.planMs ?? b.importMs))[0];
}

const BIG_FILES: readonly (readonly [string, (random: () => number) => string])[] = [
  ["paths of two points", (r) => `<path d="M${at(r, 200)} ${at(r, 280)} L${at(r, 200)} ${at(r, 280)}"/>\n`],
  ["polylines of 40 points", polyline],
  ["circles", (r) => `<circle cx="${at(r, 200)}" cy="${at(r, 280)}" r="${at(r, 3)}"/>\n`],
];

const at = (random: () => number, below: number): string => (below * random()).toFixed(2);

function polyline(random: () => number): string {
  let x = 200 * random();
  let y = 280 * random();
  let d = `M${x.toFixed(3)} ${y.toFixed(3)}`;
  for (let i = 1; i < 40; i++) {
    x += random() - 0.5;
    y += random() - 0.5;
    d += `L${x.toFixed(3)} ${y.toFixed(3)}`;
  }
  return `<path d="${d}"/>\n`;
}

function fileOf(bytes: number, element: (random: () => number) => string | null): string {
  const random = generator();
  const parts = [
    '<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="297mm" viewBox="0 0 210 297">\n',
    '<g fill="none" stroke="#000">\n',
  ];
  for (let length = 0; length < bytes;) {
    const part = element(random);
    if (part === null) break;
    parts.push(part);
    length += part.length;
  }
  return `${parts.join("")}</g></svg>\n`;
}

/** Lehmer's generator, so that every run has the same files. */
function generator(): () => number {
  let seed = 1;
  return () => (seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647;
}

const load = (): string => `Load while it ran: ${loadavg()[0].toFixed(1)} on ${cpus().length} cores.`;

const seconds = (ms: number): number => Number((ms / 1000).toFixed(2));
