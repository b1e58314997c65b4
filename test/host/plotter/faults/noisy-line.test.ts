/**
 * If lines that belong to no command arrive in mid-plot, the plot continues without a pause and ends at the right
 * position.
 */
import { describe, expect, it } from "vitest";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { plotting, seeded } from "../../../support/plots/live-plot.js";

type Noise = (random: () => number) => Uint8Array;

const NOISES: readonly (readonly [string, Noise])[] = [
  ["an OK too many", () => Buffer.from("OK\r\n")],
  ["300 bytes of garbage", (random) => Uint8Array.from({ length: 300 }, () => Math.floor(256 * random()))],
];
const COUNT = 12;

describe.each(["2.8.1", "3.0.3"])("a plot on firmware %s", (firmware) => {
  it.each(NOISES)("is not disturbed by %s", async (_, noise) => {
    const random = seeded(987_654_321);
    for (let i = 0; i < COUNT; i++) {
      const { world, board, driver, run } = await plotting("blend", FAULT_DRAWING, firmware);
      world.after(0.3 + 7 * random(), () => board.sendGarbage(noise(random)));
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
      expect(board.statistics().underrunS).toBe(0);
      await driver.close();
    }
  });
});
