/** REST calls to plotwright's server. Every failure is an ApiFault whose message can be shown. */
import { z } from "zod";
import {
  apiErrorSchema,
  jobSchema,
  machineListSchema,
  meSchema,
  operatorSchema,
  plotterSchema,
  queueSettingsSchema,
  type Job,
  type JobChange,
  type JobPatch,
  type Me,
  type MovePlace,
  type NewJob,
  type PenRequest,
  type PlotSettings,
  type Plotter,
  type QueueSettings,
} from "../../src/schema/index.js";
import { encodingOf, textOfBytes } from "../../src/internal.js";
import { text } from "../text/text.js";
import type { DrawingText } from "../worker/protocol.js";

/** Files as large as this are kept as they were read: only the worker makes text of them. */
export const LARGE_BYTES = 1_000_000;

/** Text; the bytes of a large file as they are, if they are UTF-8: decoding them would hold up the page. */
export const contentOf = (buffer: ArrayBuffer): DrawingText => {
  const bytes = new Uint8Array(buffer);
  return bytes.length >= LARGE_BYTES && encodingOf(bytes) === "utf-8" ? buffer : textOfBytes(bytes);
};

export class ApiFault extends Error {
  override readonly name = "ApiFault";
  readonly code: string;

  constructor(code: string, message: string) {
    super(message);
    this.code = code;
  }
}

const samplesSchema = z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) });
const uploadSchema = z.object({ id: z.string() });
const operatorAnswerSchema = z.object({ operator: operatorSchema.nullable() });
/** What the server answers where there is nothing to say. */
export const okSchema = z.object({ ok: z.literal(true) });

export type JobAction =
  "start" | "pause" | "resume" | "cancel" | "requeue" | "emergency-stop" | "recover" | "check-place";
type Fetch = (path: string, init?: RequestInit) => Promise<Response>;

export type ApiClient = ReturnType<typeof createApiClient>;

export const createApiClient = (fetchPath: Fetch = (path, init) => fetch(path, init)) => {
  const send = async (method: string, path: string, body?: unknown): Promise<Response> => {
    const init: RequestInit = { method };
    if (body instanceof Blob) init.body = body;
    else if (body !== undefined) {
      init.body = JSON.stringify(body);
      init.headers = { "content-type": "application/json" };
    }
    let response: Response;
    try {
      response = await fetchPath(`/api/v1${path}`, init);
    } catch {
      throw new ApiFault("unreachable", text.errors.unreachable);
    }
    if (!response.ok) throw await faultOf(response);
    return response;
  };
  const ask = async <T>(schema: z.ZodType<T>, method: string, path: string, body?: unknown): Promise<T> =>
    schema.parse(await (await send(method, path, body)).json());
  const job = (id: string): string => `/jobs/${encodeURIComponent(id)}`;
  const plotter = (id: string): string => `/plotters/${encodeURIComponent(id)}`;

  return {
    /** For the parts that are loaded later, which bring their own list of routes. */
    ask,
    /** Sends a drawing as it is; a new job names it by the id. */
    uploadDrawing: async (drawing: DrawingText): Promise<string> =>
      (await ask(uploadSchema, "POST", "/drawings", new Blob([drawing]))).id,
    addJob: (newJob: NewJob): Promise<Job> => ask(jobSchema, "POST", "/jobs", newJob),
    patchJob: (id: string, patch: JobPatch): Promise<Job> => ask(jobSchema, "PATCH", job(id), patch),
    actOnJob: (id: string, action: JobAction): Promise<Job> => ask(jobSchema, "POST", `${job(id)}/${action}`),
    changeJob: (id: string, change: JobChange): Promise<Job> =>
      ask(jobSchema, "POST", `${job(id)}/change`, change),
    movePlace: (id: string, way: MovePlace): Promise<Job> => ask(jobSchema, "POST", `${job(id)}/place`, way),
    moveJob: (id: string, beforeId: string | null) => ask(okSchema, "POST", `${job(id)}/move`, { beforeId }),
    duplicateJob: (id: string): Promise<Job> => ask(jobSchema, "POST", `${job(id)}/duplicate`),
    setQueue: (plotterId: string, settings: QueueSettings): Promise<QueueSettings> =>
      ask(queueSettingsSchema, "PATCH", `${plotter(plotterId)}/queue`, settings),
    me: (): Promise<Me> => ask(meSchema, "GET", "/me"),
    takeOver: () => ask(operatorAnswerSchema, "POST", "/operator/take"),
    dismissNotice: (id: string) => ask(okSchema, "DELETE", `/notices/${encodeURIComponent(id)}`),
    removeJob: (id: string) => ask(okSchema, "DELETE", job(id)),
    jobDrawing: async (id: string): Promise<DrawingText> => {
      return contentOf(await (await send("GET", `${job(id)}/drawing`)).arrayBuffer());
    },
    setPlotterMachine: (id: string, machine: string): Promise<Plotter> =>
      ask(plotterSchema, "PATCH", plotter(id), { machine }),
    movePen: (id: string, request: PenRequest): Promise<Plotter> =>
      ask(plotterSchema, "POST", `${plotter(id)}/pen`, request),
    motorsOff: (id: string): Promise<Plotter> => ask(plotterSchema, "POST", `${plotter(id)}/motors-off`),
    home: (id: string, settings: PlotSettings): Promise<Plotter> =>
      ask(plotterSchema, "POST", `${plotter(id)}/home`, { settings }),
    machines: async () => (await ask(machineListSchema, "GET", "/machines")).machines,
    samples: async () => (await ask(samplesSchema, "GET", "/samples")).samples,
    sample: async (name: string): Promise<string> =>
      (await send("GET", `/samples/${encodeURIComponent(name)}`)).text(),
  };
};

const faultOf = async (response: Response): Promise<ApiFault> => {
  const parsed = apiErrorSchema.safeParse(await response.json().catch(() => null));
  if (parsed.success) return new ApiFault(parsed.data.error.code, parsed.data.error.message);
  // What stands between page and server (a development proxy, a sleeping machine) answers without a body.
  const isGone = response.status === 502 || response.status === 503 || response.status === 504;
  return new ApiFault("internal", isGone ? text.errors.unreachable : text.errors.server(response.status));
};
