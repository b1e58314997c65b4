/** Plots a drawing on a port and sends its parent each journal entry, until it is killed. */
import { PlotterDriver } from "../../server/plotter/node-plotter.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "./local-planner.js";

const driver = new PlotterDriver({ device: process.argv[2] });
await driver.start();
const strokes = strokesOf(...(JSON.parse(process.argv[3]) as number[][]));
await driver.plot(new LocalPlanner(strokes), DEFAULT_PLOT_SETTINGS, {
  journal: { record: (entry) => process.send!(entry) },
});
