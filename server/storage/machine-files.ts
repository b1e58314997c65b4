/**
 * Custom machine profiles, one JSON file each in the data folder. An invalid file is skipped with a warning:
 * it may have been written by hand.
 */
import { mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { MACHINES, PlotwrightError, type MachineProfile } from "../../src/index.js";
import {
  firstFault,
  machineProfileSchema,
  type ListedMachine,
  type PlotSettings,
} from "../../src/schema/index.js";

export class MachineFiles {
  readonly #dir: string;
  readonly #own = new Map<string, MachineProfile>();
  /** Why files were skipped. */
  readonly warnings: readonly string[];

  /** @param dataDir may be missing; then there are no custom machines yet */
  constructor(dataDir: string) {
    this.#dir = join(dataDir, "machines");
    const warnings: string[] = [];
    for (const name of fileNames(this.#dir)) {
      try {
        const machine = readMachineFile(join(this.#dir, name));
        if (name !== `${machine.id}.json`)
          throw new Error(`its id is ${machine.id}, but the file name must be the id`);
        if (isBuiltIn(machine.id)) throw new Error("its id belongs to a built-in machine");
        this.#own.set(machine.id, machine);
      } catch (error) {
        warnings.push(`${join(this.#dir, name)} is skipped: ${(error as Error).message}`);
      }
    }
    this.warnings = warnings;
  }

  /** Built-in machines first. */
  list(): ListedMachine[] {
    const own = [...this.#own.values()].sort((a, b) => a.name.localeCompare(b.name));
    return [
      ...MACHINES.map((machine) => ({ ...machine, builtIn: true })),
      ...own.map((machine) => ({ ...machine, builtIn: false })),
    ];
  }

  /** Stores the profile before it is used. Throws `conflict` for the id of a built-in machine. */
  save(machine: MachineProfile): MachineProfile {
    mustBeOwn(machine.id);
    mkdirSync(this.#dir, { recursive: true, mode: 0o700 });
    const path = join(this.#dir, `${machine.id}.json`);
    // Written under another name and renamed, so that the file is never incomplete.
    writeFileSync(`${path}.new`, `${JSON.stringify(machine, null, 2)}\n`, { flush: true });
    renameSync(`${path}.new`, path);
    this.#own.set(machine.id, machine);
    return machine;
  }

  /** Jobs that use the machine keep their copy. Throws `not-found`. */
  remove(id: string): void {
    mustBeOwn(id);
    if (!this.#own.delete(id)) throw new PlotwrightError("not-found", `There is no machine ${id}.`);
    rmSync(join(this.#dir, `${id}.json`), { force: true });
  }

  /** Adds the profile to settings that name a custom machine without containing its profile. */
  withMachine(settings: PlotSettings): PlotSettings {
    const own = this.#own.get(settings.machine);
    if (own === undefined || settings.customMachine?.id === settings.machine) return settings;
    return { ...settings, customMachine: own };
  }
}

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

const isBuiltIn = (id: string): boolean => MACHINES.some((machine) => machine.id === id);

function mustBeOwn(id: string): void {
  if (!isBuiltIn(id)) return;
  throw new PlotwrightError(
    "conflict",
    `${id} is a built-in machine and can't be changed. Save yours under another id.`,
  );
}
