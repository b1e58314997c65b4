/** What a program's plot draws, on a board whose time passes only when the test lets it. */
import { describe, expect, it } from "vitest";
import { openOwnPlotter } from "../../../host/handle/own-plotter.js";
import { DEFAULT_MOTION, machineById, strokesOf, VirtualBoard, type Line } from "../../../src/index.js";
import { maxOffDrawingMm } from "../../../src/internal.js";
import { ManualClock } from "../../support/clocks/manual-clock.js";
import { compareDrawn } from "../../support/drawings/drawn-truth.js";

const LINES: readonly Line[] = [
  [
    [20, 20],
    [60, 20],
    [60, 50],
  ],
  [
    [80, 30],
    [120, 60],
  ],
];

async function onBoard() {
  const world = new ManualClock();
  const board = new VirtualBoard({ clock: world });
  const devices = { find: () => Promise.resolve([]), open: () => Promise.resolve(board.transport()) };
  const plotter = await world.run(openOwnPlotter({ device: "port" }, {}, { clock: world, devices }));
  return { world, board, plotter };
}

describe("a plot of a program", () => {
  it("draws its lines where they are on the paper, whatever the order and however often it is paused", async () => {
    const { world, board, plotter } = await onBoard();
    const plot = plotter.plot(LINES, { speed: 30 });
    plot.catch(() => undefined);
    for (let i = 0; i < 3; i++) {
      await world.advance(1.2);
      await world.run(plotter.pause());
      expect(plotter.state).toMatchObject({ activity: "held", penUp: true });
      await world.run(plotter.resume());
    }
    await world.run(plot);
    const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf(LINES), board.drawn());
    expect(Math.max(gapMm, overlapMm)).toBeLessThan(0.05);
    expect(awayMm).toBeLessThan(maxOffDrawingMm(DEFAULT_MOTION, machineById("axidraw-v3")) + 0.05);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
  });

  it("ends with its error when the board is lost, and can plot again when it is back", async () => {
    const { world, board, plotter } = await onBoard();
    const plot = plotter.plot(LINES).catch((error: unknown) => error);
    await world.advance(2);
    board.unplug();
    expect(await world.run(plot)).toMatchObject({ code: "disconnected" });
    expect(plotter.state.plot).toBeNull();
    await world.advance(5);
    expect(plotter.state.connection).toBe("idle");
    await world.run(plotter.home());
    await world.run(plotter.plot(LINES));
  });
});
