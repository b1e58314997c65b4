/** Commands that list boards and plotter models. */
import type { FoundBoard } from "../../host/plotter/devices.js";
import { allUsbIds, printableJson } from "../../src/internal.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { MachineFiles } from "../storage/machine-files.js";
import { mustBeDataFolder } from "./files.js";
import { printed, row, type CliIo } from "./io.js";
import { addData, addJson, type Declare } from "./options.js";

interface AskOptions {
  readonly ask?: boolean;
  readonly json?: boolean;
}

interface ListOptions {
  readonly data?: string;
  readonly json?: boolean;
}

export const declareDevices: Declare = (command, { io }) => {
  command.option("--ask", "ask them what they are (opens their ports, which restarts some devices)");
  addJson(command).action((options: AskOptions) => runDevices(options, io));
};

export const declareMachines: Declare = (command, { io }) => {
  addJson(addData(command)).action((options: ListOptions) => runMachines(options, io));
};

const VIRTUAL: FoundBoard = {
  path: "virtual",
  description: "the built-in virtual board",
  serialNumber: null,
};

async function runDevices({ ask = false, json = false }: AskOptions, io: CliIo): Promise<void> {
  const { NODE_PARTS } = await import("../plotter/node-parts.js");
  const { askPorts } = await import("../../host/plotter/ask-ports.js");
  const asked = ask ? await askPorts(NODE_PARTS) : null;
  const boards = [...(asked ?? (await NODE_PARTS.devices.find(allUsbIds()))), VIRTUAL];
  if (json) {
    io.out(`${printableJson(boards)}\n`);
    return;
  }
  const answers = new Map(asked?.map(({ path, answer, fault }) => [path, answer ?? fault ?? "no answer"]));
  for (const { path, description, serialNumber } of boards) {
    const answer = answers.get(path);
    io.out(
      row(
        path,
        `${description}${serialNumber === null ? "" : ` (${serialNumber})`}`,
        ...(answer === undefined ? [] : [answer]),
      ),
    );
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
