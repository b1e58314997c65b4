/** The strokes that the page prepares from a drawing's text. */
import { importDrawing, type StrokeSet } from "../../../src/index.js";
import { machineOf, prepareJob } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";

export const strokesOf = async (text: string, settings: PlotSettings): Promise<StrokeSet> =>
  prepareJob(await importDrawing("", text), settings, machineOf(settings)).prepared.strokes;
