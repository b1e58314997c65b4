/**
 * npm run compare -- FILE.svg [--speed MM/S] [--accel MM/S2] [--corner MM]
 * Plans one drawing under the rules of each system and of plotwright, and prints one table.
 */
import { readFileSync } from "node:fs";
import path from "node:path";
import { Command, InvalidArgumentError } from "commander";
import { DEFAULT_PREPARE, importSvg, prepare } from "../src/index.js";
import { comparePlanners, type ComparisonRow } from "../test/support/reference-planners/compare.js";

const command = new Command("compare")
  .argument("<file...>", "SVG files")
  .option("--speed <mm/s>", "V", positive, 50)
  .option("--accel <mm/s²>", "A", positive, 500)
  .option("--corner <mm>", "δ", positive, 0.05)
  .parse();

const { speed, accel, corner } = command.opts<{ speed: number; accel: number; corner: number }>();
for (const file of command.args) {
  const { strokes } = prepare(await importSvg(readFileSync(file, "utf8")), {
    ...DEFAULT_PREPARE,
    fit: false,
  });
  const [count, points] = [strokes.offsets.length - 1, strokes.xy.length / 2];
  console.log(`\n${path.basename(file)}: ${count === 1 ? "1 stroke" : `${count} strokes`}, ${points} points`);
  console.log(`V ${speed} mm/s, A ${accel} mm/s², δ ${corner} mm, J ${20 * accel} mm/s³\n`);
  console.log(table(comparePlanners(strokes, { speed, accel, deviation: corner })));
}

function table(rows: readonly ComparisonRow[]): string {
  const lines = rows.map(
    (row) =>
      `| ${row.planner.padEnd(30)} | ${row.drawS.toFixed(2).padStart(9)} | ${row.worstAccel.toFixed(2).padStart(16)} | ` +
      `${row.worstJump.toFixed(2).padStart(14)} | ${String(row.pieces).padStart(7)} |`,
  );
  return [
    "| planner                        | drawing s | acceleration / A | velocity jump  |  pieces |",
    "| ------------------------------ | --------: | ---------------: | -------------: | ------: |",
    ...lines,
  ].join("\n");
}

function positive(text: string): number {
  const value = Number(text);
  if (!(value > 0 && value < Infinity)) throw new InvalidArgumentError("a number above 0 is needed");
  return value;
}
