import type { MachineProfile } from "../../../src/index.js";
import type { GrblController } from "../../../src/drivers/grbl/model/grbl-controller.js";
import type { MachineEvents } from "../../../src/internal.js";

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
export const GRBL = {
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
    arcs: true,
    penUpZMm: 5,
    penDownZMm: 0,
    penSpeedMmPerS: 50,
    penAccelMmPerS2: 1_000,
    penWaitMs: 100,
  },
} as const satisfies MachineProfile<GrblController>;

/** The same for a DrawCore, which refuses arcs. */
export const withoutArcs = (machine: MachineProfile): MachineProfile => ({
  ...machine,
  controller: { ...machine.controller, arcs: false },
});

/** The same with another pen lift. */
const withPen = (pen: Partial<GrblController>): MachineProfile<GrblController> => {
  const { kind, maxSpeedMmPerS, accelMmPerS2, junctionMm, arcs } = GRBL.controller;
  return { ...GRBL, controller: { kind, maxSpeedMmPerS, accelMmPerS2, junctionMm, arcs, ...pen } };
};
/** A servo on the output of the spindle. */
export const GRBL_SERVO = withPen({ penUpS: 600, penDownS: 300 });
/** Own lines for the pen. */
export const GRBL_LINES = withPen({ penUpLines: "M3 S90", penDownLines: "M4 S40", penWaitMs: 200 });
