/**
 * npm run compare: writes the tables of planners and of whole plots into docs/comparison.md.
 *
 * npm run compare -- FILE.svg... [--speed MM/S] [--accel MM/S2] [--corner MM]: plans each drawing under the rules of each
 * planner and prints a table.
 */
import path from "node:path";
import { Command, InvalidArgumentError } from "commander";
import {
  COMPARED_LIMITS,
  drawingOf,
  plannersTable,
  SAMPLE_NAMES,
  sampleDrawing,
  WHOLE_TABLES,
  wholePlotRows,
} from "./comparison-tables.js";
import { markdownTable, writePart } from "./doc-parts.js";

const command = new Command("compare")
  .argument("[file...]", "SVG files; none: the samples, written into docs/comparison.md")
  .option("--speed <mm/s>", "V", positive, COMPARED_LIMITS.speed)
  .option("--accel <mm/s²>", "A", positive, COMPARED_LIMITS.accel)
  .option("--corner <mm>", "δ", positive, COMPARED_LIMITS.deviation)
  .parse();

const { speed, accel, corner } = command.opts<{ speed: number; accel: number; corner: number }>();
for (const file of command.args) {
  const limits = { speed, accel, deviation: corner };
  console.log(`\n${plannersTable(path.basename(file, ".svg"), await drawingOf(file), limits)}`);
}
if (command.args.length === 0) {
  const planners: string[] = [];
  const plots: Awaited<ReturnType<typeof wholePlotRows>>[] = [];
  for (const name of SAMPLE_NAMES) {
    planners.push(plannersTable(name, await sampleDrawing(name), COMPARED_LIMITS));
    plots.push(await wholePlotRows(name));
  }
  writePart("comparison.md", "planners", planners.join("\n\n"));
  for (const part of Object.keys(WHOLE_TABLES) as (keyof typeof WHOLE_TABLES)[]) {
    const rows = [WHOLE_TABLES[part], ...plots.map((row) => row[part])];
    writePart("comparison.md", part, markdownTable(rows, 1));
  }
}

function positive(text: string): number {
  const value = Number(text);
  if (!(value > 0 && value < Infinity)) throw new InvalidArgumentError("a number above 0 is needed");
  return value;
}
