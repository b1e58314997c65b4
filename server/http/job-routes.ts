/** The operations on jobs that need more of HTTP: adding a job from a file, and its drawing. */
import type { Request, RequestHandler } from "express";
import { basename } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { isDrawingName } from "../../src/internal.js";
import {
  API_PATH,
  cleanName,
  fileFieldsSchema,
  givenSettingsSchema,
  nameSchema,
  type FileFields,
  type GivenSettings,
} from "../../src/schema/index.js";
import { mustKnow, parseWith } from "../../host/parse-with.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import { readForm } from "./form.js";
import { bytesOf, requesterOf, type Responders } from "./operation-routes.js";

interface JobParts {
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
}

export const jobResponders = (parts: JobParts) =>
  ({ add: addFromFile(parts), drawing: sendDrawing(parts) }) satisfies Responders["jobs"];

/**
 * The body is the file: `curl --data-binary @x.svg '…/jobs?name=x.svg'`; or a form with the file and the same fields:
 * `curl -F drawing=@x.svg …/jobs`. JSON is left to the operation.
 */
const addFromFile =
  ({ queue, files }: JobParts): RequestHandler<Record<string, string>> =>
  async (request, response, next) => {
    if (request.is("json") !== false) {
      next();
      return;
    }
    const wanted =
      request.is("multipart/*") === false ? await fromBody(request, files) : await fromForm(request, files);
    const requester = requesterOf(request, response);
    const job = await queue.add({ ...wanted, submittedBy: requester.submitter }, requester);
    response.status(201).location(`${API_PATH}/jobs/${job.id}`).json(job);
  };

const FIELDS = fileFieldsSchema.keyof().options;

async function fromBody(request: Request<Record<string, string>>, files: DrawingFiles) {
  mustKnow(FIELDS, request.query);
  const wanted = wantedIn(request.query);
  return { ...wanted, drawing: await files.addFile(bytesOf(request)) };
}

async function fromForm(request: Request<Record<string, string>>, files: DrawingFiles) {
  const { drawing, fileName, fields } = await readForm(request, files, FIELDS);
  // What browsers call a file without a name.
  const name = fileName === "blob" || fileName === "" ? undefined : fileName;
  try {
    return { ...wantedIn({ name, ...fields }), drawing };
  } catch (error) {
    await files.remove(drawing.id);
    throw error;
  }
}

function wantedIn({ name, settings, plotterId }: Readonly<Partial<Record<keyof FileFields, unknown>>>) {
  return {
    name: nameIn(name),
    settings: settingsIn(settings),
    ...(typeof plotterId === "string" ? { plotterId } : {}),
  };
}

function nameIn(given: unknown): string {
  if (typeof given !== "string") return "drawing.svg";
  return parseWith(z.object({ name: nameSchema(200) }), { name: basename(given.trim()).slice(0, 200) }).name;
}

export function settingsIn(given: unknown): GivenSettings {
  if (given === undefined) return {};
  try {
    return parseWith(givenSettingsSchema, JSON.parse(String(given)));
  } catch (cause) {
    if (!(cause instanceof SyntaxError)) throw cause;
    throw new PlotwrightError("bad-setting", "settings: not valid JSON.", { cause });
  }
}

/** Sent as a plain-text attachment: a browser must never run scripts of an uploaded SVG. */
const sendDrawing =
  ({ queue, files }: JobParts): RequestHandler<Record<string, string>> =>
  (request, response, next) => {
    const id = request.params["id"];
    response.attachment(fileName(queue.get(id).name));
    response.type("text/plain; charset=utf-8");
    response.sendFile(files.path(queue.drawingOf(id)), { dotfiles: "allow" }, (error) => {
      if (error !== undefined && error !== null) next(error);
    });
  };

/** A file name that is valid on every system. */
export function fileName(name: string): string {
  const safe = cleanName(name).replace(/[<>:"/\\|?*\x00-\x1f]/g, "_");
  return isDrawingName(safe) ? safe : `${safe}.svg`;
}
