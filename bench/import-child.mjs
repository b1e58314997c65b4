/**
 * One import in a fresh process, by the built library, as a program that uses it would do it. Prints JSON:
 * ms from text to drawing, and to a plan; the memory that it took at its highest beyond what the process had before.
 *
 *   node bench/import-child.mjs FILE [plan]
 */
import { readFileSync } from "node:fs";
import { DEFAULT_MOTION, DEFAULT_PEN, DEFAULT_PREPARE, importSvg, plan, prepare } from "../dist/src/index.js";

const status = (name) =>
  1024 * Number(new RegExp(`${name}:\\s+(\\d+)`).exec(readFileSync("/proc/self/status", "utf8"))[1]);
const canMeasure = process.platform === "linux";
const [file, then] = process.argv.slice(2);
const before = canMeasure ? status("VmRSS") : 0;
const text = readFileSync(file, "utf8");
const from = performance.now();
const drawing = importSvg(text);
const importMs = performance.now() - from;
if (then === "plan") plan(prepare(drawing, DEFAULT_PREPARE).strokes, DEFAULT_MOTION, DEFAULT_PEN);
const planMs = performance.now() - from;
const { user, system } = process.cpuUsage();
console.log(
  JSON.stringify({
    importMs,
    planMs,
    cpuMs: (user + system) / 1000,
    shapes: drawing.paths.count,
    timesFile: canMeasure ? (status("VmHWM") - before) / text.length : null,
  }),
);
