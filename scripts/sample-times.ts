/** `npm run docs` writes the reference times of docs/comparison.md: the samples at true size, with the default settings. */
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { DEFAULT_MOTION, planSvg, trajectoryStats } from "../src/index.js";
import { MOTION_MODES } from "../src/internal.js";
import { markdownTable } from "./doc-parts.js";

const FOLDER = path.join(import.meta.dirname, "..", "samples");
const FIRMWARE = "3.0.3";

/** The time of the whole plot, s, as `plotwright plan --no-fit` reports it. */
export async function sampleTimesTable(): Promise<string> {
  const rows: string[][] = [];
  for (const file of readdirSync(FOLDER)) {
    const svg = readFileSync(path.join(FOLDER, file), "utf8");
    const timeS = async (mode: (typeof MOTION_MODES)[number]): Promise<string> => {
      const settings = { prepare: { fit: false }, motion: { ...DEFAULT_MOTION, mode } };
      const { trajectory } = await planSvg(svg, settings, { firmware: FIRMWARE, liftFirst: true });
      return trajectoryStats(trajectory).durationS.toFixed(2);
    };
    rows.push([file.replace(".svg", ""), ...(await Promise.all(MOTION_MODES.map(timeS)))]);
  }
  return markdownTable([["sample", ...MOTION_MODES.map((mode) => `${mode}, s`)], ...rows]);
}
