import { addData, addDevice, copies, seconds, type Declare } from "./options.js";
import { resumePlot, runPlot, type PlotCommandOptions } from "./plot.js";
import { addSettingOptions, settingsFromOptions, type OptionValues } from "./settings-options.js";

export const declarePlot: Declare = (command, { io, setExitCode }) => {
  addData(
    addDevice(
      addSettingOptions(command.argument("[files...]", "drawings, one after the other; - for stdin")),
    ),
  )
    .option("--only <layer...>", "draw these layers only, by name or id")
    .option("--copies <number>", "number of times to plot each", copies, 1)
    .option(
      "--paper-s <seconds>",
      "time to wait for new paper between two plots, instead of for Enter",
      seconds,
    )
    .option("--resume", "resume the plot that a crash interrupted")
    .option("--restart", "discard an interrupted plot and start from the beginning")
    .option("--quiet", "print nothing but errors")
    .action(async (files: string[], options: PlotCommandOptions & OptionValues) => {
      if (options.resume === true) setExitCode(await resumePlot(files, options, io));
      else setExitCode(await runPlot(files, settingsFromOptions(options), options, io));
    });
};
