import { describe, expect, it } from "vitest";
import type { PlotProgress } from "../../../../host/plotter/plotter-port.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const COMB = strokesOf(...Array.from({ length: 20 }, (_, i) => [10, 10 + 5 * i, 120, 10 + 5 * i]));

async function begin() {
  const { world, driver } = await virtualPlotter();
  const run = await world.run(driver.plot(new LocalPlanner(COMB), DEFAULT_PLOT_SETTINGS));
  const seen: PlotProgress[] = [];
  run.onProgress((progress) => seen.push(progress));
  await world.advance(4);
  return { world, run, seen };
}

/** Neither the share nor the remaining time jumps: consecutive reports differ by at most a second's work. */
function expectSteady(seen: readonly PlotProgress[]): void {
  const wholeS = seen[0].elapsedS + seen[0].remainingS;
  for (let i = 1; i < seen.length; i++) {
    const [before, now] = [seen[i - 1], seen[i]];
    expect(now.progress).toBeGreaterThanOrEqual(before.progress);
    expect(now.progress - before.progress).toBeLessThan(1 / wholeS);
    expect(Math.abs(now.remainingS - before.remainingS)).toBeLessThan(1);
  }
}

describe("the progress of a plot", () => {
  it("stays the same while the plot is held, and continues from there", async () => {
    const { world, run, seen } = await begin();
    await world.run(run.pause());
    const held = seen.at(-1)!;
    expect(held.progress).toBeLessThan(0.5);
    expect(held.remainingS).toBeGreaterThan(held.elapsedS);
    await world.run(run.resume());
    await world.run(run.finished);
    expectSteady(seen);
    expect(seen.at(-1)).toMatchObject({ progress: 1, remainingS: 0 });
  });

  it("stays the same wherever the plot is held, in motion or at rest", async () => {
    for (let afterS = 0; afterS < 1.5; afterS += 0.13) {
      const { world, run, seen } = await begin();
      await world.advance(afterS);
      await world.run(run.pause());
      expectSteady(seen);
      expect(seen.at(-1)!.progress).toBeLessThan(0.5);
    }
  });

  it("follows the place where a paused plot resumes, backwards and forwards", async () => {
    const { world, run, seen } = await begin();
    await world.run(run.pause());
    const held = seen.at(-1)!;
    run.moveHoldPlace({ strokes: 5 });
    const on = seen.at(-1)!;
    expect(on.progress - held.progress).toBeGreaterThan(4 / 20);
    expect(on.elapsedS + on.remainingS).toBeCloseTo(seen[0].elapsedS + seen[0].remainingS, 0);
    run.moveHoldPlace({ strokes: -6 });
    const back = seen.at(-1)!;
    expect(back.progress).toBeLessThan(held.progress);
    expect(back.remainingS).toBeGreaterThan(held.remainingS);
    await world.run(run.resume());
    await world.run(run.finished);
    expectSteady(seen.slice(seen.indexOf(back)));
    expect(seen.at(-1)).toMatchObject({ progress: 1, remainingS: 0 });
  });

  it("stays where it was when the plot is cancelled", async () => {
    const { world, run, seen } = await begin();
    const cancelled = run.cancel();
    await world.run(run.finished);
    await cancelled;
    expectSteady(seen);
    expect(seen.at(-1)!.progress).toBeLessThan(0.5);
  });

  it("follows a switch to another plan in motion, without a jump", async () => {
    const { world, run, seen } = await begin();
    const { pen } = DEFAULT_PLOT_SETTINGS;
    await world.run(run.change({ pen: { ...pen, downPct: pen.downPct + 5 } }));
    await world.run(run.finished);
    expectSteady(seen);
    expect(seen.at(-1)).toMatchObject({ progress: 1, remainingS: 0 });
  });
});
