import type { MachineProfile } from "../../src/index.js";
import type { GrblController } from "../../src/internal.js";

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
