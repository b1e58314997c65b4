/** The strokes of a sample drawing, prepared with the default settings. */
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT } from "../../scripts/setup.mjs";
import { DEFAULT_PREPARE, importSvg, prepare, type StrokeSet } from "../../src/index.js";

export const sampleStrokes = (name: string): StrokeSet =>
  prepare(importSvg(readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8")), DEFAULT_PREPARE)
    .strokes;
