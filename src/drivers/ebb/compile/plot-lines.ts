/** A whole plot as text: for files, and for reading. */
import type { MachineProfile } from "../../../machines/profile.js";
import type { PenSettings } from "../../../settings/pen.js";
import { closingCommands, setUpCommands } from "../protocol/commands.js";
import type { CommandStream } from "./command-stream.js";
import { commandLine } from "./compile.js";

/** The lines that a plot sends, without their ends: motors on and pen set up, the commands, motors off. */
export function plotLines(
  commands: CommandStream,
  options: { readonly machine: MachineProfile; readonly pen: PenSettings; readonly firmware: string },
): string[] {
  const lines = setUpCommands(options.machine, options.pen, options.firmware);
  for (let index = 0; index < commands.count; index++) lines.push(commandLine(commands, index));
  return [...lines, ...closingCommands()];
}
