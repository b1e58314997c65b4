/**
 * npm run compare:order -- FOLDER [ORDER...]: compares the order of strokes with that of other programs.
 *
 * Writes the strokes of each sample into FOLDER as SAMPLE.svg, in the order of the drawing. For each ORDER that another
 * program has left there as SAMPLE.ORDER.svg, the table (in docs/comparison.md) has its travel beside plotwright's own.
 */
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  plan,
  prepare,
  toSvg,
  trajectoryStats,
  type PrepareSettings,
} from "../src/index.js";
import { markdownTable } from "./doc-parts.js";

const SAMPLES = path.join(import.meta.dirname, "..", "samples");
/** Leaves the strokes where they are. */
const AS_DRAWN: PrepareSettings = { ...DEFAULT_PREPARE, fit: false, marginMm: 0, clipToMargins: false };
const IN_FILE_ORDER: PrepareSettings = { ...AS_DRAWN, order: "none", joinMm: 0 };
const OWN_ORDERS = ["none", "fast", "best"] as const;

const [folder, ...orders] = process.argv.slice(2);
if (folder === undefined) throw new Error("Name a folder: npm run compare:order -- FOLDER [ORDER...]");
mkdirSync(folder, { recursive: true });

const rows: string[][] = [];
for (const file of readdirSync(SAMPLES)) {
  const drawing = await importSvg(readFileSync(path.join(SAMPLES, file), "utf8"));
  const { strokes, paperWidthMm, paperHeightMm } = prepare(drawing, IN_FILE_ORDER);
  const svg = toSvg(strokes, { widthMm: paperWidthMm, heightMm: paperHeightMm });
  writeFileSync(path.join(folder, file), svg);
  const name = file.replace(".svg", "");
  const sorted = orders.map((order) => readFileSync(path.join(folder, `${name}.${order}.svg`), "utf8"));
  const others = await Promise.all(sorted.map((text) => travelOf(text, IN_FILE_ORDER)));
  const own = await Promise.all(OWN_ORDERS.map((order) => travelOf(svg, { ...AS_DRAWN, order })));
  rows.push([name, ...others, ...own]);
}
const head = ["mm / lifts / s", ...orders, ...OWN_ORDERS.map((order) => `plotwright ${order}`)];
console.log(markdownTable([head, ...rows]));

/** Distance with the pen up, from home and back to it, number of strokes, and time of the whole plot with the default settings. */
async function travelOf(svg: string, settings: PrepareSettings): Promise<string> {
  const { strokes } = prepare(await importSvg(svg), settings);
  const { travelMm, penLiftCount, durationS } = trajectoryStats(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN));
  return [travelMm, penLiftCount, durationS].map(Math.round).join(" / ");
}
