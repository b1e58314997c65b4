import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan } from "../../../src/index.js";
import { graphData } from "../../../web/preview/graph.js";

const trajectory = plan(
  {
    xy: Float64Array.of(20, 20, 120, 20, 120, 90),
    offsets: Uint32Array.of(0, 3),
    layer: Uint16Array.of(0),
    layers: [{ id: "a", name: "A", color: null }],
  },
  DEFAULT_MOTION,
  DEFAULT_PEN,
);

describe("the graph's data", () => {
  it("covers the requested span evenly", () => {
    const { tS } = graphData(trajectory, 1, 3, 201);
    expect(tS[0]).toBe(1);
    expect(tS[200]).toBeCloseTo(3, 9);
    expect(tS[101] - tS[100]).toBeCloseTo(0.01, 9);
  });

  it("shows the limits of the plan and never more", () => {
    const { speedMmPerS, accelMmPerS2 } = graphData(trajectory, 0, trajectory.totalS, 2_000);
    const { draw, travel } = DEFAULT_MOTION;
    expect(Math.max(...speedMmPerS)).toBeLessThanOrEqual(travel.speedMmPerS + 1e-6);
    expect(Math.max(...speedMmPerS)).toBeGreaterThan(draw.speedMmPerS - 1e-6);
    expect(Math.max(...accelMmPerS2)).toBeLessThanOrEqual(travel.accelMmPerS2 * 1.001);
  });

  it("keeps a short peak visible when the whole plot is shown", () => {
    const wide = graphData(trajectory, 0, trajectory.totalS, 40);
    expect(Math.max(...wide.speedMmPerS)).toBeGreaterThan(DEFAULT_MOTION.draw.speedMmPerS * 0.9);
  });
});
