import type { Job } from "../../../src/schema/index.js";
import type { Frame } from "../../../web/scene/renderer.js";
import { makeJob as makeMeasuredJob } from "./jobs.js";

export { makePlotter } from "./jobs.js";

/** A job that was not measured yet. */
export const makeJob = (id: string, more: Partial<Job> = {}): Job =>
  makeMeasuredJob(id, { stats: null, remainingS: null, ...more });

export const makeFrame = (offsetX: number): Frame => ({
  view: { scale: 1, offsetX, offsetY: 0 },
  width: 100,
  height: 100,
  ratio: 1,
  colorBy: "layer",
  showTravel: false,
  layerColors: [],
  layerWidthsMm: [],
  ghostColor: "#dcdad4",
  untilS: null,
});
