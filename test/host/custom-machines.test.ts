import { describe, expect, it } from "vitest";
import { CustomMachines, type MachineStore } from "../../host/custom-machines.js";
import { machineById } from "../../src/index.js";
import type { ServerEvent } from "../../src/schema/index.js";

const MINE = { ...machineById("axidraw-v3"), id: "mine" };

function customMachines(remove: MachineStore["remove"]): { machines: CustomMachines; ids(): string[] } {
  const machines = new CustomMachines([MINE], { save: () => undefined, remove });
  const custom = () => machines.list().filter(({ builtIn }) => !builtIn);
  return { machines, ids: () => custom().map(({ id }) => id) };
}

describe("storing a machine", () => {
  it("tells every page at once, and removing it too", () => {
    const told: ServerEvent[] = [];
    const store: MachineStore = { save: () => undefined, remove: () => undefined };
    const machines = new CustomMachines([], store, (event) => told.push(event));
    machines.save(MINE);
    const withMine = machines.list();
    machines.remove("mine");
    expect(withMine).toContainEqual({ ...MINE, builtIn: false });
    expect(told).toEqual([
      { type: "machines", machines: withMine },
      { type: "machines", machines: machines.list() },
    ]);
  });
});

describe("removing a machine", () => {
  it("keeps it in the list if the storage fails", () => {
    const { machines, ids } = customMachines(() => {
      throw new Error("EROFS: read-only file system");
    });
    expect(() => machines.remove("mine")).toThrow("EROFS");
    expect(ids()).toEqual(["mine"]);
  });

  it("asks the storage only for custom machines that exist", () => {
    const removed: string[] = [];
    const { machines, ids } = customMachines((id) => void removed.push(id));
    expect(() => machines.remove("other")).toThrow("There is no machine other.");
    expect(() => machines.remove("axidraw-v3")).toThrow(
      "axidraw-v3 is a built-in machine and can't be removed.",
    );
    machines.remove("mine");
    expect([removed, ids()]).toEqual([["mine"], []]);
  });
});
