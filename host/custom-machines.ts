/** The built-in machine profiles and the user's custom ones, which are stored by `keeper`. */
import { MACHINES, PlotwrightError, type MachineProfile } from "../src/index.js";
import type { ListedMachine, PlotSettings } from "../src/schema/index.js";

/** Stores custom profiles. A method returns only after the change is stored. */
export interface MachineKeeper {
  save(machine: MachineProfile): void;
  remove(id: string): void;
}

export class CustomMachines {
  readonly #keeper: MachineKeeper;
  readonly #own: Map<string, MachineProfile>;

  constructor(own: readonly MachineProfile[], keeper: MachineKeeper) {
    this.#own = new Map(own.map((machine) => [machine.id, machine]));
    this.#keeper = keeper;
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
    this.#keeper.save(machine);
    this.#own.set(machine.id, machine);
    return machine;
  }

  /** Jobs that use the machine keep their copy. Throws `not-found`. */
  remove(id: string): void {
    mustBeOwn(id);
    if (!this.#own.delete(id)) throw new PlotwrightError("not-found", `There is no machine ${id}.`);
    this.#keeper.remove(id);
  }

  /** Adds the profile to settings that name a custom machine without containing its profile. */
  withMachine(settings: PlotSettings): PlotSettings {
    const own = this.#own.get(settings.machine);
    if (own === undefined || settings.customMachine?.id === settings.machine) return settings;
    return { ...settings, customMachine: own };
  }
}

export const isBuiltInMachine = (id: string): boolean => MACHINES.some((machine) => machine.id === id);

function mustBeOwn(id: string): void {
  if (!isBuiltInMachine(id)) return;
  throw new PlotwrightError(
    "conflict",
    `${id} is a built-in machine and can't be changed. Save yours under another id.`,
  );
}
