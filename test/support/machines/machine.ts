import type { MachineProfile } from "../../../src/index.js";
import type { MachineEvents, GrblController } from "../../../src/internal.js";

/** A mixed-axes machine of 80 microsteps a millimetre. */
export const AXIDRAW_LIKE: MachineProfile = {
  id: "test-mixed",
  name: "Test machine",
  widthMm: 300,
  heightMm: 218,
  stepsPerMm: 80,
  motors: "mixed",
  controller: {
    kind: "ebb",
    microstepMode: 1,
    servoPosAt0Pct: 9855,
    servoPosAt100Pct: 27831,
    servoPin: 4,
  },
};

/** Events that a test does not look at. */
export const NO_EVENTS: MachineEvents = {
  changed: () => undefined,
  buttonPressed: () => undefined,
  supplyRead: () => undefined,
  lost: () => undefined,
};

/** Grbl A of the golden figures: 10 000 mm/min, 1 000 mm/s², junction deviation 0.01 mm. */
export const GRBL: MachineProfile<GrblController> = {
  id: "my-grbl",
  name: "My Grbl",
  widthMm: 300,
  heightMm: 200,
  stepsPerMm: 250,
  motors: "direct",
  controller: {
    kind: "grbl",
    maxSpeedMmPerS: 10_000 / 60,
    accelMmPerS2: 1_000,
    junctionMm: 0.01,
    penUpZMm: 5,
    penDownZMm: 0,
    penSpeedMmPerS: 50,
    penAccelMmPerS2: 1_000,
    penWaitMs: 100,
  },
};
