/**
 * Custom machine profiles, one JSON file each in the data folder. An invalid file is skipped with a warning:
 * it may have been written by hand.
 */
import { mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { MachineProfile } from "../../src/index.js";
import { firstFault, machineProfileSchema, type ServerEvent } from "../../src/schema/index.js";
import { CustomMachines, isBuiltInMachine, type MachineStore } from "../../host/custom-machines.js";

export class MachineFiles extends CustomMachines {
  /** Why files were skipped. */
  readonly warnings: readonly string[];

  /** @param dataDir may be missing; then there are no custom machines yet */
  constructor(dataDir: string, announce?: (event: ServerEvent) => void) {
    const dir = join(dataDir, "machines");
    const own: MachineProfile[] = [];
    const warnings: string[] = [];
    for (const name of fileNames(dir)) {
      try {
        const machine = readMachineFile(join(dir, name));
        if (name !== `${machine.id}.json`)
          throw new Error(`its id is ${machine.id}, but the file name must be the id`);
        if (isBuiltInMachine(machine.id)) throw new Error("its id belongs to a built-in machine");
        own.push(machine);
      } catch (error) {
        warnings.push(`${join(dir, name)} is skipped: ${(error as Error).message}`);
      }
    }
    super(own, storeIn(dir), announce);
    this.warnings = warnings;
  }
}

const storeIn = (dir: string): MachineStore => ({
  save: (machine) => {
    mkdirSync(dir, { recursive: true, mode: 0o700 });
    const path = join(dir, `${machine.id}.json`);
    // Written under another name and renamed, so that the file is never incomplete.
    writeFileSync(`${path}.new`, `${JSON.stringify(machine, null, 2)}\n`, { flush: true });
    renameSync(`${path}.new`, path);
  },
  remove: (id) => rmSync(join(dir, `${id}.json`), { force: true }),
});

/** Throws an error that says what is wrong with the file. */
const readMachineFile = (path: string): MachineProfile => machineOfText(readFileSync(path, "utf8"));

/** Parses a machine profile; throws an error that says what is wrong with it. */
export function machineOfText(text: string): MachineProfile {
  const result = machineProfileSchema.safeParse(JSON.parse(text));
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new Error(`${path}: ${words}`);
}

function fileNames(dir: string): string[] {
  try {
    return readdirSync(dir)
      .filter((name) => name.endsWith(".json"))
      .sort();
  } catch {
    return [];
  }
}
