import type { Command, Option } from "commander";
import { PlotwrightError } from "../../src/index.js";
import { printed } from "./io.js";
import { addData, addDevice, addLayerOptions, copies, seconds, type Declare } from "./options.js";
import { resumePlot, runPlot, type PlotCommandOptions } from "./plot.js";
import { addSettingOptions, plotterSettingsFromOptions, type OptionValues } from "./settings-options.js";

export const declarePlot: Declare = (command, { io, setExitCode }) => {
  addData(
    addDevice(
      addLayerOptions(
        addSettingOptions(command.argument("[files...]", "drawings, one after the other; - for stdin")),
      ),
    ),
  )
    .option("--copies <number>", "number of times to plot each", copies, 1)
    .option(
      "--paper-s <seconds>",
      "time to wait for new paper between two plots, instead of waiting for Enter",
      seconds,
    )
    .option("--resume", "resume a plot that was interrupted")
    .option("--restart", "discard an interrupted plot and start from the beginning")
    .option("--quiet", "print nothing but errors")
    .option("--json", "print progress and stops as JSON, one line for each")
    .action(async (files: string[], options: PlotCommandOptions & OptionValues) => {
      if (options.resume === true) {
        mustFitResume(command);
        setExitCode(await resumePlot(files, options, io));
        return;
      }
      const { settings, note } = plotterSettingsFromOptions(options);
      if (note !== null && options.quiet !== true) io.err(printed`note: ${note}\n`);
      setExitCode(await runPlot(files, settings, options, io));
    });
};

/** The other options belong to a new plot, and would have no effect. */
const WITH_RESUME = ["--resume", "--device", "--virtual-speed", "--data", "--quiet", "--json"];

function mustFitResume(command: Command): void {
  const other = command.options.find(
    (option) => isGiven(command, option) && !WITH_RESUME.includes(option.long ?? ""),
  );
  if (other === undefined) return;
  throw new PlotwrightError(
    "bad-setting",
    `--resume continues with the settings of the plot that was begun, so leave out ${other.long ?? other.flags}.`,
  );
}

/** `--fit` and `--no-fit` set the same value: only the value tells which of them was given. */
function isGiven(command: Command, option: Option): boolean {
  const name = option.attributeName();
  const isNegated = command.getOptionValue(name) === false;
  return command.getOptionValueSource(name) === "cli" && option.negate === isNegated;
}
