/** Everything that is sent, stored or written to a file: entry "plotwright/schema". */
export * from "./faults.js";
export * from "./name.js";
export * from "./settings.js";
export * from "./given-settings.js";
export * from "./plotter-settings.js";
export * from "./job.js";
export * from "./api.js";
export * from "./camera.js";
export * from "./sharing.js";
export * from "./machine.js";
export * from "./hand-moves.js";
export * from "./shared.js";
export * from "./library.js";
export * from "./live.js";
export * from "./operation.js";
export * from "./operations.js";
