/**
 * One import in a fresh process, by the built library, as a program that uses it would do it. Prints JSON:
 * ms from the text in memory to a drawing, and on to a plan, the first time and once more; the processor time of
 * the first time, in the main thread and in all; the memory that it took at its highest beyond what the process had
 * before. Not counted: the start of Node, loading the library, reading the file.
 *
 *   node bench/import-child.mjs FILE [plan]
 */
import { readFileSync } from "node:fs";
import { DEFAULT_MOTION, DEFAULT_PEN, DEFAULT_PREPARE, importSvg, plan, prepare } from "../dist/src/index.js";

const canMeasure = process.platform === "linux";
const status = (name) =>
  1024 * Number(new RegExp(`${name}:\\s+(\\d+)`).exec(readFileSync("/proc/self/status", "utf8"))[1]);
/** V8 compiles and collects garbage in threads of its own. */
const mainThreadMs = () =>
  Number(readFileSync(`/proc/self/task/${process.pid}/schedstat`, "utf8").split(" ")[0]) / 1e6;
const allThreadsMs = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};

const [file, then] = process.argv.slice(2);
const residentBefore = canMeasure ? status("VmRSS") : 0;
const text = readFileSync(file, "utf8");

function run() {
  const mainBefore = canMeasure ? mainThreadMs() : NaN;
  const allBefore = allThreadsMs();
  const from = performance.now();
  const drawing = importSvg(text);
  const importMs = performance.now() - from;
  if (then === "plan") plan(prepare(drawing, DEFAULT_PREPARE).strokes, DEFAULT_MOTION, DEFAULT_PEN);
  const planMs = performance.now() - from;
  const mainMs = canMeasure ? mainThreadMs() - mainBefore : null;
  return { importMs, planMs, mainMs, allMs: allThreadsMs() - allBefore, shapes: drawing.paths.count };
}

const first = run();
const timesFile = canMeasure ? (status("VmHWM") - residentBefore) / text.length : null;
const again = then === "plan" ? run() : null;
console.log(
  JSON.stringify({ ...first, againMs: again?.planMs ?? null, againMainMs: again?.mainMs ?? null, timesFile }),
);
