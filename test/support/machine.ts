import type { MachineProfile } from "../../src/index.js";
import type { MachineEvents } from "../../src/internal.js";

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
