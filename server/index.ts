/** Entry "plotwright/server": creates the whole server, for embedding in other programs. */
export { createServer, type PlotwrightServer, type ServerOptions } from "./composition/create-server.js";
export type { HandMove } from "../src/schema/index.js";
export { NodePlotter, type NodePlotterOptions, type PlotterState } from "./plotter/node-plotter.js";
