/** The user's own machines. */
import { describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import { freeId, measuredMachine, type Springs } from "../../../src/internal.js";

const SPRINGS: Springs = { xHz: 15, yHz: 25, damping: 0.05 };

describe("the id of a new machine", () => {
  it("is its name as a file's name, and differs from all others", () => {
    const own = [{ ...machineById("axidraw-v3"), id: "mein-plotter" }];
    expect(freeId("Mein Plötter", [])).toBe("mein-plotter");
    expect(freeId("Mein Plötter", own)).toBe("mein-plotter-2");
    expect(freeId("AxiDraw V3", own)).toBe("axidraw-v3-2");
    expect(freeId("???", own)).toBe("plotter");
  });
});

describe("what was measured", () => {
  it("is stored in a copy of a built-in machine, and in the user's own machine itself", () => {
    const copy = measuredMachine(machineById("axidraw-v3"), { ...SPRINGS, xHz: 15.04 }, []);
    expect(copy).toMatchObject({
      id: "axidraw-v3-measured",
      name: "AxiDraw V3, measured",
      springs: SPRINGS,
    });
    const again = measuredMachine(copy, { ...SPRINGS, xHz: 16 }, [copy]);
    expect(again).toEqual({ ...copy, springs: { ...SPRINGS, xHz: 16 } });
  });

  it("has a name of its own for each plotter of one model", () => {
    const model = machineById("axidraw-v3");
    const first = measuredMachine(model, SPRINGS, []);
    const second = measuredMachine(model, SPRINGS, [first]);
    expect([second.name, second.id]).toEqual(["AxiDraw V3, measured 2", "axidraw-v3-measured-2"]);
    const third = measuredMachine(model, SPRINGS, [first, second]);
    expect([third.name, third.id]).toEqual(["AxiDraw V3, measured 3", "axidraw-v3-measured-3"]);
  });
});
