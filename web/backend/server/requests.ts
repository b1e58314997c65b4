/** Requests to plotwright's server, made from the table of operations, and their errors. */
import { apiErrorSchema, requestOf, type Operation, type OperationInput } from "../../../src/schema/index.js";
import { contentOf } from "../../worker/drawing-text.js";
import { BackendFault } from "../backend.js";
import { serverText } from "./text.js";

export type Fetch = (path: string, init?: RequestInit) => Promise<Response>;

/** Sends one operation, and returns its answer. Rejects with a BackendFault. */
export const sendOperation = async (
  fetchPath: Fetch,
  one: Operation,
  input: OperationInput,
): Promise<unknown> => {
  const { path, body, ...init } = requestOf(one, input);
  let response: Response;
  try {
    response = await fetchPath(path, {
      ...init,
      ...(body === undefined ? {} : { body: one.body === "file" ? new Blob([body]) : body }),
    });
  } catch {
    throw new BackendFault("unreachable", serverText.unreachable);
  }
  if (!response.ok) throw await faultOf(response);
  if (one.answer === "file") return contentOf(await response.arrayBuffer());
  if (one.answer === "text" || one.answer === "events") return response.text();
  return one.answer.parse(await response.json());
};

const faultOf = async (response: Response): Promise<BackendFault> => {
  const parsed = apiErrorSchema.safeParse(await response.json().catch(() => null));
  if (parsed.success) return new BackendFault(parsed.data.error.code, parsed.data.error.message);
  // A proxy between page and server answers without a body.
  const isGone = response.status === 502 || response.status === 503 || response.status === 504;
  return new BackendFault("internal", isGone ? serverText.unreachable : serverText.server(response.status));
};
