/** A table of docs/motion.md: the time that drawings save if the carriage moves during pen moves. */
import { readFileSync } from "node:fs";
import path from "node:path";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  plan,
  prepare,
  type PrepareSettings,
} from "../src/index.js";
import type { PenOverlap } from "../src/internal.js";
import { markdownTable } from "./doc-parts.js";

const SAMPLES = path.join(import.meta.dirname, "..", "samples");
const sample = (name: string): string => readFileSync(path.join(SAMPLES, name), "utf8");

const LINES = Array.from(
  { length: 40 },
  (_, i) =>
    `<text x="10" y="${12 + 6 * i}" font-size="5">The quick brown fox jumps over the lazy dog ${i}</text>`,
);
const TEXT = `<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="260mm" viewBox="0 0 210 260">${LINES.join("")}</svg>`;

const SHAPES = Array.from({ length: 48 }, (_, i) => {
  const [x, y] = [20 + 30 * (i % 6), 20 + 30 * Math.floor(i / 6)];
  return i % 2 ? `<circle cx="${x}" cy="${y}" r="11"/>` : `<path d="M${x - 11} ${y + 9}h22l-11-20z"/>`;
});
const HATCHES = `<svg xmlns="http://www.w3.org/2000/svg" width="190mm" height="260mm" viewBox="0 0 190 260" fill="#246">${SHAPES.join("")}</svg>`;

const DRAWINGS: readonly (readonly [name: string, svg: string, settings?: Partial<PrepareSettings>])[] = [
  ["moonrise (short strokes)", sample("moonrise.svg")],
  ["40 lines of text", TEXT],
  ["48 shapes hatched 0.8 mm apart", HATCHES, { hatch: { ...DEFAULT_PREPARE.hatch, spacingMm: 0.8 } }],
  ["flower meadow (long curves)", sample("flower-meadow.svg")],
];

export async function penGainsTable(): Promise<string> {
  const machine = machineById("axidraw-v3");
  const rows = await Promise.all(
    DRAWINGS.map(async ([name, svg, settings]) => {
      const { strokes } = prepare(await importSvg(svg), { ...DEFAULT_PREPARE, fit: false, ...settings });
      const timeS = (overlap: PenOverlap, dropsAtStroke: boolean): number =>
        plan(strokes, DEFAULT_MOTION, { ...DEFAULT_PEN, overlap }, { machine, dropsAtStroke }).totalS;
      const [off, ...others] = [
        timeS("off", false),
        timeS("safe", false),
        timeS("fast", false),
        timeS("fast", true),
      ];
      const cells = others.map((s) => `${seconds(s)} (−${Math.round(100 - (100 * s) / off)} %)`);
      return [name, `${strokes.offsets.length - 1}`, seconds(off), ...cells];
    }),
  );
  return markdownTable([["drawing", "strokes", "off", "safe", "fast", "fast before 3.0.1"], ...rows]);
}

const seconds = (s: number): string =>
  `${Math.round(s)
    .toString()
    .replace(/\B(?=(\d{3})+$)/g, " ")} s`;
