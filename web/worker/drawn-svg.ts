/** What a drawing's plot draws, as SVG: every stroke in its pen's colour and width. */
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../src/schema/index.js";
import { openPlanner, type PlannerFile } from "./planner.js";

/** Plans the file in a worker of its own. Rejects with a message for the user. */
export const drawnSvg = async (file: PlannerFile, settings: PlotSettings): Promise<string> => {
  let close = (): void => undefined;
  try {
    return await new Promise<string>((resolve, reject) => {
      const fail = (message: string): void => reject(new Error(message));
      const planner = openPlanner({
        onImported: () => undefined,
        onPlanned: () => planner.export("svg", ""),
        onFault: ({ message }) => fail(message),
        onExported: (_format, svg) => resolve(svg),
        onExportFailed: fail,
      });
      close = () => planner.close();
      planner.request({ drawing: file, settings, firmware: null });
    });
  } finally {
    close();
  }
};

let last: Promise<unknown> = Promise.resolve();

/** For a thumbnail: with the default settings, one file after the other. */
export const thumbSvg = (file: PlannerFile): Promise<string> => {
  const drawing = last.then(() => drawnSvg(file, DEFAULT_PLOT_SETTINGS));
  last = drawing.catch(() => undefined);
  return drawing;
};
