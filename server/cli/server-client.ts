/** A client for a running server's HTTP interface (docs/api.md). */
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { jobSchema, type Job, type NewJob } from "../../src/schema/index.js";

export const DEFAULT_URL = "http://127.0.0.1:9080";

export interface ServerOptions {
  readonly url: string;
  /** For a server on another computer; created there under "Share". */
  readonly key?: string;
}

/** Only the fields used here, so that servers of other versions work too. */
const stateSchema = z.object({
  plotters: z.array(z.object({ id: z.string(), name: z.string(), machine: z.string().nullable() })),
  jobs: z.array(jobSchema),
});
export type ServerState = z.infer<typeof stateSchema>;

const uploadSchema = z.object({ id: z.string() });
const faultSchema = z.object({ error: z.object({ message: z.string() }) });

export async function serverState(options: ServerOptions): Promise<ServerState> {
  return stateSchema.parse(await ask(options, "state"));
}

/** Uploads the drawing's file as it is, then adds the job. */
export async function addJob(
  options: ServerOptions,
  job: Omit<NewJob, "drawing" | "drawingId">,
  drawing: Buffer<ArrayBuffer>,
): Promise<Job> {
  const upload = await ask(options, "drawings", { method: "POST", body: drawing });
  const { id: drawingId } = uploadSchema.parse(upload);
  const body = JSON.stringify({ ...job, drawingId } satisfies NewJob);
  const headers = { "Content-Type": "application/json" };
  return jobSchema.parse(await ask(options, "jobs", { method: "POST", body, headers }));
}

async function ask({ url, key }: ServerOptions, path: string, init: RequestInit = {}): Promise<unknown> {
  const headers = { ...init.headers, ...(key === undefined ? {} : { Authorization: `Bearer ${key}` }) };
  let response: Response;
  try {
    response = await fetch(new URL(`/api/v1/${path}`, url), { ...init, headers });
  } catch (cause) {
    throw new PlotwrightError(
      "disconnected",
      `No plotwright server answers at ${url}. Start one with plotwright serve, or give its address with --url.`,
      { cause },
    );
  }
  const answer: unknown = await response.json().catch(() => null);
  if (response.ok) return answer;
  const fault = faultSchema.safeParse(answer);
  const why = fault.success ? fault.data.error.message : `it answered ${response.status}`;
  throw new PlotwrightError(
    response.status === 422 ? "bad-file" : response.status === 403 ? "not-allowed" : "bad-setting",
    `The server at ${url} refused it: ${why}`,
  );
}

const PATIENCE_MS = 1_000;

/** The error for a plotter that could not be opened, with advice if a server on this computer uses it. */
export async function serverHint(error: unknown): Promise<unknown> {
  if (!(error instanceof PlotwrightError) || !["no-board", "busy"].includes(error.code)) return error;
  const isThere = await fetch(new URL("/api/v1/me", DEFAULT_URL), {
    signal: AbortSignal.timeout(PATIENCE_MS),
  }).then(
    (response) => response.ok,
    () => false,
  );
  if (!isThere) return error;
  return new PlotwrightError(
    error.code,
    `${error.message} A plotwright server runs at ${DEFAULT_URL}, which may use the plotter: plotwright add FILE puts a drawing into its queue.`,
    { cause: error },
  );
}
