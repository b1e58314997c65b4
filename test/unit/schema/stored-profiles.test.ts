/** Profiles and jobs as stored by the first version can still be opened. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, setUpCommands } from "../../../src/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  plotSettingsSchema,
} from "../../../src/schema/index.js";

const FORMAT_1 = {
  id: "old-friend",
  name: "Old Friend",
  widthMm: 840,
  heightMm: 594,
  stepsPerMm: 100,
  motors: "mixed",
  flipX: true,
  microstepMode: 2,
  servoPosAt0Pct: 8_000,
  servoPosAt100Pct: 26_000,
  servoPin: 5,
  homing: { x: { port: "B", pin: 0, pressed: 0 }, y: { port: "B", pin: 2, pressed: 1 } },
};
const FORMAT_2 = {
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
  it("of format 1 is converted to the current one", () => {
    expect(machineProfileSchema.parse(FORMAT_1)).toEqual(FORMAT_2);
  });

  it("of format 2 stays unchanged", () => {
    expect(machineProfileSchema.parse(FORMAT_2)).toEqual(FORMAT_2);
  });

  it("that is broken is refused with the field's name", () => {
    const fault = machineProfileSchema.safeParse({ ...FORMAT_1, servoPin: 9 });
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

describe("a stored job's settings", () => {
  it("keep their machine", () => {
    const stored = { ...DEFAULT_PLOT_SETTINGS, machine: "old-friend", customMachine: FORMAT_1 };
    expect(plotSettingsSchema.parse(stored).customMachine).toEqual(FORMAT_2);
  });
});
