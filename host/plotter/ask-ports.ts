/** Asks the devices on serial ports what they are. Their USB chips do not always tell. */
import { PlotwrightError, type Clock } from "../../src/index.js";
import { allDrivers, type KnownDriver } from "../../src/internal.js";
import type { Devices, FoundBoard } from "./devices.js";

export interface AskParts {
  readonly devices: Devices;
  readonly clock: Clock;
}

export interface PortAnswer {
  /** Name and version, such as "Grbl 1.1h"; null: nothing that plotwright knows answers. */
  readonly answer: string | null;
  /** The `kind` of the controller that answers. */
  readonly controller: string | null;
  /** Why the port could not be opened; null if it could. */
  readonly fault: string | null;
}

export type AskedPort = FoundBoard & PortAnswer;

/** By one driver after the other, until one of their boards answers. */
export async function askPort(
  path: string,
  drivers: readonly KnownDriver[],
  { devices, clock }: AskParts,
): Promise<PortAnswer> {
  for (const { kind, driver } of drivers) {
    try {
      const answer = await driver.ask(await devices.open(path), clock);
      if (answer !== null) return { answer, controller: kind, fault: null };
    } catch (error) {
      if (!(error instanceof PlotwrightError)) throw error;
      return { answer: null, controller: null, fault: error.message };
    }
  }
  return { answer: null, controller: null, fault: null };
}

/**
 * Asks all devices that may be a plotter, each by the drivers that know its USB chip, and all at the same time. Only for a
 * user who wants that: some devices restart when their port is opened. `isTaken`: ports to leave out.
 */
export async function askPorts(
  parts: AskParts,
  isTaken: (path: string) => boolean = () => false,
): Promise<readonly AskedPort[]> {
  const ports = new Map<string, { readonly board: FoundBoard; readonly drivers: KnownDriver[] }>();
  for (const driver of await allDrivers()) {
    for (const board of await parts.devices.find(driver.ids)) {
      if (isTaken(board.path)) continue;
      const port = ports.get(board.path) ?? { board, drivers: [] };
      port.drivers.push(driver);
      ports.set(board.path, port);
    }
  }
  const asked = [...ports.values()].map(async ({ board, drivers }) => ({
    ...board,
    ...(await askPort(board.path, drivers, parts)),
  }));
  return (await Promise.all(asked)).sort((a, b) => (a.path < b.path ? -1 : 1));
}
