/** A client of a running server, made from the table of operations. */
import { InvalidArgumentError, Option, type Command } from "commander";
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { addressOfServer } from "../../storage/data-lock.js";
import { addData } from "../options.js";
import {
  apiErrorSchema,
  clientOf,
  jobSchema,
  listedMachineSchema,
  meSchema,
  OPERATIONS,
  plotterSettingsSchema,
  requestOf,
  type ClientOf,
  type Job,
  type NewJob,
  type Operation,
  type OperationInput,
} from "../../../src/schema/index.js";

export const DEFAULT_URL = "http://127.0.0.1:9080";

export const addServer = (command: Command): Command =>
  addData(command)
    .option(
      "--url <url>",
      `address of the server (default: the one that uses the data folder, or else ${DEFAULT_URL})`,
      serverUrl,
    )
    .addOption(new Option("--key <key>", "access key of a server on another computer").env("PLOTWRIGHT_KEY"));

function serverUrl(text: string): string {
  if (!/^https?:\/\//.test(text) || !URL.canParse(text)) {
    throw new InvalidArgumentError(`It must be an address such as ${DEFAULT_URL}.`);
  }
  return text;
}

/** Without an address: the server that uses the data folder, on whatever port. */
export function accessOf(options: Partial<ServerAccess> & { readonly data?: string }): ServerAccess {
  const { url = addressOfServer(options.data ?? defaultDataDir()) ?? DEFAULT_URL, key } = options;
  return { url, ...(key === undefined ? {} : { key }) };
}

export interface ServerAccess {
  readonly url: string;
  /** For a server on another computer; created on its page under Sharing, Access. */
  readonly key?: string;
}

/** Only the fields used here, so that servers of other versions work too. */
const stateSchema = z.object({
  plotters: z.array(
    z.object({
      id: z.string(),
      name: z.string(),
      machine: z.string().nullable(),
      device: z.string().nullable().catch(null),
      boardName: z.string().nullable().catch(null),
    }),
  ),
  jobs: z.array(jobSchema),
  plotterSettings: z.record(z.string(), plotterSettingsSchema).catch({}),
  machines: z.array(listedMachineSchema).catch([]),
});
export type ServerState = z.infer<typeof stateSchema>;
export type ServerPlotter = ServerState["plotters"][number];
export type ServerClient = ClientOf<typeof OPERATIONS>;

export const serverClient = (access: ServerAccess): ServerClient =>
  clientOf(OPERATIONS, (one, input) => send(access, one, input));

export async function serverState(options: ServerAccess): Promise<ServerState> {
  return (await send(options, { ...OPERATIONS.state.get, answer: stateSchema }, {})) as ServerState;
}

/** Uploads the drawing's file as it is, then adds the job. */
export async function addJob(
  options: ServerAccess,
  job: Omit<NewJob, "drawing" | "drawingId">,
  drawing: Buffer<ArrayBuffer>,
): Promise<Job> {
  const { drawings, jobs } = serverClient(options);
  const { id: drawingId } = await drawings.upload(new Uint8Array(drawing).buffer);
  return jobs.add({ ...job, drawingId });
}

async function send({ url, key }: ServerAccess, one: Operation, input: OperationInput): Promise<unknown> {
  const { path, headers, body, method } = requestOf(one, input);
  const response = await fetch(new URL(path, url), {
    method,
    headers: { ...headers, ...(key === undefined ? {} : { Authorization: `Bearer ${key}` }) },
    ...(body === undefined ? {} : { body }),
  }).catch((cause: unknown) => {
    throw new PlotwrightError("disconnected", noAnswer(url, cause), { cause });
  });
  const answer: unknown = await response.json().catch(() => null);
  const result = one.answer instanceof z.ZodType ? one.answer.safeParse(answer) : null;
  if (response.ok && result?.success === true) return result.data;
  const fault = apiErrorSchema.safeParse(answer);
  if (response.ok || !fault.success) {
    throw new PlotwrightError(
      "bad-setting",
      `${url} is not a plotwright server, or one of another version: its answer (status ${response.status}) has another form. Check --url.`,
    );
  }
  const { code, message } = fault.data.error;
  const hint =
    response.status === 403 && key === undefined
      ? " Or set the environment variable PLOTWRIGHT_KEY to an access key; make one on the server's page, under Sharing, Access."
      : "";
  throw new PlotwrightError(code, `The server at ${url} refused it: ${message}${hint}`);
}

/** `cause`: the error of fetch, whose own cause has a code. */
function noAnswer(url: string, cause: unknown): string {
  const code = String((cause as { cause?: { code?: unknown } }).cause?.code);
  if (code === "ERR_TLS_CERT_ALTNAME_INVALID") {
    const { hostname } = new URL(url);
    return `The certificate of ${url} is for another name. Give the address with that name in --url, or add ${hostname} to the certificate for the commands without --url.`;
  }
  if (/CERT|SIGNATURE/.test(code)) {
    return `The certificate of ${url} is not trusted (${code}). If it is your own, set the environment variable NODE_EXTRA_CA_CERTS to its file.`;
  }
  if (/SSL|SOCKET|EPROTO/.test(code)) {
    const other = url.startsWith("https:") ? url.replace("https:", "http:") : url.replace("http:", "https:");
    return `No plotwright server answers at ${url}. Does it answer at ${other}?`;
  }
  return `No plotwright server answers at ${url}. Start one with plotwright serve, or give its address with --url.`;
}

const PATIENCE_MS = 1_000;

/** The error for a plotter that could not be opened, with advice if a server on this computer may have it open. */
export async function serverHint(error: unknown): Promise<unknown> {
  if (!(error instanceof PlotwrightError) || !["no-board", "busy"].includes(error.code)) return error;
  const signal = AbortSignal.timeout(PATIENCE_MS);
  const answer: unknown = await fetch(new URL(requestOf(OPERATIONS.state.me, {}).path, DEFAULT_URL), {
    signal,
  })
    .then((response) => response.json())
    .catch(() => null);
  // It may require a key, and refuse this request.
  if (!meSchema.safeParse(answer).success && !apiErrorSchema.safeParse(answer).success) return error;
  return new PlotwrightError(
    error.code,
    `${error.message} A plotwright server runs at ${DEFAULT_URL} and may use the plotter: move it there, or put a drawing into its queue with plotwright add FILE.`,
    { cause: error },
  );
}
