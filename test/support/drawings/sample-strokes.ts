/** The strokes of a sample drawing, fitted inside the margins. Prepared once: many tests plan them. */
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT } from "../../../scripts/setup.mjs";
import { DEFAULT_PREPARE, importSvg, prepare, type StrokeSet } from "../../../src/index.js";

const known = new Map<string, StrokeSet>();

export async function sampleStrokes(name: string): Promise<StrokeSet> {
  const before = known.get(name);
  if (before) return before;
  const text = readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8");
  const { strokes } = prepare(await importSvg(text), { ...DEFAULT_PREPARE, fit: true });
  known.set(name, strokes);
  return strokes;
}
