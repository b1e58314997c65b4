/** A stop in the middle of a stroke uses the acceleration of that stroke's layer, not of other layers. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PEN,
  plan,
  stateAt,
  type StrokePosition,
  type StrokeSet,
  type Trajectory,
} from "../../../../../src/index.js";
import { comeToRest } from "../../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../../src/schema/index.js";
import { brakingAt } from "../../../../../src/drivers/ebb/machine/braking.js";

const ACCEL = { slow: 90, plain: 500, quick: 2_000 } as const;
const LAYERS = ["slow", "plain", "quick"] as const;

/** A long line and a circle in each layer. */
const SHAPES = LAYERS.flatMap((_, layer) => {
  const circle = Array.from({ length: 181 }, (_unused, i) => {
    const angle = (i / 90) * Math.PI;
    return [60 + 20 * Math.cos(angle), 40 + 45 * layer + 20 * Math.sin(angle)];
  });
  return [
    { layer, xy: [10, 20 + 45 * layer, 130, 20 + 45 * layer] },
    { layer, xy: circle.flat() },
  ];
});
const STROKES: StrokeSet = {
  xy: Float64Array.from(SHAPES.flatMap(({ xy }) => xy)),
  offsets: Uint32Array.from([
    0,
    ...SHAPES.map((_, i) => SHAPES.slice(0, i + 1).flatMap((s) => s.xy).length / 2),
  ]),
  layer: Uint16Array.from(SHAPES, ({ layer }) => layer),
  layers: LAYERS.map((id) => ({ id, name: id, color: null })),
};
const MOTION = {
  ...DEFAULT_PLOT_SETTINGS.motion,
  draw: { ...DEFAULT_PLOT_SETTINGS.motion.draw, speedMmPerS: 120, accelMmPerS2: ACCEL.plain },
  layers: { slow: { accelMmPerS2: ACCEL.slow }, quick: { accelMmPerS2: ACCEL.quick } },
};

const maxAccelOf = ({ blockCount, ax, ay }: Trajectory): number => {
  let max = 0;
  for (let k = 0; k < blockCount; k++) max = Math.max(max, Math.hypot(ax[k], ay[k]));
  return max;
};

describe("a stop in the middle of a stroke", () => {
  const settings = { ...DEFAULT_PLOT_SETTINGS, motion: MOTION };
  const trajectory = plan(STROKES, MOTION, DEFAULT_PEN);
  const { runs } = trajectory;

  it.each(SHAPES.map(({ layer }, stroke) => [stroke, LAYERS[layer]] as const))(
    "uses the full acceleration of stroke %i's layer (%s), and no more",
    (stroke, layer) => {
      const run = [...runs.stroke].indexOf(stroke);
      const lastBlock = runs.firstBlock[run + 1] - 1;
      const fromS = runs.startS[run];
      const untilS = trajectory.startS[lastBlock] + trajectory.durationS[lastBlock];
      let max = 0;
      for (let i = 1; i < 60; i++) {
        const tS = fromS + ((untilS - fromS) * i) / 60;
        const { alongMm } = stateAt(trajectory, tS);
        const { limits } = brakingAt(settings, STROKES, { stroke, alongMm }, "2.8.1");
        const stop = comeToRest(trajectory, tS, limits, null);
        max = Math.max(max, maxAccelOf(stop.trajectory));
        const end = stateAt(trajectory, stop.planS);
        expect(Math.hypot(stop.trajectory.endX - end.x, stop.trajectory.endY - end.y)).toBeLessThan(1e-9);
      }
      expect(max).toBeLessThanOrEqual(1.001 * ACCEL[layer]);
      expect(max).toBeGreaterThan(0.95 * ACCEL[layer]);
    },
  );

  it("is as gentle as the plan on firmware with constant speeds only", () => {
    const old = (place: StrokePosition | null) => brakingAt(settings, STROKES, place, "2.4.4").limits;
    const drawAccels = SHAPES.map((_, stroke) => old({ stroke, alongMm: 1 }).drawAccel);
    expect(drawAccels).toEqual([ACCEL.slow, ACCEL.slow, ACCEL.plain, ACCEL.plain, 500, 500]);
    expect(old(null).travelAccel).toBe(500);
  });

  it("uses that of travel between strokes", () => {
    expect(brakingAt(settings, STROKES, null, "2.8.1").limits.travelAccel).toBe(MOTION.travel.accelMmPerS2);
    const travel = [...runs.stroke].findIndex((stroke, run) => stroke < 0 && run > 0);
    const tS = runs.startS[travel] + 0.1;
    const stop = comeToRest(trajectory, tS, brakingAt(settings, STROKES, null, "2.8.1").limits, null);
    expect(maxAccelOf(stop.trajectory)).toBeLessThanOrEqual(1.001 * MOTION.travel.accelMmPerS2);
  });
});
