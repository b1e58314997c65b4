/** Connects to a port under the account that runs it, and sends the result to its parent. */
import { NodePlotter } from "../plots/node-plotter.js";

const driver = new NodePlotter({ device: process.argv[2] });
await driver.start();
process.send!(driver.state);
await driver.close();
process.disconnect();
