import { Option } from "commander";
import { runBoard, type BoardCommandOptions } from "./board.js";
import { positive, springs, type Declare } from "./options.js";

export const declareBoard: Declare = (command, { io }) => {
  command
    .requiredOption("--pty <path>", "path where the serial port appears")
    .option("--firmware <version>", "firmware version of the board", "2.8.1")
    .addOption(
      new Option("--speed <factor>", "board seconds per real second (default: 1)").argParser(positive),
    )
    .addOption(
      new Option(
        "--springs <x,y>",
        "Hz at which the pen swings, and the damping (15,25,0.05); default: not at all",
      ).argParser(springs),
    )
    .option("--machine <id>", "plotter model (default: axidraw-v3)")
    .option("--svg <file>", "file for the drawn lines, or - for stdout (default: drawn.svg)")
    .action((options: BoardCommandOptions) => runBoard(options, io));
};
