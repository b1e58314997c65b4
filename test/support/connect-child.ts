/** Connects to a port as whoever it is run as, and tells its parent what came of it. */
import { PlotterDriver } from "../../server/plotter/plotter-driver.js";

const driver = new PlotterDriver({ device: process.argv[2] });
await driver.start();
process.send!(driver.state);
await driver.close();
process.disconnect();
