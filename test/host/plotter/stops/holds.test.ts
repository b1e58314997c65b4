/** Hold and emergency stop: what they leave on the paper, and where the motors end. */
import { describe, expect, it } from "vitest";
import type { PlannedPlot, PlanRequest } from "../../../../host/planning/planning.js";
import type { StrokeSet } from "../../../../src/index.js";
import { MOTION_MODES, type MotionMode } from "../../../../src/internal.js";
import { cases } from "../../../support/runs/full-run.js";
import {
  drawnMm,
  DRAWING,
  expectDrawn,
  plotting,
  seamsMm,
  seeded,
  settingsOf,
  type LivePlot,
} from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

/**
 * From pause to held: the motion in flight (a window and a command), slowing down from 150 mm/s, the lift, a
 * poll.
 */
const HELD_WITHIN_S = 0.5 + 0.15 + 0.25 + 0.05;

/** Accuracy of a drawn length: one step. */
const STEP_MM = 0.0125;

/** A planner that takes 3 s. */
class SlowPlanner extends LocalPlanner {
  constructor(
    strokes: StrokeSet,
    private readonly world: ManualClock,
  ) {
    super(strokes);
  }

  override async plan(request: PlanRequest): Promise<PlannedPlot> {
    await new Promise<void>((resolve) => void this.world.after(3, resolve));
    return super.plan(request);
  }
}

/** What an uninterrupted plot draws. */
async function wholeMm(mode: MotionMode, firmware?: string): Promise<number> {
  const { world, board, run } = await plotting(mode, DRAWING, firmware);
  await world.run(run.finished);
  return drawnMm(board);
}

/** Of a hold in each mode; emergency stops also on a firmware that can clear its queue. */
const STOPS = MOTION_MODES.flatMap((mode) => [
  { stop: "pause", mode, firmware: "2.8.1", seed: 7, count: cases(350, 50) } as const,
  ...["2.8.1", "3.0.3"].map(
    (firmware) => ({ stop: "emergencyStop", mode, firmware, seed: 41, count: cases(170, 25) }) as const,
  ),
]);

describe("a hold at any instant", () => {
  it.each(STOPS)(
    "leaves no gap and draws nothing twice, and ends exactly: $stop in $mode mode on firmware $firmware",
    async ({ stop, mode, firmware, seed, count }) => {
      const random = seeded(MOTION_MODES.indexOf(mode) + seed);
      const undisturbedMm = await wholeMm(mode, firmware);
      for (let i = 0; i < count; i++) {
        const { world, board, run } = await plotting(mode, DRAWING, firmware);
        await world.advance(0.05 + 11.4 * random());
        const beforeS = world.nowS();
        await world.run(run[stop]());
        expect(world.nowS() - beforeS).toBeLessThan(HELD_WITHIN_S);
        expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
        await world.advance(1);
        const heldAt = board.state();
        await world.advance(1);
        expect(board.state()).toMatchObject({ steps1: heldAt.steps1, steps2: heldAt.steps2 });
        await world.run(run.resume());
        expect(await world.run(run.finished)).toEqual({ kind: "done" });
        expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
        expect(Math.max(0, ...seamsMm(board))).toBeLessThan(0.02);
        expectDrawn(board, DRAWING, 0.05 + 0.02);
        // No longer stretch either: its ends would be apart.
        expect(Math.abs(drawnMm(board) - undisturbedMm)).toBeLessThan(0.02 + STEP_MM);
        if (stop === "pause") expect(board.statistics().underrunCount).toBe(0);
      }
    },
  );

  it("can be repeated before the first hold has come to rest", async () => {
    const { world, board, run } = await plotting("junction");
    for (let i = 0; i < 12; i++) {
      await world.advance(0.4);
      const paused = run.pause();
      const resumed = run.resume();
      await world.run(Promise.all([paused, resumed]));
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(Math.max(0, ...seamsMm(board))).toBeLessThan(0.02);
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("an emergency stop", () => {
  it("stops a 3.x board in the middle of its move", async () => {
    const { world, board, run } = await plotting("junction", DRAWING, "3.0.3");
    await world.advance(3);
    const stopped = run.emergencyStop();
    const at = board.state();
    await world.advance(0.01);
    expect(board.state()).toMatchObject({ steps1: at.steps1, steps2: at.steps2 });
    await world.run(stopped);
  });
});

describe("an emergency stop after everything is sent", () => {
  it("holds the plot while its last move is not over", async () => {
    const { world, board, run } = await plotting("junction");
    const isNearHome = (): boolean => Math.hypot(board.state().xMm, board.state().yMm) < 1;
    await world.advance(5);
    while (!isNearHome()) await world.advance(0.01);
    board.setFrozen(true);
    // By the plan it is over; the board is queried whether it is.
    await world.advance(1);
    const stopped = run.emergencyStop();
    board.setFrozen(false);
    await world.run(stopped);
    await world.run(run.resume());
    await world.run(run.finished);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("an emergency stop while the carriage would go home by itself", () => {
  /** Both motors' steps, now and a while later. */
  const expectStill = async ({ world, board }: LivePlot): Promise<void> => {
    const { steps1, steps2 } = board.state();
    expect(Math.abs(steps1) + Math.abs(steps2)).toBeGreaterThan(100);
    await world.advance(10);
    expect(board.state()).toMatchObject({ steps1, steps2, penUp: true, isBusy: false });
  };

  it("ends a plot that is being cancelled where it is", async () => {
    const plot = await plotting("junction");
    const { world, run } = plot;
    await world.advance(3);
    const cancelled = run.cancel();
    await world.advance(0.02);
    await world.run(run.emergencyStop());
    expect(await world.run(run.finished)).toEqual({ kind: "cancelled" });
    await world.run(cancelled);
    await expectStill(plot);
  });

  it("holds a plot that is drawn, and it goes home when resumed", async () => {
    const plot = await plotting("junction");
    const { world, board, run } = plot;
    const lastLine = DRAWING.offsets.length - 1;
    const drawnLines = (): number =>
      board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 2).length;
    while (drawnLines() < lastLine || !board.state().penUp) await world.advance(0.02);
    await world.advance(0.2);
    await world.run(run.emergencyStop());
    expect(plot.driver.state.activity).toBe("held");
    await expectStill(plot);
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("an emergency stop while the pen is lifted before the first move", () => {
  it("holds the plot before anything moves", async () => {
    const { world, driver, board } = await virtualPlotter();
    const run = await world.run(driver.plot(new LocalPlanner(DRAWING), settingsOf("junction")));
    // The pen's height is unknown after connecting, so it is lifted first.
    await world.advance(0.05);
    await world.run(run.emergencyStop());
    await world.advance(5);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, isBusy: false });
    expect(driver.state.activity).toBe("held");
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board, DRAWING, 0.05);
  });
});

describe("a change while the rest is being planned", () => {
  it("is part of the plan that is drawn", async () => {
    const { world, driver } = await virtualPlotter();
    const planner = new SlowPlanner(DRAWING, world);
    const run = await world.run(driver.plot(planner, settingsOf("junction")));
    await world.advance(1);
    await world.run(run.change({ speedPct: 50 }));
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    const { draw } = settingsOf("junction").motion;
    expect(planner.requests.at(-1)?.settings.motion.draw.speedMmPerS).toBe(draw.speedMmPerS / 2);
    expectDrawn(virtualBoardOf(driver), DRAWING, 0.05);
  });
});

describe("a plot that begins held", () => {
  it.each([
    ["from its beginning", undefined],
    ["in the middle of the drawing", { stroke: 1, alongMm: 2 }],
  ])("tells it to a listener that is added later, and moves only when it is resumed, %s", async (_, from) => {
    const { world, driver } = await virtualPlotter();
    const start = { held: true, from };
    const run = await world.run(driver.plot(new LocalPlanner(DRAWING), settingsOf("junction"), start));
    await world.advance(5);
    const told: boolean[] = [];
    run.onHeld((held) => told.push(held));
    expect(told).toEqual([true]);
    expect(virtualBoardOf(driver).state()).toMatchObject({ steps1: 0, steps2: 0 });
    await world.run(run.resume());
    expect(told).toEqual([true, false]);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
  });
});

describe("the hold point", () => {
  it("can be moved back, viewed with the pen up, and resumed from", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(6);
    await world.run(run.pause());
    const held = run.holdPlace!;
    expect(run.moveHoldPlace({ mm: -10 })).toEqual({ stroke: held.stroke, alongMm: held.alongMm - 10 });
    const before = board.state();
    await world.run(run.checkHoldPlace());
    const there = board.state();
    expect(there.penUp).toBe(true);
    const movedMm = Math.hypot(there.xMm - before.xMm, there.yMm - before.yMm);
    expect(movedMm).toBeGreaterThan(9);
    expect(movedMm).toBeLessThanOrEqual(10.05);
    await world.run(run.resume());
    await world.run(run.finished);
    expectDrawn(board, DRAWING, 0.05);
  });

  it("moves by whole strokes and stays within the drawing", async () => {
    const { world, run } = await plotting("junction");
    await world.advance(6);
    await world.run(run.pause());
    const { stroke } = run.holdPlace!;
    const [x, y] = DRAWING.xy.subarray(2 * DRAWING.offsets[stroke]);
    expect(run.placeAfter({ strokes: -1 })).toEqual({ stroke, alongMm: 0, x, y });
    expect(run.moveHoldPlace({ strokes: -1 })).toEqual({ stroke, alongMm: 0 });
    expect(run.moveHoldPlace({ strokes: 2 })).toEqual({ stroke: stroke + 2, alongMm: 0 });
    expect(run.moveHoldPlace({ strokes: -99 })).toEqual({ stroke: 0, alongMm: 0 });
    expect(run.moveHoldPlace({ mm: 1e6 }).stroke).toBe(3);
    await world.run(Promise.all([run.cancel(), run.finished]));
  });
});
