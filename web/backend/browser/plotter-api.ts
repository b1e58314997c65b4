/** The methods of the host for plotters: their settings, their connection and manual moves. */
import { usbIds } from "../../../src/internal.js";
import {
  commandRequestSchema,
  handMoveRequestSchema,
  handMoveSchema,
  penRequestSchema,
  plotterPatchSchema,
  plotterSettingsSchema,
  type HandMove,
  type PenRequest,
  type HandMoveRequest,
  type Plotter,
  type PlotterPatch,
  type PlotterSettings,
} from "../../../src/schema/index.js";
import type { PlotterPort } from "../../../host/plotter/plotter-port.js";
import type { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import { findFreePlotter, findPlotter } from "../../../host/queue/find-plotter.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import { parseWith } from "../../../host/parse-with.js";

export interface PlotterApiParts {
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
}

export const plotterApi = ({ queue, registry }: PlotterApiParts) => {
  const use = {
    isBusy: (id: string) => queue.isPlotterBusy(id),
    liveJobCount: (id: string) => queue.liveJobCount(id),
  };
  const plotterOf = (id: string): PlotterPort => findPlotter(registry.ports, id);
  const freePlotter = (id: string): PlotterPort => findFreePlotter(registry.ports, queue, id);
  return {
    savePlotterSettings: (id: string, settings: PlotterSettings): PlotterSettings =>
      registry.saveSettings(id, parseWith(plotterSettingsSchema, settings)),
    patchPlotter: (id: string, patch: PlotterPatch): Promise<Plotter> =>
      registry.patch(id, parseWith(plotterPatchSchema, patch), use),
    /** Called after the user has allowed the page to use a port: the plotter searches for its board again. */
    reconnect: async (id: string): Promise<Plotter> => {
      if (registry.stored(id)?.device === "auto") await registry.reconnect(id, use);
      else await registry.patch(id, { device: "auto" }, use);
      await plotterOf(id).settled();
      return plotterOf(id).snapshot();
    },
    devices: () => registry.devices(),
    /** For the browser's dialog of ports. The host has them, so that the page does not load the drivers. */
    usbIds: () => usbIds(),
    log: (id: string): string => plotterOf(id).log(),

    movePen: async (id: string, request: PenRequest): Promise<Plotter> => {
      const { up, heightPct, settings } = parseWith(penRequestSchema, request);
      const plotter = freePlotter(id);
      await plotter.pen(up, heightPct, queue.handSettings(id, { settings }));
      return plotter.snapshot();
    },
    motorsOff: async (id: string): Promise<Plotter> => {
      const plotter = freePlotter(id);
      await plotter.motorsOff();
      return plotter.snapshot();
    },
    moveByHand: async (id: string, move: HandMove, how: HandMoveRequest): Promise<Plotter> => {
      const wanted = parseWith(handMoveSchema, move);
      const plotter = freePlotter(id);
      await plotter.move(wanted, queue.handSettings(id, parseWith(handMoveRequestSchema, how)));
      return plotter.snapshot();
    },
    command: (id: string, line: string) =>
      freePlotter(id).command(parseWith(commandRequestSchema, { line }).line),
  };
};
