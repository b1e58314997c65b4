/** Where the commands find a running server, and what they ask it. */
import { InvalidArgumentError, Option, type Command } from "commander";
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { defaultDataDir } from "../../storage/data-dir.js";
import { addressOfServer } from "../../storage/data-lock.js";
import { addData } from "../options.js";
import { sendTo, serverClient, type ServerAccess } from "../../../host/handle/server-client.js";
import {
  apiErrorSchema,
  jobSchema,
  listedMachineSchema,
  meSchema,
  OPERATIONS,
  plotterSettingsSchema,
  requestOf,
  type Job,
  type NewJob,
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
export async function serverState(options: ServerAccess): Promise<ServerState> {
  return (await sendTo(options, { ...OPERATIONS.state.get, answer: stateSchema }, {})) as ServerState;
}

/** A server reads drawings itself, and has only its own letters. */
export const fontUnknownTo = (url: string): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `--font: the server at ${url} reads the drawing itself, without your font. Make lines of the text first, with plotwright plan FILE --font FONT --svg LINES.svg, and give it LINES.svg; or convert text to paths in your drawing program.`,
  );

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
