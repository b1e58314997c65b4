/**
 * Holds and emergency stops in shaped motion: the pen stops without swinging, and resumes where it stopped.
 * swinging-stops.test.ts tests the marks on the paper.
 */
import { describe, expect, it } from "vitest";
import type { StrokePosition } from "../../../../src/index.js";
import { SpringAxis } from "../../../../src/plan/shaping/spring-axis.js";
import { firmwareFeatures } from "../../../../src/drivers/ebb/protocol/firmware.js";
import { comeToRest } from "../../../../src/plan/rest/come-to-rest.js";
import { overshotPosition } from "../../../../src/position/overshoot.js";
import { DEFAULT_PEN, plan, stateAt } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { cases } from "../../../support/runs/full-run.js";
import { DRAWING, seamsMm, seeded } from "../../../support/plots/live-plot.js";
import {
  drawnUntilMm,
  KeepingPlanner,
  mmOf,
  planSAfter,
  ranTicks,
} from "../../../support/drawings/stop-truth.js";
import { FIGURES, inQuality, SPRINGS, swinging } from "../../../support/machines/swinging.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

/** A gap, a doubled stretch or a swing that is invisible, mm. */
const UNSEEN_MM = 0.05;
/** Plots with up to ten holds each, and emergency stops: in the full run 200 and 100 on each firmware. */
const PLOTS = cases(25, 3);
const EMERGENCY_STOPS = cases(100, 10);
const [springs] = SPRINGS;
const machine = swinging(springs);
const MOTION = inQuality("fast", springs);
const SETTINGS: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  motion: MOTION,
  machine: machine.id,
  customMachine: machine,
};

async function plotting(firmware: string) {
  const { world, driver } = await virtualPlotter({ firmware });
  const planner = new KeepingPlanner(DRAWING);
  const run = await world.run(driver.plot(planner, SETTINGS));
  return { world, run, planner, board: virtualBoardOf(driver) };
}

describe("a hold in shaped motion", () => {
  it("stops a swinging machine's pen without a swing, on the planned line", () => {
    const limits = { drawAccel: MOTION.draw.accelMmPerS2, travelAccel: MOTION.travel.accelMmPerS2 };
    const random = seeded(11);
    let stops = 0;
    for (const strokes of Object.values(FIGURES)) {
      const t = plan(strokes, MOTION, DEFAULT_PEN, { machine });
      for (let i = 0; i < 60; i++) {
        const tS = t.totalS * random();
        const { trajectory: rest, planS } = comeToRest(t, tS, limits, null);
        if (rest.blockCount === 0) continue;
        stops++;
        const axes = [
          new SpringAxis(springs.xHz, springs.damping),
          new SpringAxis(springs.yHz, springs.damping),
        ] as const;
        const begun = [...t.runs.startS].filter((startS) => startS <= tS).length - 1;
        for (let k = t.runs.firstBlock[begun]; k < t.runs.firstBlock[begun + 1]; k++) {
          const s = Math.min(t.durationS[k], tS - t.startS[k]);
          if (s <= 0) break;
          axes[0].advance(s, t.ax[k]);
          axes[1].advance(s, t.ay[k]);
        }
        for (let k = 0; k < rest.blockCount; k++) {
          axes[0].advance(rest.durationS[k], rest.ax[k]);
          axes[1].advance(rest.durationS[k], rest.ay[k]);
        }
        const swingMm = Math.hypot(
          Math.hypot(axes[0].d, axes[0].rate / (2 * Math.PI * springs.xHz)),
          Math.hypot(axes[1].d, axes[1].rate / (2 * Math.PI * springs.yHz)),
        );
        expect(swingMm).toBeLessThan(UNSEEN_MM);
        const end = stateAt(rest, rest.totalS);
        if (stateAt(t, tS).stroke < 0) continue;
        expect(Math.abs(end.alongMm - stateAt(t, planS - 1e-9).alongMm)).toBeLessThan(UNSEEN_MM);
      }
    }
    expect(stops).toBeGreaterThan(150);
  });

  it.each(["2.8.1", "3.0.3"])(
    "leaves no gap and no doubled stretch, and ends exactly, on firmware %s",
    async (firmware) => {
      const random = seeded(5);
      let held = 0;
      for (let i = 0; i < PLOTS; i++) {
        const { world, board, run } = await plotting(firmware);
        const holds: StrokePosition[] = [];
        let done = false;
        void run.finished.then(() => (done = true));
        const isDone = (): boolean => done;
        for (let k = 0; k < 10; k++) {
          await world.advance(0.1 + 1.2 * random());
          if (isDone()) break;
          await world.run(run.pause());
          if (run.holdPlace) holds.push(run.holdPlace);
          await world.run(run.resume());
        }
        expect(await world.run(run.finished)).toEqual({ kind: "done" });
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
        held += holds.length;
        expect(Math.max(0, ...seamsMm(board))).toBeLessThan(UNSEEN_MM);
        expect(board.statistics().longestUnderrunS).toBeLessThan(0.001);
      }
      expect(held).toBeGreaterThanOrEqual(8 * PLOTS);
    },
    120_000,
  );
});

describe("an emergency stop in shaped motion", () => {
  it.each(["2.8.1", "3.0.3"])(
    "resumes from where the pen swung to, on firmware %s",
    async (firmware) => {
      const random = seeded(17);
      const { hasClear, idleTicksTimed } = firmwareFeatures(firmware);
      for (let i = 0; i < EMERGENCY_STOPS; i++) {
        const { world, board, run, planner } = await plotting(firmware);
        await world.advance(0.1);
        const [plot] = planner.plots;
        await world.advance(0.95 * plot.trajectory.totalS * random());
        await world.run(run.emergencyStop());
        const ticks = ranTicks(board) - (hasClear ? 1 + idleTicksTimed : 0);
        const planS = planSAfter(plot.commands, ticks);
        const { stroke, alongMm, x, y } = stateAt(plot.trajectory, planS);
        const stop = { planS, place: { stroke, alongMm }, x, y };
        const truthMm =
          stroke < 0
            ? drawnUntilMm(DRAWING, plot, planS)
            : mmOf(DRAWING, overshotPosition(DRAWING, plot.trajectory, stop, springs));
        expect(Math.abs(mmOf(DRAWING, run.holdPlace!) - truthMm)).toBeLessThan(UNSEEN_MM);
        await world.run(Promise.all([run.cancel(), run.finished]));
      }
    },
    120_000,
  );
});
