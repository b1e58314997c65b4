/** The bounding box of a drawing's strokes on the machine, as placed by its settings. */
import { machineOf } from "../../src/internal.js";
import type { BoxMm, PlotSettings } from "../../src/schema/index.js";
import { openPlanner } from "./planner.js";

/** Throws the errors of import and prepare; `bad-file` for a drawing without strokes. */
export async function drawingBoxMm(
  path: string,
  settings: PlotSettings,
  only?: readonly string[],
): Promise<BoxMm> {
  const planner = await openPlanner({ path, settings, machine: machineOf(settings), only });
  try {
    const { xy } = planner.strokes;
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < xy.length; i += 2) {
      x0 = Math.min(x0, xy[i]);
      x1 = Math.max(x1, xy[i]);
      y0 = Math.min(y0, xy[i + 1]);
      y1 = Math.max(y1, xy[i + 1]);
    }
    return { xMm: x0, yMm: y0, widthMm: x1 - x0, heightMm: y1 - y0 };
  } finally {
    await planner.close();
  }
}
