/** Commands that list boards and plotter models. */
import type { FoundBoard } from "../../host/plotter/connected-machine.js";
import { printableJson } from "../../src/internal.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { MachineFiles } from "../storage/machine-files.js";
import { mustBeDataFolder } from "./files.js";
import { printed, row, type CliIo } from "./io.js";
import { addData, addJson, type Declare } from "./options.js";

interface ListOptions {
  readonly data?: string;
  readonly json?: boolean;
}

export const declareDevices: Declare = (command, { io }) => {
  addJson(command).action((options: ListOptions) => runDevices(options, io));
};

export const declareMachines: Declare = (command, { io }) => {
  addJson(addData(command)).action((options: ListOptions) => runMachines(options, io));
};

const VIRTUAL: FoundBoard = {
  path: "virtual",
  description: "the built-in virtual board",
  serialNumber: null,
};

async function runDevices({ json }: ListOptions, io: CliIo): Promise<void> {
  const { findBoards } = await import("../serial/find-boards.js");
  const boards = [...(await findBoards()), VIRTUAL];
  if (json === true) {
    io.out(`${printableJson(boards)}\n`);
    return;
  }
  for (const { path, description, serialNumber } of boards) {
    io.out(row(path, `${description}${serialNumber === null ? "" : ` (${serialNumber})`}`));
  }
}

function runMachines({ data, json }: ListOptions, io: CliIo): void {
  mustBeDataFolder(data);
  const files = new MachineFiles(data ?? defaultDataDir());
  if (json === true) io.out(`${printableJson(files.list())}\n`);
  else {
    for (const { id, name, widthMm, heightMm, builtIn } of files.list()) {
      io.out(row(id, name, `${widthMm} × ${heightMm} mm`, ...(builtIn ? [] : ["your own"])));
    }
  }
  files.warnings.forEach((warning) => io.err(printed`${warning}\n`));
}
