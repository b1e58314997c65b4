/** The plug-in that shares jobs with other servers through PostgreSQL. */
import { randomUUID } from "node:crypto";
import { hostname } from "node:os";
import { claimsWithoutSharing, type PluginCore, type ServerPlugin } from "../server-plugin.js";
import type { Store } from "../../storage/store.js";
import { SharedQueue } from "./shared-queue.js";
import { SharedStore } from "./shared-store.js";
import { PlotwrightError } from "../../../src/index.js";
import type { ServerHandlers } from "../../http/operation-routes.js";
import { readDrawing } from "../../planning/read-drawing.js";
import type { DrawingFiles } from "../../storage/drawing-files.js";
import type { UploadedDrawings } from "../../../host/queue/uploaded-drawings.js";

export interface SharedQueueOptions {
  /** postgres://… */
  readonly url: string;
  readonly pollMs?: number | undefined;
  readonly lostAfterMs?: number | undefined;
  readonly timeoutMs?: number | undefined;
}

export function sharedQueuePlugin(options: SharedQueueOptions, { store, log }: PluginCore): ServerPlugin {
  const { url, pollMs, lostAfterMs, timeoutMs } = options;
  const unopened = claimsWithoutSharing(store);
  let shared: SharedQueue | null = null;
  return {
    name: "the shared queue",
    jobs: {
      afterChange: () => shared?.wake(),
      claims: {
        claim: (jobId) => (shared ?? unopened).claim(jobId),
        release: (jobId) => (shared ?? unopened).release(jobId),
      },
    },
    start: async ({ queue, files, uploads, plotters, notices }) => {
      const queueOfServers = new SharedQueue({
        shared: await SharedStore.open(url, log, timeoutMs),
        serverId: serverIdIn(store),
        serverName: hostname(),
        store,
        queue,
        files,
        plotters,
        log,
        notice: (message) => notices.add(message),
        pollMs,
        lostAfterMs,
      });
      shared = queueOfServers;
      return {
        operations: { sharedJobs: sharedJobOperations(queueOfServers, files, uploads) },
        close: () => queueOfServers.close(),
      };
    },
  };
}

/** Stays the same over restarts, so that the server finds the jobs it took before. */
function serverIdIn(store: Store): string {
  const stored = store.setting("server-id");
  if (typeof stored === "string") return stored;
  const id = randomUUID();
  store.saveSetting("server-id", id);
  return id;
}

/** The database keeps the whole drawing in one row. */
const MAX_DRAWING_BYTES = 50_000_000;

/** The operations on the queue that several servers share. */
const sharedJobOperations = (shared: SharedQueue, files: DrawingFiles, uploads: UploadedDrawings) => {
  /** The text of an uploaded drawing, which is then removed: the database has it. */
  const takeText = async (drawingId: string): Promise<string> => {
    const { id, bytes } = uploads.claim(drawingId);
    try {
      if (bytes <= MAX_DRAWING_BYTES) return readDrawing(files.path(id));
      throw new PlotwrightError(
        "too-large",
        `The file is larger than ${MAX_DRAWING_BYTES / 1e6} MB, the limit of the shared queue. Simplify the drawing, or add it to the server that has the plotter.`,
      );
    } finally {
      await files.remove(id);
    }
  };
  return {
    list: async () => ({ jobs: await shared.list() }),
    add: async ({ drawing, drawingId, ...job }) => {
      const text = drawingId === undefined ? (drawing ?? "") : await takeText(drawingId);
      return { id: await shared.send({ ...job, drawing: text }) };
    },
    giveBack: (id) => shared.giveBack(id),
    withdraw: (id) => shared.withdraw(id),
  } satisfies ServerHandlers["sharedJobs"];
};
