/**
 * The samples on the virtual Grbls, over a cable of 115 200 baud, by a host that does not run for 150 ms of each second: what is
 * drawn, and how long it takes. In the short run one sample on each Grbl.
 */
import { describe, expect, it } from "vitest";
import type { VirtualGrblOptions } from "../../../../src/drivers/grbl/virtual/virtual-settings.js";
import { sampleStrokes } from "../../../support/drawings/sample-strokes.js";
import { gridOf, linesOf, pointsOf } from "../../../support/drawings/polylines.js";
import { farthest } from "../../../support/drawings/segment-grid.js";
import { logOfPlot, newPlotter } from "../../../support/plots/grbl-plotter.js";
import { KeepingPlanner } from "../../../support/drawings/stop-truth.js";
import { IS_FULL } from "../../../support/runs/full-run.js";

const SAMPLES = [
  "three-colour-hills",
  "flower-meadow",
  "harmonograph",
  "hello-paper",
  "moonrise",
  "whirling-triangles",
];
const BYTES_PER_S = 115_200 / 10;
const STALLED_S = 0.15;
const MOST_AWAY_MM = 0.05;
/** Share of the predicted time. */
const MOST_LATE = 0.01;

/**
 * A Grbl with 15 moves and 128 characters holds about 20 short moves: at their usual 6 ms each less than the host stalls. So it
 * may come to rest a few times in curves of short pieces, which costs less than 1 % of the time.
 */
const SMALL_BUFFER_STARVES = 20;
const GRBLS: readonly (readonly [name: string, VirtualGrblOptions, mostStarved: number])[] = [
  ["Grbl 1.1", { face: "1.1" }, SMALL_BUFFER_STARVES],
  ["a Grbl 1.1 with 127 usable bytes", { face: "1.1", rxBytes: 127 }, SMALL_BUFFER_STARVES],
  ["a Grbl 1.1 that is built for CoreXY", { face: "1.1", isCore: true }, SMALL_BUFFER_STARVES],
  ["grblHAL", { face: "grblHAL" }, 0],
  ["FluidNC", { face: "FluidNC" }, SMALL_BUFFER_STARVES],
  ["DrawCore", { face: "DrawCore" }, SMALL_BUFFER_STARVES],
];

describe.each(SAMPLES.slice(0, IS_FULL ? undefined : 1))("%s", (name) => {
  it.each(GRBLS)(
    "is drawn within 0.05 mm and 1 % of the time on %s",
    { timeout: 600_000 },
    async (_, options, mostStarved) => {
      const strokes = await sampleStrokes(name);
      const { world, board, driver, begin, line } = await newPlotter(options);
      const planner = new KeepingPlanner(strokes);
      Object.assign(line(), { bytesPerS: BYTES_PER_S, stalledS: STALLED_S });
      const run = await begin(planner);
      const startS = world.nowS();
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      const tookS = world.nowS() - startS;
      const { lostCount, starvedCount, penUp } = board.state();
      expect({ lostCount, penUp }).toEqual({ lostCount: 0, penUp: true });
      expect(starvedCount).toBeLessThanOrEqual(mostStarved);
      expect(Math.abs(tookS / planner.plots[0].trajectory.totalS - 1)).toBeLessThan(MOST_LATE);
      expect(logOfPlot(driver)).not.toMatch(/ALARM|error:/);
      const drawn = board.drawn().flatMap(({ penDown, xy }) => (penDown ? [xy] : []));
      const asked = linesOf(strokes);
      expect(farthest(pointsOf(drawn), gridOf(asked))).toBeLessThan(MOST_AWAY_MM);
      expect(farthest(pointsOf(asked), gridOf(drawn))).toBeLessThan(MOST_AWAY_MM);
    },
  );
});
