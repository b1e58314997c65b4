/** Requests to a running server, for programs: the client of the table of operations, and its event stream. */
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import {
  API_PATH,
  apiErrorSchema,
  clientOf,
  OPERATIONS,
  parseServerEvent,
  requestOf,
  type ClientOf,
  type Operation,
  type OperationInput,
  type ServerEvent,
} from "../../src/schema/index.js";

export interface ServerAccess {
  readonly url: string;
  /** For a server on another computer; created on its page under Sharing, Access. */
  readonly key?: string;
}

export type ServerClient = ClientOf<typeof OPERATIONS>;

export const serverClient = (access: ServerAccess): ServerClient =>
  clientOf(OPERATIONS, (one, input) => sendTo(access, one, input));

/** Sends one operation, and returns its answer. Throws the server's own error, or `disconnected` without an answer. */
export async function sendTo(access: ServerAccess, one: Operation, input: OperationInput): Promise<unknown> {
  const { url } = access;
  const { path, headers, body, method } = requestOf(one, input);
  const response = await fetch(new URL(path, url), {
    method,
    headers: { ...headers, ...keyHeader(access) },
    ...(body === undefined ? {} : { body }),
  }).catch((cause: unknown) => {
    throw new PlotwrightError("disconnected", noAnswer(url, cause), { cause });
  });
  const answer: unknown = await response.json().catch(() => null);
  const result = one.answer instanceof z.ZodType ? one.answer.safeParse(answer) : null;
  if (response.ok && result?.success === true) return result.data;
  throw faultOf(access, response.ok, response.status, answer);
}

/**
 * Follows the server's events until `signal` is aborted; a lost stream is opened again. Each stream begins with a
 * snapshot. `onLost` gets the error of each attempt that ends.
 */
export async function followEvents(
  access: ServerAccess,
  onEvent: (event: ServerEvent) => void,
  onLost: (error: Error) => void,
  signal: AbortSignal,
): Promise<void> {
  while (!signal.aborted) {
    try {
      await readEvents(access, onEvent, signal);
      onLost(new PlotwrightError("disconnected", `The server at ${access.url} has ended the connection.`));
    } catch (error) {
      if (signal.aborted) return;
      onLost(error instanceof Error ? error : new Error(String(error)));
    }
    await pause(RETRY_MS, signal);
  }
}

const RETRY_MS = 1_000;
/** The server sends something every 15 s: a longer silence means that it, or the network, is gone. */
const SILENCE_MS = 45_000;

/** Ends early when `signal` is aborted, so that the timer does not keep the process. */
function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const done = (): void => {
      clearTimeout(timer);
      signal.removeEventListener("abort", done);
      resolve();
    };
    const timer = setTimeout(done, ms);
    signal.addEventListener("abort", done);
  });
}

async function readEvents(
  access: ServerAccess,
  onEvent: (event: ServerEvent) => void,
  signal: AbortSignal,
): Promise<void> {
  const { url } = access;
  const response = await fetch(new URL(API_PATH + OPERATIONS.state.events.path, url), {
    headers: keyHeader(access),
    signal,
  }).catch((cause: unknown) => {
    throw new PlotwrightError("disconnected", noAnswer(url, cause), { cause });
  });
  if (!response.ok || response.body === null) {
    throw faultOf(access, response.ok, response.status, await response.json().catch(() => null));
  }
  const reader = response.body.getReader();
  const decoder = new TextDecoder();
  let rest = "";
  for (;;) {
    const silence = setTimeout(() => void reader.cancel(), SILENCE_MS);
    const { value, done } = await reader
      .read()
      .catch((cause: unknown) => {
        throw new PlotwrightError("disconnected", `The connection to the server at ${url} was lost.`, {
          cause,
        });
      })
      .finally(() => clearTimeout(silence));
    if (done) return;
    // Each event is one line that begins with "data:", and an empty line.
    const lines = (rest + decoder.decode(value, { stream: true })).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) {
      const event = line.startsWith("data:") ? parseServerEvent(line.slice(5)) : null;
      if (event) onEvent(event);
    }
  }
}

const keyHeader = ({ key }: ServerAccess): Record<string, string> =>
  key === undefined ? {} : { Authorization: `Bearer ${key}` };

function faultOf(
  { url, key }: ServerAccess,
  isOk: boolean,
  status: number,
  answer: unknown,
): PlotwrightError {
  const fault = apiErrorSchema.safeParse(answer);
  if (isOk || !fault.success) {
    return new PlotwrightError(
      "bad-setting",
      `${url} is not a plotwright server, or one of another version: its answer (status ${status}) has another form. Check the address.`,
    );
  }
  const { code, message } = fault.data.error;
  const hint =
    status === 403 && key === undefined
      ? " Or give an access key; make one on the server's page, under Sharing, Access. On the command line it is PLOTWRIGHT_KEY in the environment."
      : "";
  return new PlotwrightError(code, `The server at ${url} refused it: ${message}${hint}`);
}

/** `cause`: the error of fetch, whose own cause has a code on Node. */
function noAnswer(url: string, cause: unknown): string {
  const code = String((cause as { cause?: { code?: unknown } }).cause?.code);
  if (code === "ERR_TLS_CERT_ALTNAME_INVALID") {
    const { hostname } = new URL(url);
    return `The certificate of ${url} is for another name. Give the address with that name, or add ${hostname} to the certificate for programs without an address.`;
  }
  if (/CERT|SIGNATURE/.test(code)) {
    return `The certificate of ${url} is not trusted (${code}). If it is your own, set the environment variable NODE_EXTRA_CA_CERTS to its file.`;
  }
  if (/SSL|SOCKET|EPROTO/.test(code)) {
    const other = url.startsWith("https:") ? url.replace("https:", "http:") : url.replace("http:", "https:");
    return `No plotwright server answers at ${url}. Does it answer at ${other}?`;
  }
  return `No plotwright server answers at ${url}. Start one with plotwright serve, or check the address.`;
}
