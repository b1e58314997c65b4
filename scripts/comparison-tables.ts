/** The tables of docs/comparison.md that compare planners on one drawing, and whole programs on the samples. */
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import {
  DEFAULT_MOTION,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  prepare,
  type Drawing,
  type MachineProfile,
} from "../src/index.js";
import { motionOfQuality, penError } from "../src/internal.js";
import { comparePlanners } from "../test/support/reference-planners/compare.js";
import type { Limits } from "../test/support/reference-planners/polyline.js";
import { othersPlots, ownPlot, type WholePlot } from "../test/support/reference-planners/programs.js";
import { markdownTable } from "./doc-parts.js";

const SAMPLES = path.join(import.meta.dirname, "..", "samples");
export const SAMPLE_NAMES = readdirSync(SAMPLES).map((file) => file.replace(".svg", ""));
export const COMPARED_LIMITS: Limits = { speed: 50, accel: 500, deviation: 0.05 };

/** The machine on which the measured rows are planned, and on which the pen's distance is simulated. */
const SPRINGS = { xHz: 15, yHz: 25, damping: 0.05 };
const AXIDRAW = machineById("axidraw-v3");
const NEXTDRAW = machineById("nextdraw-8511");

export const sampleDrawing = (name: string): Promise<Drawing> => drawingOf(path.join(SAMPLES, `${name}.svg`));
export const drawingOf = (file: string): Promise<Drawing> => importSvg(readFileSync(file, "utf8"));

/** One drawing under the rules of each planner, all with the same limits. */
export function plannersTable(name: string, drawing: Drawing, limits: Limits): string {
  const { strokes } = prepare(drawing, { ...DEFAULT_PREPARE, fit: false });
  const [count, points] = [strokes.offsets.length - 1, strokes.xy.length / 2];
  const rows = comparePlanners(strokes, limits).map((row) => [
    row.planner,
    row.drawS.toFixed(2),
    row.worstAccel.toFixed(2),
    row.worstJump.toFixed(2),
    `${row.pieces}`,
  ]);
  const head = ["planner", "drawing s", "acceleration / A", "velocity jump", "pieces"];
  const { speed, accel, deviation } = limits;
  return [
    `### ${name}: ${count === 1 ? "1 stroke" : `${count} strokes`}, ${points} points`,
    `V ${speed} mm/s, A ${accel} mm/s², δ ${deviation} mm, J ${20 * accel} mm/s³`,
    markdownTable([head, ...rows], 1),
  ].join("\n\n");
}

/** The programs' plots of one sample on one machine, each with its own settings. */
function plotsOf(drawing: Drawing, machine: MachineProfile): WholePlot[] {
  const measured = { ...machine, springs: SPRINGS };
  const qualities = (["normal", "fast"] as const).map((quality) =>
    ownPlot(`plotwright, measured, ${quality}`, drawing, measured, {
      ...DEFAULT_MOTION,
      ...motionOfQuality(quality, SPRINGS),
    }),
  );
  return [...othersPlots(drawing, machine), ownPlot("plotwright", drawing, machine), ...qualities];
}

/** A sample's row in each table of whole plots. */
export async function wholePlotRows(name: string): Promise<Record<keyof typeof WHOLE_TABLES, string[]>> {
  const drawing = await sampleDrawing(name);
  const [axidraw, nextdraw] = [AXIDRAW, NEXTDRAW].map((machine) => plotsOf(drawing, machine));
  const timesOf = (plots: readonly WholePlot[]): string[] =>
    plots.map(({ totalS, penS }) => `${Math.round(totalS)} (${Math.round(penS)})`);
  const errors = axidraw.map(({ strokes, trajectory }) => {
    const { rmsMm, maxMm } = penError(strokes, trajectory, SPRINGS);
    return `${rmsMm.toFixed(3)} / ${maxMm.toFixed(2)}`;
  });
  return {
    "axidraw plots": [name, ...timesOf(axidraw)],
    "nextdraw plots": [name, ...timesOf(nextdraw)],
    "axidraw errors": [name, ...errors],
  };
}

const OWN = ["plotwright", "measured, normal", "measured, fast"];
const ON_AXIDRAW = ["saxi", "AxiDraw software", "NextDraw software", ...OWN];
/** The columns of the tables of whole plots, by the name of the part of the page. */
export const WHOLE_TABLES = {
  "axidraw plots": ["AxiDraw V3, s", ...ON_AXIDRAW],
  "nextdraw plots": ["NextDraw 8511, s", "saxi", "NextDraw software", ...OWN],
  "axidraw errors": ["off the line, mm", ...ON_AXIDRAW],
} as const;
