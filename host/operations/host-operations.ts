/** Performs operations, and has the handlers of those that every host has: the server, and the page without one. */
import { PlotwrightError } from "../../src/index.js";
import {
  type BoxMm,
  type FrameRequest,
  type HandMove,
  type HandMoveRequest,
  type Job,
  type OperationHandlers,
  type Plotter,
  handlerArguments,
  presetAsGiven,
  type Operation,
  type OperationInput,
} from "../../src/schema/index.js";
import type { CustomMachines } from "../custom-machines.js";
import type { Requester } from "../planning/lane.js";
import type { PlotterPort } from "../plotter/plotter-port.js";
import type { PlotterRegistry } from "../plotter/plotter-registry.js";
import { findFreePlotter, findPlotter } from "../queue/find-plotter.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { Notices } from "../queue/notices.js";
import type { UploadedDrawings } from "../queue/uploaded-drawings.js";
import type { StoredDrawing } from "../storage.js";
import { parseRequest, parseWith } from "../parse-with.js";

export interface HostParts {
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly notices: Notices;
  readonly machines: Pick<CustomMachines, "list" | "save" | "remove">;
  readonly uploads: UploadedDrawings;
  /** Stores the text of a drawing. */
  readonly storeText: (text: string) => Promise<StoredDrawing>;
  /** The box of a job's drawing as its settings place it on the machine. */
  readonly jobBoxMm: (jobId: string) => Promise<BoxMm>;
  readonly log: (line: string) => void;
}

export const hostOperations = (parts: HostParts) =>
  ({
    state: {
      history: (wanted, { submitter }) => parts.queue.older(wanted, submitter?.id),
      queue: () => parts.queue.settings(),
      setQueue: (settings) => parts.queue.saveSettings(settings),
    },
    jobs: jobOperations(parts),
    plotters: plotterOperations(parts),
    moves: moveOperations(parts),
    console: {
      command: (id, { line }) => findFreePlotter(parts.registry.ports, parts.queue, id).command(line),
    },
    machines: machineOperations(parts),
    operator: { dismissNotice: (id) => parts.notices.remove(id) },
  }) satisfies OperationHandlers<Requester>;

const jobOperations = ({ queue, uploads, storeText }: HostParts) =>
  ({
    add: async ({ drawing, drawingId, settings = {}, ...rest }, requester) => {
      const { submitter: submittedBy } = requester;
      const stored =
        drawingId === undefined
          ? await storeText(drawing ?? "")
          : uploads.claim(drawingId, submittedBy?.id ?? null);
      return queue.add({ ...rest, settings, drawing: stored, submittedBy }, requester);
    },
    get: (id) => queue.get(id),
    patch: (id, patch, requester) => queue.patch(id, patch, requester),
    move: (id, { beforeId }) => queue.move(id, beforeId),
    // Shortly after the host has started it is still looking for boards, so these two wait until it knows.
    start: async (id) => {
      await queue.plotterSettled(id);
      return queue.start(id);
    },
    recover: async (id) => {
      await queue.plotterSettled(id);
      return queue.plots.recover(id);
    },
    pause: (id) => queue.plots.pause(id),
    resume: (id) => queue.plots.resume(id),
    cancel: (id) => queue.plots.cancel(id),
    requeue: (id) => queue.requeue(id),
    "emergency-stop": (id) => queue.plots.emergencyStop(id),
    change: (id, change) => queue.change(id, change),
    place: (id, by) => queue.plots.movePlace(id, by),
    placeAfter: (id, by) => queue.plots.placeAfter(id, by),
    "check-place": (id) => queue.plots.checkPlace(id),
    pen: (id, { up }) => queue.plots.movePen(id, up),
    duplicate: (id) => queue.duplicate(id),
    remove: (id, { submitter }) => {
      if (submitter !== undefined) mustNotHaveBegun(queue.get(id));
      return queue.remove(id);
    },
  }) satisfies OperationHandlers<Requester>["jobs"];

/** What was plotted stays in the history, for whoever looks after the plotter. */
function mustNotHaveBegun({ name, startedAt }: Job): void {
  if (startedAt === null) return;
  throw new PlotwrightError(
    "conflict",
    `"${name}" has been plotted, at least in part. Only an operator removes it from the history.`,
  );
}

const plotterOperations = ({ queue, registry, log }: HostParts) => {
  const find = (id: string): PlotterPort => findPlotter(registry.ports, id);
  const findFree = (id: string): PlotterPort => findFreePlotter(registry.ports, queue, id);
  return {
    devices: async () => ({ devices: await registry.devices() }),
    ask: async () => ({ devices: await registry.askDevices() }),
    add: (wanted) => {
      const plotter = registry.add(wanted);
      log(`plotter "${plotter.name}" added`);
      return plotter;
    },
    get: (id) => find(id).snapshot(),
    patch: (id, patch) => registry.patch(id, patch, queue),
    remove: async (id) => {
      await registry.remove(id, queue);
      log(`plotter ${id} removed`);
    },
    queue: (id) => queue.settings(find(id).id),
    setQueue: (id, settings) => queue.saveSettings(settings, id),
    settings: (id) => registry.settings()[find(id).id] ?? null,
    defaults: (id) => {
      const plotterId = find(id).id;
      const { settings, hasMachine } = queue.settingsOf(plotterId);
      const presets = registry.settings()[plotterId]?.presets ?? [];
      return {
        settings,
        isModelSet: hasMachine,
        presets: presets.map((preset) => ({ name: preset.name, settings: presetAsGiven(settings, preset) })),
      };
    },
    saveSettings: (id, settings) => registry.saveSettings(id, settings),
    log: (id) => find(id).log(),
    pen: async (id, { up, heightPct, settings }) => {
      const plotter = findFree(id);
      await plotter.pen({ up, heightPct }, queue.handSettings(id, { settings }));
      return plotter.snapshot();
    },
    motorsOff: async (id) => {
      const plotter = findFree(id);
      await plotter.motorsOff();
      return plotter.snapshot();
    },
    stop: async (id) => {
      const plotter = findFree(id);
      await plotter.stopMove();
      return plotter.snapshot();
    },
  } satisfies OperationHandlers<Requester>["plotters"];
};

const moveOperations = ({ queue, registry, jobBoxMm }: HostParts) => {
  const perform = async (id: string, move: HandMove, how: HandMoveRequest): Promise<Plotter> => {
    const plotter = findFreePlotter(registry.ports, queue, id);
    await plotter.move(move, queue.handSettings(id, how));
    return plotter.snapshot();
  };
  /** The body of a move has its numbers and `how` side by side. */
  const handler =
    <Kind extends HandMove["kind"]>(kind: Kind) =>
    (id: string, { settings, profile, ...numbers }: HandMoveRequest & Numbers<Kind>): Promise<Plotter> =>
      perform(id, { kind, ...numbers } as unknown as HandMove, { settings, profile });
  return {
    home: handler("home"),
    "move-to": handler("move-to"),
    jog: handler("jog"),
    "set-home": handler("set-home"),
    "cycle-pen": handler("cycle-pen"),
    frame: async (id, { settings, profile, ...around }: FrameRequest) => {
      const boxMm = "boxMm" in around ? around.boxMm : await jobBoxMm(around.jobId);
      const given = settings ?? ("jobId" in around ? queue.get(around.jobId).settings : undefined);
      return perform(id, { kind: "frame", boxMm }, { settings: given, profile });
    },
    "test-line": handler("test-line"),
    "test-patch": handler("test-patch"),
    square: handler("square"),
    servo: handler("servo"),
  } satisfies OperationHandlers<Requester>["moves"];
};

type Numbers<Kind> = Omit<Extract<HandMove, { readonly kind: Kind }>, "kind">;

const machineOperations = ({ machines }: HostParts) =>
  ({
    list: () => ({ machines: machines.list() }),
    save: (id, machine) => {
      if (machine.id !== id) {
        throw new PlotwrightError(
          "bad-setting",
          `id: it is ${machine.id} in the profile, but ${id} in the path.`,
        );
      }
      return machines.save(machine);
    },
    remove: (id) => machines.remove(id),
  }) satisfies OperationHandlers<Requester>["machines"];

/** Checks what was sent, then calls the handler. Throws `bad-setting` that names the first invalid field. */
export async function performOperation(
  operation: Operation,
  handler: (...args: never[]) => unknown,
  { id, sent }: OperationInput,
  context: unknown,
): Promise<unknown> {
  const { method, body, query, isBodyOptional } = operation;
  const schema = query ?? (body === "file" ? undefined : body);
  const given = isBodyOptional === true ? (sent ?? {}) : sent;
  // What is put may be what was read, with all that it had.
  const parse = method === "put" ? parseWith : parseRequest;
  const checked = schema === undefined ? given : parse(schema, given);
  const args = [...handlerArguments(operation, { id, sent: checked }), context];
  const answer = await (handler as (...all: unknown[]) => unknown)(...args);
  return answer === undefined ? { ok: true } : answer;
}
