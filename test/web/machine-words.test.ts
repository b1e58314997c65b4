import { describe, expect, it } from "vitest";
import { MACHINES, type MachineProfile } from "../../src/index.js";
import { homeWords } from "../../web/plotter/machine-words.js";

describe("the words about home", () => {
  it("are only for a plotter without limit switches", () => {
    const [machine] = MACHINES;
    const homing = { x: { port: "C", pin: 0 }, y: { port: "C", pin: 1 } };
    const withSwitches: MachineProfile = { ...machine, controller: { ...machine.controller, homing } };
    expect(homeWords(machine)).toContain("no limit switches");
    expect(homeWords(withSwitches)).toBeNull();
  });
});
