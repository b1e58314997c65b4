/** The built-in machine profiles and the user's custom ones, which are stored by `store`. */
import { MACHINES, PlotwrightError, type MachineProfile } from "../src/index.js";
import type { ListedMachine, PlotSettings, ServerEvent } from "../src/schema/index.js";

/** Stores custom profiles. A method returns only after the change is stored. */
export interface MachineStore {
  save(machine: MachineProfile): void;
  remove(id: string): void;
}

export class CustomMachines {
  private readonly custom: Map<string, MachineProfile>;
  private readonly announce: (event: ServerEvent) => void;

  constructor(
    custom: readonly MachineProfile[],
    private readonly store: MachineStore,
    announce: (event: ServerEvent) => void = () => undefined,
  ) {
    this.custom = new Map(custom.map((machine) => [machine.id, machine]));
    this.announce = announce;
  }

  /** Built-in machines first. */
  list(): ListedMachine[] {
    const custom = [...this.custom.values()].sort((a, b) => a.name.localeCompare(b.name));
    return [
      ...MACHINES.map((machine) => ({ ...machine, builtIn: true })),
      ...custom.map((machine) => ({ ...machine, builtIn: false })),
    ];
  }

  /** Stores the profile before it is used. Throws `conflict` for the id of a built-in machine. */
  save(machine: MachineProfile): MachineProfile {
    mustBeCustom(machine.id, "can't be changed. Save yours under another id.");
    this.store.save(machine);
    this.custom.set(machine.id, machine);
    this.announce({ type: "machines", machines: this.list() });
    return machine;
  }

  /** Jobs that use the machine keep their copy. Throws `conflict` for a built-in machine, or `not-found`. */
  remove(id: string): void {
    mustBeCustom(id, "can't be removed.");
    if (!this.custom.has(id)) throw new PlotwrightError("not-found", `There is no machine ${id}.`);
    // Storage first: if it fails, the machine is still listed and can be removed later.
    this.store.remove(id);
    this.custom.delete(id);
    this.announce({ type: "machines", machines: this.list() });
  }

  /** Adds the profile to settings that name a custom machine without containing its profile. */
  withMachine(settings: PlotSettings): PlotSettings {
    const custom = this.custom.get(settings.machine);
    if (custom === undefined || settings.customMachine?.id === settings.machine) return settings;
    return { ...settings, customMachine: custom };
  }
}

export const isBuiltInMachine = (id: string): boolean => MACHINES.some((machine) => machine.id === id);

function mustBeCustom(id: string, otherwise: string): void {
  if (isBuiltInMachine(id))
    throw new PlotwrightError("conflict", `${id} is a built-in machine and ${otherwise}`);
}
