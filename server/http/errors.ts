/** Answers every error as `{ error: { code, message } }` with its status in ERROR_TABLE. */
import type { ErrorRequestHandler, RequestHandler } from "express";
import { PlotwrightError, type ErrorCode } from "../../src/index.js";
import { ERROR_TABLE } from "../../src/internal.js";
import { isDiskFault } from "../../host/disk-fault.js";
import type { Refusals } from "./refusals.js";

/** Longer paths are cut in the log. */
const MAX_PATH = 200;

export const notFound: RequestHandler = ({ method, baseUrl, path }) => {
  throw new PlotwrightError("not-found", `There is nothing at ${method} ${baseUrl}${path}.`);
};

export function errorResponder(log: (line: string) => void, refusals: Refusals): ErrorRequestHandler {
  return (error: unknown, request, response, next) => {
    // The client disconnected during its request: there is no one to answer.
    if (request.destroyed && !request.complete) return;
    const { code, message, status } = describe(error);
    if (code === "internal" || code === "disk-full")
      log(`${request.method} ${request.path.slice(0, MAX_PATH)}: ${detail(error)}`);
    if (code === "too-large") refusals.note(request, message);
    if (response.headersSent) {
      next(error);
      return;
    }
    // Read and discard the rest of a refused upload: clients read the answer only after sending everything.
    request.resume();
    response.status(status).json({ error: { code, message } });
  };
}

function describe(error: unknown): { code: ErrorCode; message: string; status: number } {
  if (error instanceof PlotwrightError) {
    return { code: error.code, message: error.message, status: ERROR_TABLE[error.code].httpStatus };
  }
  if (isDiskFault(error)) {
    const message = "The server's disk is full or can't be written to. Make room, then try again.";
    return { code: "disk-full", message, status: ERROR_TABLE["disk-full"].httpStatus };
  }
  // Errors of express and its body parser have a status and a type such as "entity.parse.failed".
  const { status, type } = error as { status?: unknown; type?: unknown };
  if (status === 413) {
    const message =
      "The JSON of the request is larger than this server accepts. Send a large drawing as a file with POST /api/v1/drawings, then add the job with its drawingId.";
    return { code: "too-large", message, status };
  }
  if (typeof status === "number" && status >= 400 && status < 500) {
    const message =
      type === "entity.parse.failed" ? "The request is not valid JSON." : "The request is not understood.";
    return { code: "bad-setting", message, status };
  }
  return {
    code: "internal",
    message: "An internal error occurred. The server's log has the details.",
    status: 500,
  };
}

const detail = (error: unknown): string =>
  error instanceof Error ? (error.stack ?? error.message) : String(error);
