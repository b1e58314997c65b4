/** The operations on the queue that several servers share. */
import { PlotwrightError } from "../../../src/index.js";
import type { ServerHandlers } from "../../http/operation-routes.js";
import { readDrawing } from "../../planning/read-drawing.js";
import type { DrawingFiles } from "../../storage/drawing-files.js";
import type { UploadedDrawings } from "../../../host/queue/uploaded-drawings.js";
import type { SharedQueue } from "./shared-queue.js";

/** The database keeps the whole drawing in one row. */
const MAX_DRAWING_BYTES = 50_000_000;

export const sharedJobOperations = (shared: SharedQueue, files: DrawingFiles, uploads: UploadedDrawings) => {
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
