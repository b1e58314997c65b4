/** Connects to a port under the account that runs it, and sends the result to its parent. */
import { PlotterDriver } from "../../server/plotter/node-plotter.js";

const driver = new PlotterDriver({ device: process.argv[2] });
await driver.start();
process.send!(driver.state);
await driver.close();
process.disconnect();
