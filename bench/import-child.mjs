/**
 * Imports in a fresh process with the built library, as a program that uses it would. Prints JSON: ms from
 * the text in memory to a drawing and, warm, to a plan; the peak memory of the first import beyond the memory
 * of the process before it. Not counted: the start of Node, loading the library, reading the file.
 *
 *   node bench/import-child.mjs FILE [plan]
 */
import { readFileSync } from "node:fs";
import { DEFAULT_MOTION, DEFAULT_PEN, DEFAULT_PREPARE, importSvg, plan, prepare } from "../dist/src/index.js";

const WARM_RUNS = 4;
const canMeasure = process.platform === "linux";
const status = (name) =>
  1024 * Number(new RegExp(`${name}:\\s+(\\d+)`).exec(readFileSync("/proc/self/status", "utf8"))[1]);

const [file, then] = process.argv.slice(2);
const residentBefore = canMeasure ? status("VmRSS") : 0;
const text = readFileSync(file, "utf8");

async function msOf(work) {
  const from = performance.now();
  const result = await work();
  return [performance.now() - from, result];
}
const textToPlan = async () =>
  plan(prepare(await importSvg(text), DEFAULT_PREPARE).strokes, DEFAULT_MOTION, DEFAULT_PEN);

const [importMs, drawing] = await msOf(() => importSvg(text));
const timesFile = canMeasure ? (status("VmHWM") - residentBefore) / text.length : null;
let planMs = null;
if (then === "plan") for (let run = 0; run < WARM_RUNS; run++) [planMs] = await msOf(textToPlan);
console.log(JSON.stringify({ importMs, planMs, shapes: drawing.paths.count, timesFile }));
