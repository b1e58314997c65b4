import { resolve } from "node:path";
import { PlotwrightError } from "../../../src/index.js";
import { withDrawingFile } from "../files.js";
import type { PlanCommandOptions } from "./plan.js";
import { runPlanInThread } from "./plan-thread.js";
import { addData, addFont, addLayerOptions, copiesOrEndless, type Declare } from "../options.js";
import { printed } from "../io.js";
import { addSettingOptions, type OptionValues } from "../settings-options.js";
import { settingsByPlotter } from "../client/known-plotters.js";

export const declarePlan: Declare = (command, { io }) => {
  addFont(
    addLayerOptions(
      addData(addSettingOptions(command.argument("<file>", "drawing: SVG, DXF, HPGL or JSON; - for stdin"))),
    ),
  )
    .option("--plotter <name>", "with the model, heights and presets of this plotter, by name or id")
    .option("--copies <number>", "number of times to plot it; 0: endless", copiesOrEndless, 1)
    .option("--json", "print one JSON object")
    .option("--pen-error", "report how far the pen deviates from the drawing when the machine swings")
    .option("--commands <out>", "write the machine's commands, one per line, to a file or - for stdout")
    .option("--firmware <version>", "firmware to make the commands for", "3.0.3")
    .option("--preview <out.svg>", "write a picture coloured by speed, to a file or -")
    .option(
      "--svg <out.svg>",
      "write the prepared drawing, its layers' settings as codes in their names, to a file or -",
    )
    .option("--strokes <out.json>", "write the prepared drawing as polylines in mm, to a file or -")
    .action(async (file: string, options: PlanCommandOptions & OptionValues) => {
      const { settings, note } = await settingsByPlotter(options);
      if (note !== null) io.err(printed`note: ${note}\n`);
      mustKeepDrawing(file, options);
      await withDrawingFile(file, (path) => runPlanInThread({ file: path, settings, options }, io));
    });
};

/** A result must not overwrite the drawing that it is made from. */
function mustKeepDrawing(file: string, options: PlanCommandOptions): void {
  for (const name of ["commands", "preview", "svg", "strokes"] as const) {
    const out = options[name];
    if (out === undefined || out === "-" || file === "-" || resolve(out) !== resolve(file)) continue;
    throw new PlotwrightError(
      "bad-setting",
      `--${name} ${out} would overwrite the drawing: choose another file.`,
    );
  }
}
