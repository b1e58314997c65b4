/** Adds the job of a request, from JSON or from the drawing's file as the body. */
import type { Request, Response } from "express";
import { basename } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import {
  givenSettingsSchema,
  nameSchema,
  newJobSchema,
  type GivenSettings,
  type Job,
} from "../../src/schema/index.js";
import type { Requester } from "../../host/planning/lane.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { UploadedDrawings } from "../storage/uploaded-drawings.js";
import { bytesOf } from "./drawing-routes.js";
import { parseWith } from "../../host/parse-with.js";

export interface JobParts {
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly uploads: UploadedDrawings;
}

export function addJob(parts: JobParts, request: Request, requester: Requester): Promise<Job> {
  return request.is("json") === false
    ? addFromFile(parts, request, requester)
    : addFromJson(parts, request, requester);
}

async function addFromJson(
  { queue, files, uploads }: JobParts,
  request: Request,
  requester: Requester,
): Promise<Job> {
  const { drawing, drawingId, settings = {}, ...rest } = parseWith(newJobSchema, request.body);
  const stored =
    drawingId === undefined
      ? await files.add([Buffer.from(drawing ?? "", "utf8")])
      : uploads.claim(drawingId);
  return queue.add({ ...rest, settings, drawing: stored }, requester);
}

/** The body is the file: `curl --data-binary @x.svg '…/jobs?name=x.svg'`. */
async function addFromFile({ queue, files }: JobParts, request: Request, requester: Requester): Promise<Job> {
  const { name, settings, plotterId } = request.query;
  const wanted = {
    name: nameIn(name),
    settings: settingsIn(settings),
    ...(typeof plotterId === "string" ? { plotterId } : {}),
  };
  const drawing = await files.addFile(bytesOf(request));
  return queue.add({ ...wanted, drawing }, requester);
}

function nameIn(query: unknown): string {
  if (typeof query !== "string") return "drawing.svg";
  return parseWith(z.object({ name: nameSchema(200) }), { name: basename(query.trim()).slice(0, 200) }).name;
}

function settingsIn(query: unknown): GivenSettings {
  if (query === undefined) return {};
  try {
    return parseWith(givenSettingsSchema, JSON.parse(String(query)));
  } catch (cause) {
    if (!(cause instanceof SyntaxError)) throw cause;
    throw new PlotwrightError("bad-setting", "settings: not valid JSON.", { cause });
  }
}

/** Identifies the client; planning is aborted when it disconnects before the answer. */
export function requesterOf(request: Request, response: Response): Requester {
  const disconnected = new AbortController();
  response.on("close", () => {
    if (!response.writableFinished) disconnected.abort();
  });
  return { client: request.socket.remoteAddress, signal: disconnected.signal };
}
