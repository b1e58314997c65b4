/** The pen after a fault in the middle of a stroke: it does not stay on the paper, where it would bleed. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { plotting } from "../../../support/plots/live-plot.js";
import { strokesOf } from "../../../support/plots/local-planner.js";

const FIRMWARES = ["2.4.2", "2.4.4", "2.5.3", "2.8.1", "3.0.3"];
const LONG_STROKE = strokesOf([10, 10, 250, 10, 250, 150]);

/** A plot in the middle of its stroke. */
async function drawing(firmware: string) {
  const plot = await plotting("junction", LONG_STROKE, firmware);
  const ended = plot.run.finished.then(
    () => "done",
    (error: Error) => error.message,
  );
  await plot.world.advance(2.5);
  expect(plot.board.state().penUp).toBe(false);
  return { ...plot, ended };
}

describe.each(FIRMWARES)("on firmware %s", (firmware) => {
  it("the pen is lifted when an unplugged cable is connected again", async () => {
    const { world, driver, board, ended } = await drawing(firmware);
    board.unplug();
    expect(await ended).toContain("unplugged");
    await world.advance(6);
    expect(driver.state.connection).toBe("idle");
    expect(board.state()).toMatchObject({ penUp: true, penPct: DEFAULT_PLOT_SETTINGS.pen.upPct });
  });

  it.skipIf(firmware < "2.4.3")("the pen is lifted with the stop of motors that make no step", async () => {
    const { world, board, ended } = await drawing(firmware);
    board.setMotionless(true);
    expect(await world.run(ended, 5)).toContain("does not finish its motion");
    await world.advance(1);
    expect(board.state()).toMatchObject({ penUp: true, penPct: DEFAULT_PLOT_SETTINGS.pen.upPct });
  });
});
