/**
 * mm along the drawing, from which holds and stops resume: they match the pen at every instant, also on a
 * ramp.
 */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, stateAt } from "../../../src/index.js";
import { MOTION_MODES } from "../../../src/internal.js";
import { newMotionState, SAME_TIME_S } from "../../../src/plan/trajectory.js";
import { pointAt } from "../../../src/position/on-drawing.js";
import { strokesOf } from "../../support/plots/local-planner.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { RETRACED } from "../../support/drawings/stop-truth.js";

/**
 * Round the tip, which is cut off, they continue; and merged pieces run slightly ahead of the plan or behind
 * it.
 */
const WITHIN_MM = 0.08;

/** Straights and sharp corners, and points so dense that pieces are merged. */
const DRAWINGS = {
  "a line there and back": [10, 20, 40, 20, 10, 20],
  "a line of many points there and back": Array.from({ length: 161 }, (_, i) => [
    10 + 30 * (1 - Math.abs(1 - i / 80)),
    20,
  ]).flat(),
};

describe.each(MOTION_MODES)("mm along the drawing in %s mode", (mode) => {
  it.each(Object.entries(DRAWINGS))("match the pen's position on %s", (_, line) => {
    const trajectory = plan(strokesOf(line), { ...DEFAULT_MOTION, mode }, DEFAULT_PEN);
    for (let tS = 0; tS < trajectory.totalS; tS += 0.004) {
      const { stroke, alongMm, x } = stateAt(trajectory, tS);
      if (stroke < 0) continue;
      expect(Math.abs(30 - Math.abs(30 - alongMm) - (x - 10))).toBeLessThan(WITHIN_MM);
    }
  });

  it("match the pen's position on tips and retraced lines, where blocks reverse", () => {
    const trajectory = plan(RETRACED, { ...DEFAULT_MOTION, mode }, DEFAULT_PEN);
    let farthestMm = 0;
    for (let tS = 0; tS < trajectory.totalS; tS += 0.002) {
      const { stroke, alongMm, x, y } = stateAt(trajectory, tS);
      if (stroke < 0) continue;
      const point = pointAt(RETRACED, { stroke, alongMm });
      farthestMm = Math.max(farthestMm, Math.hypot(point.x - x, point.y - y));
    }
    expect(farthestMm).toBeLessThan(WITHIN_MM);
  });
});

/** Points of smooth lines are moved along them. A merged pair is interpolated. */
describe("mm along the drawing on smooth lines", () => {
  it.each([
    ["three-colour-hills", "not merged", null, 0.03],
    ["three-colour-hills", "merged", DEFAULT_MOTION.fit, 0.1],
    ["flower-meadow", "not merged", null, 0.03],
    ["harmonograph", "merged", DEFAULT_MOTION.fit, 0.1],
  ] as const)("match the pen's position on %s, %s", async (name, _, fit, withinMm) => {
    const strokes = await sampleStrokes(name);
    const trajectory = plan(strokes, { ...DEFAULT_MOTION, fit }, DEFAULT_PEN);
    const state = newMotionState();
    const { runs, startS } = trajectory;
    let farthestMm = 0;
    for (let run = 0; run < runs.count; run++) {
      // Harmonograph is one line of 100 m: some of its blocks are enough.
      const every = Math.ceil((runs.firstBlock[run + 1] - runs.firstBlock[run]) / 500);
      for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k += every) {
        const { stroke, alongMm, x, y } = stateAt(trajectory, startS[k] + SAME_TIME_S, state);
        if (stroke < 0) continue;
        const point = pointAt(strokes, { stroke, alongMm });
        farthestMm = Math.max(farthestMm, Math.hypot(point.x - x, point.y - y));
      }
    }
    expect(farthestMm).toBeLessThan(withinMm);
  });
});
