/** The server on this computer: serve, service, logs. */
import { Command, Option } from "commander";
import { PlotwrightError } from "../../../src/index.js";
import { addData, addPort, hostNames, origins, port, positive, springs, type Declare } from "../options.js";
import type { ServeCommandOptions } from "./serve.js";
import { installService, serviceStatus, uninstallService } from "./service.js";
import type { ServiceOptions } from "./service-manager.js";
import { OPERATIONS, requestOf } from "../../../src/schema/index.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { bundleText, readLog } from "../../storage/log-book.js";
import { mustBeDataFolder, writeOut } from "../files.js";
import type { CliIo } from "../io.js";

export const declareServe: Declare = (command, { io }) => {
  addServe(command).action(async (options: ServeCommandOptions) => {
    const { runServe } = await import("./serve.js");
    await runServe(options, io);
  });
};

export const declareLogs: Declare = (command, { io, version }) => {
  addData(command)
    .option("--port <number>", "port of the running server", port, 9080)
    .option("--out <file>", "write it to a file (default: -, which is stdout)")
    .action((options: LogsOptions) => runLogs(options, io, version));
};

export const declareService: Declare = (service, { io, setExitCode }) => {
  const sub = (name: string, about: string): Command =>
    service
      .command(name)
      .description(about)
      .copyInheritedSettings(service)
      .option("--system", "for the whole computer, started at boot; needs root");
  sub("install", "write the service and start it; options of serve after --")
    .argument("[serve-options...]")
    .option("--user <name>", "with --system: the user that runs the server")
    .option("--print", "print the service without writing it")
    .action(async (serveArgs: string[], options: ServiceOptions) => {
      if (options.user !== undefined && options.system !== true) {
        throw new PlotwrightError("bad-setting", "--user: add --system; without it the service runs as you.");
      }
      // Check the options now: a service that fails on a mistyped option would fail unnoticed.
      const serve = addServe(new Command("serve").copyInheritedSettings(service));
      const server = serve.parse(serveArgs, { from: "user" }).opts<ServeCommandOptions>();
      await installService(options, { ...server, args: serveArgs }, io);
    });
  sub("uninstall", "stop it and remove the service").action((options: ServiceOptions) =>
    uninstallService(options, io),
  );
  sub("status", "report whether it runs").action((options: ServiceOptions) =>
    setExitCode(serviceStatus(options, io)),
  );
};

function addServe(command: Command): Command {
  return addData(addPort(command))
    .option("--port <number>", "port to listen on; 0 takes any free one", port, 9080)
    .option("--host <address>", "address to listen on (default: 127.0.0.1; all with --lan)")
    .option("--lan", "listen on the network; other devices have to be paired")
    .option("--no-mdns", "with --lan: do not announce plotwright.local")
    .option("--pair-always", "require pairing on this computer too")
    .option("--cert <file>", "certificate (PEM): serve https")
    .option("--key <file>", "the certificate's key (PEM)")
    .option("--allow-host <name...>", "host name to answer to, besides localhost and addresses", hostNames)
    .option("--allow-origin <url...>", "site whose pages may use the HTTP interface with a key", origins)
    .addOption(
      new Option(
        "--virtual-springs <x,y>",
        "Hz at which the virtual board's pen swings, and the damping (15,25,0.05); default: not at all",
      ).argParser(springs),
    )
    .option("--watch <folder>", "queue each drawing that is saved in this folder")
    .addOption(
      new Option("--shared-queue <url>", "share jobs with other servers through a PostgreSQL database").env(
        "PLOTWRIGHT_SHARED_QUEUE",
      ),
    )
    .addOption(
      new Option(
        "--mqtt <url>",
        "report the plotters to an MQTT broker and take its commands, as mqtt://user:password@host/topic",
      ).env("PLOTWRIGHT_MQTT"),
    )
    .option("--max-upload-mb <number>", "maximum size of a drawing, MB", positive, 200)
    .option("--open", "open the page in the browser");
}

interface LogsOptions {
  readonly data?: string;
  readonly port: number;
  readonly out?: string;
}

const PATIENCE_MS = 3_000;

/** From the running server, with the boards' logs; otherwise from its data folder. */
export async function runLogs(options: LogsOptions, io: CliIo, version: string): Promise<void> {
  const { data, port, out = "-" } = options;
  mustBeDataFolder(data);
  const text =
    (data === undefined ? await fromServer(port) : null) ??
    bundleText({ version, serverLog: readLog(data ?? defaultDataDir()) });
  writeOut(out, `${text}\n`, io);
  if (out !== "-") {
    io.err(`${out} is written. Look through it before you send it.\n`);
  }
}

async function fromServer(port: number): Promise<string | null> {
  try {
    const response = await fetch(`http://127.0.0.1:${port}${requestOf(OPERATIONS.operator.logs, {}).path}`, {
      signal: AbortSignal.timeout(PATIENCE_MS),
    });
    const text = await response.text();
    return response.ok && text.startsWith("plotwright ") ? text : null;
  } catch {
    return null;
  }
}
