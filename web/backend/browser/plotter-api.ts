/** The methods of the host for plotters: their settings, their connection and manual moves. */
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { usbIds } from "../../../src/internal.js";
import {
  boxMmSchema,
  commandRequestSchema,
  jogRequestSchema,
  penRequestSchema,
  plotSettingsSchema,
  plotterPatchSchema,
  plotterSettingsSchema,
  servoRequestSchema,
  squareRequestSchema,
  walkRequestSchema,
  type PenRequest,
  type PlotSettings,
  type Plotter,
  type PlotterPatch,
  type PlotterSettings,
} from "../../../src/schema/index.js";
import type { CustomMachines } from "../../../host/custom-machines.js";
import type { HandMove } from "../../../host/plotter/hand-moves.js";
import type { PlotterPort } from "../../../host/plotter/plotter-port.js";
import type { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import { checked } from "./checked.js";

export interface PlotterApiParts {
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly machines: CustomMachines;
}

export const plotterApi = ({ queue, registry, machines }: PlotterApiParts) => {
  const use = {
    isBusy: (id: string) => queue.isPlotterBusy(id),
    liveJobCount: (id: string) => queue.liveJobCount(id),
  };
  const plotterOf = (id: string): PlotterPort => {
    const plotter = registry.ports.get(id);
    if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
    return plotter;
  };
  /** Throws `busy` while a job is on the plotter. */
  const freePlotter = (id: string): PlotterPort => {
    const plotter = plotterOf(id);
    if (queue.isPlotterBusy(id)) {
      throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait until it ends.");
    }
    return plotter;
  };
  return {
    savePlotterSettings: (id: string, settings: PlotterSettings): PlotterSettings =>
      registry.saveSettings(id, checked(plotterSettingsSchema, settings)),
    patchPlotter: (id: string, patch: PlotterPatch): Promise<Plotter> =>
      registry.patch(id, checked(plotterPatchSchema, patch), use),
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
      const { up, heightPct } = checked(penRequestSchema, request);
      const plotter = freePlotter(id);
      await plotter.pen(up, heightPct);
      return plotter.snapshot();
    },
    motorsOff: async (id: string): Promise<Plotter> => {
      const plotter = freePlotter(id);
      await plotter.motorsOff();
      return plotter.snapshot();
    },
    moveByHand: async (id: string, move: HandMove, settings: PlotSettings): Promise<Plotter> => {
      const wanted = checked(handMoveSchema, move);
      const plotter = freePlotter(id);
      await plotter.move(wanted, machines.withMachine(checked(plotSettingsSchema, settings)));
      return plotter.snapshot();
    },
    command: (id: string, line: string) =>
      freePlotter(id).command(checked(commandRequestSchema, { line }).line),
  };
};

const plain = z.object({ kind: z.enum(["home", "set-home", "cycle-pen", "test-line", "test-patch"]) });
const handMoveSchema: z.ZodType<HandMove> = z.union([
  plain,
  walkRequestSchema.omit({ settings: true }).extend({ kind: z.literal("walk") }),
  jogRequestSchema.omit({ settings: true }).extend({ kind: z.literal("jog") }),
  squareRequestSchema.omit({ settings: true }).extend({ kind: z.literal("square") }),
  servoRequestSchema.omit({ settings: true }).extend({ kind: z.literal("servo") }),
  z.object({ kind: z.literal("frame"), boxMm: boxMmSchema }),
]);
