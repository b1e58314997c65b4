/** Profiles of machines, as stored or given. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, setUpCommands } from "../../../src/index.js";
import { machineProfileSchema } from "../../../src/schema/index.js";

const EBB = {
  id: "old-friend",
  name: "Old Friend",
  widthMm: 840,
  heightMm: 594,
  stepsPerMm: 100,
  motors: "mixed",
  flipX: true,
  controller: {
    kind: "ebb",
    microstepMode: 2,
    servoPosAt0Pct: 8_000,
    servoPosAt100Pct: 26_000,
    servoPin: 5,
    homing: { x: { port: "B", pin: 0, pressed: 0 }, y: { port: "B", pin: 2, pressed: 1 } },
  },
};

describe("a stored machine profile", () => {
  it("is read unchanged", () => {
    expect(machineProfileSchema.parse(EBB)).toEqual(EBB);
  });

  it("that is broken is refused with the field's name", () => {
    const fault = machineProfileSchema.safeParse({ ...EBB, controller: { ...EBB.controller, servoPin: 9 } });
    expect(fault.error?.issues[0]?.path).toEqual(["controller", "servoPin"]);
  });
});

describe("a profile with another controller", () => {
  const GRBL = {
    id: "my-grbl",
    name: "My Grbl",
    widthMm: 300,
    heightMm: 200,
    stepsPerMm: 80,
    motors: "direct",
    controller: {
      kind: "grbl",
      maxSpeedMmPerS: 100,
      accelMmPerS2: 1_000,
      junctionMm: 0.01,
      penUpZMm: 5,
      penDownZMm: 0,
      penSpeedMmPerS: 20,
      penAccelMmPerS2: 500,
      penWaitMs: 100,
    },
  };

  it("is read unchanged", () => {
    expect(machineProfileSchema.parse(GRBL)).toEqual(GRBL);
  });

  it("is refused with the field's name and range", () => {
    const fault = machineProfileSchema.safeParse({
      ...GRBL,
      controller: { ...GRBL.controller, accelMmPerS2: 0 },
    });
    expect(fault.error?.issues[0]).toMatchObject({
      path: ["controller", "accelMmPerS2"],
      message: "it must be more than 0, up to 50000 mm/s²",
    });
  });

  it("is refused if the kind is unknown", () => {
    const fault = machineProfileSchema.safeParse({ ...GRBL, controller: { kind: "marlin" } });
    expect(fault.error?.issues[0]?.path).toEqual(["controller", "kind"]);
  });

  it("is never driven as an EiBotBoard", () => {
    const profile = machineProfileSchema.parse(GRBL);
    expect(() => setUpCommands(profile, DEFAULT_PEN, "2.8.1")).toThrow(
      /My Grbl is not driven by an EiBotBoard/,
    );
  });
});
