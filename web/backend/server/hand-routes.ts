/** Manual moves and the console, through plotwright's server. */
import {
  commandAnswerSchema,
  plotterSchema,
  type PlotSettings,
  type Plotter,
} from "../../../src/schema/index.js";
import type { HandBackend } from "../backend.js";
import { pathOf, type Requests } from "./requests.js";

export const handRoutes = ({ ask }: Requests): HandBackend => {
  const move = (
    plotterId: string,
    name: string,
    body: Record<string, unknown> & { readonly settings: PlotSettings },
  ): Promise<Plotter> => ask(plotterSchema, "POST", `${pathOf("plotters", plotterId)}/${name}`, body);
  return {
    walk: (id, settings, xMm, yMm) => move(id, "walk", { xMm, yMm, settings }),
    jog: (id, settings, dxMm, dyMm) => move(id, "jog", { dxMm, dyMm, settings }),
    setHome: (id, settings) => move(id, "set-home", { settings }),
    cyclePen: (id, settings) => move(id, "cycle-pen", { settings }),
    testLine: (id, settings) => move(id, "test-line", { settings }),
    testPatch: (id, settings) => move(id, "test-patch", { settings }),
    frameBox: (id, settings, boxMm) => move(id, "frame", { boxMm, settings }),
    square: (id, settings, sizeMm) => move(id, "square", { sizeMm, settings }),
    servo: (id, settings, pos) => move(id, "servo", { pos, settings }),
    command: (id, line) => ask(commandAnswerSchema, "POST", `${pathOf("plotters", id)}/command`, { line }),
  };
};
