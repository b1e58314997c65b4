/**
 * The methods that pages call on the host. As in the server's routes, arguments are checked by the schemas of
 * src/schema.
 */
import { z } from "zod";
import { PlotwrightError, type MachineProfile } from "../../../src/index.js";
import { usbIds } from "../../../src/internal.js";
import {
  boxMmSchema,
  commandRequestSchema,
  firstFault,
  jobChangeSchema,
  jobPatchSchema,
  jogRequestSchema,
  machineProfileSchema,
  movePlaceSchema,
  newJobSchema,
  penRequestSchema,
  plotSettingsSchema,
  plotterPatchSchema,
  plotterSettingsSchema,
  queueSettingsSchema,
  servoRequestSchema,
  squareRequestSchema,
  walkRequestSchema,
  type Job,
  type JobChange,
  type JobPatch,
  type MovePlace,
  type NewJob,
  type PenRequest,
  type PlotSettings,
  type Plotter,
  type PlotterPatch,
  type PlotterSettings,
  type QueueSettings,
} from "../../../src/schema/index.js";
import type { CustomMachines } from "../../../host/custom-machines.js";
import type { HandMove } from "../../../host/plotter/hand-moves.js";
import type { PlotterPort } from "../../../host/plotter/plotter-port.js";
import type { PlotterRegistry } from "../../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import type { Notices } from "../../../host/queue/notices.js";
import type { DrawingText } from "../../worker/drawing-text.js";
import type { JobAction } from "../backend.js";

export interface HostParts {
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly notices: Notices;
  readonly machines: CustomMachines;
  readonly drawings: {
    /** Resolves with its id when it is stored. */
    add(drawing: DrawingText): Promise<string>;
    read(id: string): Promise<DrawingText>;
  };
}

export type HostApi = ReturnType<typeof hostApi>;
export type HostMethod = keyof HostApi;

/** The size of text is only estimated by its length, because it is not encoded. */
const sizeOf = (drawing: DrawingText): number =>
  typeof drawing === "string" ? drawing.length : drawing.byteLength;

export const hostApi = ({ queue, registry, notices, machines, drawings }: HostParts) => {
  const use = {
    isBusy: (id: string) => queue.isPlotterBusy(id),
    liveJobCount: (id: string) => queue.liveJobCount(id),
  };
  const plotterOf = (id: string): PlotterPort => {
    const plotter = registry.ports.get(id);
    if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
    return plotter;
  };
  const freePlotter = (id: string): PlotterPort => {
    const plotter = plotterOf(id);
    if (queue.isPlotterBusy(id)) {
      throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait until it ends.");
    }
    return plotter;
  };
  const settingsOf = (value: PlotSettings): PlotSettings =>
    machines.withMachine(checked(plotSettingsSchema, value));
  const actions: Readonly<Record<JobAction, (id: string) => Job | Promise<Job>>> = {
    start: async (id) => {
      await queue.plotterSettled(id);
      return queue.start(id);
    },
    recover: async (id) => {
      await queue.plotterSettled(id);
      return queue.recover(id);
    },
    pause: (id) => queue.pause(id),
    resume: (id) => queue.resume(id),
    cancel: (id) => queue.cancel(id),
    requeue: (id) => queue.requeue(id),
    "emergency-stop": (id) => queue.emergencyStop(id),
    "check-place": (id) => queue.checkPlace(id),
  };

  return {
    addJob: async (job: Omit<NewJob, "drawing" | "drawingId">, drawing: DrawingText): Promise<Job> => {
      if (sizeOf(drawing) === 0) throw new PlotwrightError("bad-file", "The file is empty.");
      const {
        copies = 1,
        settings,
        name,
        plotterId,
        from,
      } = checked(newJobSchema, { ...job, drawingId: "sent" });
      const id = await drawings.add(drawing);
      const first = await queue.add({
        name,
        plotterId,
        from,
        settings: machines.withMachine(settings),
        drawing: { id, bytes: sizeOf(drawing) },
      });
      for (let copy = 1; copy < copies; copy++) queue.duplicate(first.id);
      return first;
    },
    patchJob: (id: string, patch: JobPatch): Promise<Job> => {
      const { settings, ...others } = checked(jobPatchSchema, patch);
      return queue.patch(id, {
        ...others,
        ...(settings === undefined ? {} : { settings: machines.withMachine(settings) }),
      });
    },
    actOnJob: (id: string, action: JobAction): Job | Promise<Job> => actions[action](id),
    changeJob: (id: string, change: JobChange): Promise<Job> =>
      queue.change(id, checked(jobChangeSchema, change)),
    movePlace: (id: string, by: MovePlace): Job => queue.movePlace(id, checked(movePlaceSchema, by)),
    moveJob: (id: string, beforeId: string | null): void => queue.move(id, beforeId),
    duplicateJob: (id: string): Job => queue.duplicate(id),
    removeJob: (id: string): Promise<void> => queue.remove(id),
    jobDrawing: (id: string): Promise<DrawingText> => drawings.read(queue.drawingOf(id)),
    setQueue: (plotterId: string, settings: QueueSettings): QueueSettings =>
      queue.saveSettings(checked(queueSettingsSchema, settings), plotterId),
    dismissNotice: (id: string): void => notices.remove(id),

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
    isRunning: (id: string): boolean => queue.isRunning(id),
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
      await plotter.move(wanted, settingsOf(settings));
      return plotter.snapshot();
    },
    command: (id: string, line: string) =>
      freePlotter(id).command(checked(commandRequestSchema, { line }).line),

    machines: () => machines.list(),
    saveMachine: (profile: MachineProfile): MachineProfile =>
      machines.save(checked(machineProfileSchema, profile)),
    removeMachine: (id: string): void => machines.remove(id),

    /** After this the host's worker stops being the host, and the calling page's worker becomes the host. */
    handOver: (): void => {
      if (queue.list().some(({ state }) => state === "plotting" || state === "paused")) {
        throw new PlotwrightError(
          "busy",
          "The other tab is plotting. Wait until the plot ends, or cancel it: that works from here, too.",
        );
      }
    },
  };
};

/** Methods that change nothing: all pages may call them. */
export const READING: readonly HostMethod[] = [
  "jobDrawing",
  "devices",
  "usbIds",
  "log",
  "machines",
  "handOver",
];
/** Actions that only stop a plot: all pages may call them. */
export const STOPPING: readonly JobAction[] = ["pause", "cancel", "emergency-stop"];

const plain = z.object({ kind: z.enum(["home", "set-home", "cycle-pen", "test-line", "test-patch"]) });
const handMoveSchema: z.ZodType<HandMove> = z.union([
  plain,
  walkRequestSchema.omit({ settings: true }).extend({ kind: z.literal("walk") }),
  jogRequestSchema.omit({ settings: true }).extend({ kind: z.literal("jog") }),
  squareRequestSchema.omit({ settings: true }).extend({ kind: z.literal("square") }),
  servoRequestSchema.omit({ settings: true }).extend({ kind: z.literal("servo") }),
  z.object({ kind: z.literal("frame"), boxMm: boxMmSchema }),
]);

function checked<T>(schema: z.ZodType<T>, value: unknown): T {
  const result = schema.safeParse(value);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${path === "" ? "The request" : path}: ${words}.`);
}
