/** Plots a drawing on a port and sends its parent each journal entry, until it is killed. */
import { NodePlotter } from "../plots/node-plotter.js";
import type { PenSettings } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "../plots/local-planner.js";

const driver = new NodePlotter({ device: process.argv[2] });
await driver.start();
const strokes = strokesOf(...(JSON.parse(process.argv[3]) as number[][]));
const pen = JSON.parse(process.argv[4] ?? "{}") as Partial<PenSettings>;
const settings = { ...DEFAULT_PLOT_SETTINGS, pen: { ...DEFAULT_PLOT_SETTINGS.pen, ...pen } };
await driver.plot(new LocalPlanner(strokes), settings, {
  journal: { record: (entry) => process.send!(entry) },
});
