/** The operations of the library: drawings that the server keeps in folders. */
import type { RequestHandler } from "express";
import { pipeline } from "node:stream/promises";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { LibraryFiles } from "../storage/library-files.js";
import { fileName } from "./job-routes.js";
import { bytesOf, type Responders, type ServerHandlers } from "./operation-routes.js";

interface LibraryParts {
  readonly library: LibraryFiles;
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
}

export const libraryOperations = ({ library, queue, files }: LibraryParts) =>
  ({
    list: (wanted) => library.list(wanted),
    remove: (path) => library.remove(path),
    keep: (id, { folder = "", name = queue.get(id).name }) =>
      library.addFree(folder, fileName(name), files.path(queue.drawingOf(id))),
  }) satisfies ServerHandlers["library"];

export const libraryResponders = (parts: LibraryParts) =>
  ({ get: sendDrawing(parts), save: receiveDrawing(parts) }) satisfies Responders["library"];

/** Sent as a plain-text attachment: a browser must never run scripts of an SVG. */
const sendDrawing =
  ({ library }: LibraryParts): RequestHandler<Record<string, string>> =>
  async (request, response) => {
    const path = request.params["path"];
    const { file, bytes } = await library.open(path);
    try {
      response.attachment(path.slice(path.lastIndexOf("/") + 1));
      response.type("text/plain; charset=utf-8");
      response.set("Content-Length", String(bytes));
      // A file that grows meanwhile is not sent longer than announced.
      if (bytes > 0) await pipeline(file.createReadStream({ autoClose: false, end: bytes - 1 }), response);
      else response.end();
    } catch (error) {
      // The client has left, or the disk failed: nothing more can be answered.
      if (!response.headersSent) throw error;
      response.destroy();
    } finally {
      await file.close();
    }
  };

/** Received among the other drawings first, so that the library never has a part of a file. */
const receiveDrawing =
  ({ library, files }: LibraryParts): RequestHandler<Record<string, string>> =>
  async (request, response) => {
    const path = request.params["path"];
    await library.mustBeFree(path);
    const received = await files.addFile(bytesOf(request));
    try {
      response.status(201).json(await library.add(path, files.path(received.id)));
    } finally {
      await files.remove(received.id);
    }
  };
