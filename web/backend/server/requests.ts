/** Requests to plotwright's server, and their errors. */
import { z } from "zod";
import { apiErrorSchema } from "../../../src/schema/index.js";
import type { DrawingText } from "../../worker/drawing-text.js";
import { BackendFault } from "../backend.js";
import { serverText } from "./text.js";

export const API = "/api/v1";

export type Fetch = (path: string, init?: RequestInit) => Promise<Response>;
export type Requests = ReturnType<typeof createRequests>;

/** The server's answer without data. */
const okSchema = z.object({ ok: z.literal(true) });
const uploadSchema = z.object({ id: z.string() });

export const createRequests = (fetchPath: Fetch) => {
  /** A blob is sent unchanged, any other body as JSON. */
  const send = async (method: string, path: string, body?: unknown): Promise<Response> => {
    const init: RequestInit = { method };
    if (body instanceof Blob) init.body = body;
    else if (body !== undefined) {
      init.body = JSON.stringify(body);
      init.headers = { "content-type": "application/json" };
    }
    let response: Response;
    try {
      response = await fetchPath(`${API}${path}`, init);
    } catch {
      throw new BackendFault("unreachable", serverText.unreachable);
    }
    if (!response.ok) throw await faultOf(response);
    return response;
  };
  const ask = async <T>(schema: z.ZodType<T>, method: string, path: string, body?: unknown): Promise<T> =>
    schema.parse(await (await send(method, path, body)).json());
  /** For routes that answer without data. */
  const command = async (method: string, path: string, body?: unknown): Promise<void> => {
    await ask(okSchema, method, path, body);
  };
  /** For routes that take a job with a drawing: uploads the drawing as a file first. */
  const askWithDrawing = async <T>(
    schema: z.ZodType<T>,
    path: string,
    job: { readonly name: string },
    drawing: DrawingText,
  ): Promise<T> => {
    const { id: drawingId } = await ask(uploadSchema, "POST", "/drawings", new Blob([drawing]));
    return ask(schema, "POST", path, { ...job, drawingId });
  };
  return { send, ask, command, askWithDrawing, fetchPath };
};

/** The path of one item: `/jobs/ID`. */
export const pathOf = (what: string, id: string): string => `/${what}/${encodeURIComponent(id)}`;

const faultOf = async (response: Response): Promise<BackendFault> => {
  const parsed = apiErrorSchema.safeParse(await response.json().catch(() => null));
  if (parsed.success) return new BackendFault(parsed.data.error.code, parsed.data.error.message);
  // A proxy between page and server answers without a body.
  const isGone = response.status === 502 || response.status === 503 || response.status === 504;
  return new BackendFault("internal", isGone ? serverText.unreachable : serverText.server(response.status));
};
