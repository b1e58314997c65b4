import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  stateAt,
  type PenSettings,
  type PlanOptions,
  type Trajectory,
} from "../../../src/index.js";
import { comeToRest } from "../../../src/plan/rest/come-to-rest.js";
import { lowerAheadMm } from "../../../src/plan/pen/pen-flight.js";
import { liftTime, timedPen } from "../../../src/plan/pen/pen-times.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";
import { estimatedPosition } from "../../../src/position/pen-position.js";
import { strokeSetOf } from "../../support/drawings/arbitraries.js";
import { SPRINGS, swinging } from "../../support/machines/swinging.js";

const FAST: PenSettings = { ...DEFAULT_PEN, overlap: "fast" };
const SAFE: PenSettings = { ...DEFAULT_PEN, overlap: "safe" };

/** The servo's time for 30 %. */
const LIFT_S = liftTime(timedPen(SAFE, null), 60);

/** Three strokes, with a short travel, then a long one, between them; then the travel home. */
const planned = (pen: PenSettings, options?: PlanOptions): Trajectory =>
  plan(
    strokeSetOf([[[0, 0], [5, 0]], [[5, 6], [0, 6]], [[100, 100], [90, 90]]]), // prettier-ignore
    DEFAULT_MOTION,
    pen,
    options,
  );

/** Distance of the carriage from the stroke at the beginning of each drop in flight, mm. */
const dropsMm = (t: Trajectory): number[] =>
  penMovesOf(t)
    .filter(({ up }) => !up)
    .slice(1)
    .map(({ startS, beforeRun }) => {
      const block = t.runs.firstBlock[beforeRun];
      const { x, y } = stateAt(t, startS);
      return Math.hypot(x - t.x[block], y - t.y[block]);
    });

/** The same on a machine that swings. */
const shaped = (pen: PenSettings): Trajectory =>
  plan(
    strokeSetOf([[[0, 0], [5, 0]], [[5, 6], [0, 6]], [[100, 100], [90, 90]]]), // prettier-ignore
    { ...DEFAULT_MOTION, shaper: "zv" },
    pen,
    { machine: swinging(SPRINGS[0]) },
  );

describe("a pen in flight", () => {
  it("rises to 65 % of the way for a short travel, and to its full height for a long one", () => {
    for (const pen of [SAFE, FAST]) {
      const lifts = penMovesOf(planned(pen)).filter(({ up, waitS }) => up && waitS > 0);
      expect(lifts.map(({ heightPct }) => heightPct)).toEqual([30 + 0.65 * 30, 60, 60]);
    }
  });

  it("lets the carriage start when the slowest servo has lifted the tip clear of the paper", () => {
    // The servo takes 106.4 ms to the hop height, 19.5 % up. The tip is clear at 16.5 %. A slow servo takes a quarter more,
    // and a frame of 24 ms; and the carriage takes 14.1 ms for 0.1 mm.
    const slowestMs = 24 + ((16.5 / 19.5) * 106.37) / 0.8 - 14.14;
    for (const pen of [SAFE, FAST]) {
      expect(penMovesOf(planned(pen)).find(({ up }) => up)!.waitS).toBe(Math.ceil(slowestMs) / 1_000);
    }
    expect(penMovesOf(planned({ ...SAFE, extraLiftMs: 30 })).find(({ up }) => up)!.waitS).toBe(0.153);
  });

  it("comes down within 0.1 mm of the next stroke at a height that is clear of the paper", () => {
    const t = planned(SAFE);
    const drops = penMovesOf(t).filter(({ up }) => !up);
    for (const { startS, beforeRun } of drops.slice(1)) {
      const block = t.runs.firstBlock[beforeRun];
      const { x, y, stroke } = stateAt(t, startS);
      expect(stroke).toBe(-1);
      const awayMm = Math.hypot(x - t.x[block], y - t.y[block]);
      expect(awayMm).toBeGreaterThan(0.05);
      expect(awayMm).toBeLessThanOrEqual(0.1 + 1e-6);
    }
  });

  it("begins to come down at most lowerAheadMm before a stroke", () => {
    for (const pen of [SAFE, FAST, { ...FAST, upPct: 90 }]) {
      const t = planned(pen);
      const { accelMmPerS2 } = DEFAULT_MOTION.travel;
      const awayMm = dropsMm(t);
      expect(Math.max(...awayMm)).toBeLessThanOrEqual(lowerAheadMm(timedPen(pen, null), accelMmPerS2) + 1e-9);
      expect(Math.max(...awayMm)).toBeGreaterThan(0.9 * lowerAheadMm(timedPen(pen, null), accelMmPerS2));
    }
    expect(lowerAheadMm(timedPen(SAFE, null), 1_000)).toBeCloseTo(0.1, 9);
    expect(lowerAheadMm(timedPen({ ...FAST, overlap: "off" }, null), 1_000)).toBe(0);
  });

  it("begins to come down only at the stroke if the machine may lose the end of a travel", () => {
    const t = planned(FAST, { dropsAtStroke: true });
    expect(Math.max(...dropsMm(t))).toBeLessThanOrEqual(0.1 + 1e-6);
    expect(Math.min(...dropsMm(t))).toBeGreaterThan(0.05);
    const waitsOf = (one: Trajectory) => penMovesOf(one).flatMap(({ up, waitS }) => (up ? [waitS] : []));
    expect(waitsOf(t)).toEqual(waitsOf(planned(FAST)));
    expect(t.totalS).toBeLessThan(planned(SAFE).totalS);
    expect(planned(SAFE, { dropsAtStroke: true })).toEqual(planned(SAFE));
  });

  it("then comes down at the stroke also after a travel so short that it is still rising", () => {
    const strokes = strokeSetOf([[[0, 0], [5, 0]], [[5, 0.3], [0, 0.3]]]); // prettier-ignore
    const t = plan(strokes, DEFAULT_MOTION, FAST, { dropsAtStroke: true });
    const [, drop] = penMovesOf(t).filter(({ up }) => !up);
    expect(dropsMm(t)[0]).toBeCloseTo(0.1, 6);
    // A slow servo that falls from the hop height touches at 4/13 of the way, a frame later; without the time to brake over
    // 0.1 mm.
    expect(drop.waitS).toBe(Math.ceil(24 + ((6 / 19.5) * 112.07) / 0.8 - 14.14) / 1_000);
  });

  it("waits for the whole first drop, because the height of the pen is not known", () => {
    const [drop] = penMovesOf(planned(FAST));
    expect([drop.startS, drop.waitS]).toEqual([0, 0.154]);
  });

  it("hovers at the lower height before it comes down from the full one", () => {
    const moves = penMovesOf(planned(SAFE));
    const hover = moves.findIndex(({ up, waitS }) => up && waitS === 0);
    expect(moves[hover].heightPct).toBe(30 + 0.65 * 30);
    expect(moves[hover + 1].up).toBe(false);
    expect(moves[hover + 1].startS - moves[hover].startS).toBeCloseTo(
      // 78.9 ms from the full height, of a slow servo.
      0.024 + 0.07885 / 0.8,
      4,
    );
  });

  it("lifts at once and continues to the stroke's start, when it is stopped while it comes down", () => {
    for (const [t, pen] of [SAFE, FAST].flatMap((p) => [planned(p), shaped(p)].map((u) => [u, p] as const))) {
      const limits = { drawAccel: 500, travelAccel: 1_000 };
      for (const drop of penMovesOf(t).filter(({ up, beforeRun }) => !up && beforeRun > 0)) {
        const block = t.runs.firstBlock[drop.beforeRun];
        const endS = t.runs.startS[drop.beforeRun] - drop.waitS;
        for (const share of [0.05, 0.5, 0.95]) {
          const rest = comeToRest(t, drop.startS + share * (endS - drop.startS), limits, timedPen(pen, null));
          expect(rest.trajectory.endX).toBeCloseTo(t.x[block], 6);
          expect(rest.trajectory.endY).toBeCloseTo(t.y[block], 6);
          const lifts = penMovesOf(rest.trajectory).map(({ up, heightPct, waitS }) => [up, heightPct, waitS]);
          expect(lifts).toEqual([[true, 60, 0], [true, 60, LIFT_S]]); // prettier-ignore
          expect(penMovesOf(rest.trajectory)[0].startS).toBe(0);
          expect(estimatedPosition(t, rest.planS)).toEqual({
            stroke: t.runs.stroke[drop.beforeRun],
            alongMm: 0,
          });
        }
        // Before the drop it stops where it can, and the pen goes up from the hop height.
        const [lift, ...more] = penMovesOf(
          comeToRest(t, drop.startS - 0.001, limits, timedPen(pen, null)).trajectory,
        );
        expect([lift.up, lift.heightPct, lift.waitS, more]).toEqual([true, 60, LIFT_S, []]);
        // The pen is already up.
        expect(penMovesOf(comeToRest(t, drop.startS - 0.001, limits, null).trajectory)).toEqual([]);
      }
    }
  });

  it("keeps the times of a pen with its own rates up and down", () => {
    const gentle = { liftPctPerS: 60, dropPctPerS: 20 };
    expect(planned({ ...FAST, ...gentle })).toEqual(planned({ ...DEFAULT_PEN, overlap: "off", ...gentle }));
  });

  it("waits before a layer at full height, and then for the whole drop", () => {
    const strokes = strokeSetOf([[[0, 0], [5, 0]], [[5, 1], [0, 1]]], [0, 1]); // prettier-ignore
    const pen = { ...FAST, layers: { l1: { beforeMs: 3_000 } } };
    const moves = penMovesOf(plan(strokes, DEFAULT_MOTION, pen));
    expect(moves.map(({ up, waitS, heightPct }) => [up, waitS, heightPct]).slice(2, 4)).toEqual([
      [true, 3, 60],
      [false, 0.154, 30],
    ]);
  });
});
