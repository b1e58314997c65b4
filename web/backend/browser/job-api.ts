/** The methods of the host for jobs and the queue. */
import { PlotwrightError } from "../../../src/index.js";
import {
  jobChangeSchema,
  jobPatchSchema,
  movePlaceSchema,
  newJobSchema,
  queueSettingsSchema,
  type HistoryRequest,
  type Job,
  type JobChange,
  type JobPage,
  type JobPatch,
  type MovePlace,
  type NewJob,
  type QueueSettings,
} from "../../../src/schema/index.js";
import { jobActions } from "../../../host/queue/job-actions.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import type { DrawingText } from "../../worker/drawing-text.js";
import type { JobAction } from "../backend.js";
import { parseWith } from "../../../host/parse-with.js";

export interface JobApiParts {
  readonly queue: JobQueue;
  readonly drawings: {
    /** Resolves with the drawing's id when it is stored. */
    add(drawing: DrawingText): Promise<string>;
    read(id: string): Promise<DrawingText>;
  };
}

/** The size of text is only estimated by its length, because it is not encoded. */
const sizeOf = (drawing: DrawingText): number =>
  typeof drawing === "string" ? drawing.length : drawing.byteLength;

export const jobApi = ({ queue, drawings }: JobApiParts) => {
  const actions: Readonly<Record<JobAction, (id: string) => Job | Promise<Job>>> = jobActions(queue);
  return {
    addJob: async (job: Omit<NewJob, "drawing" | "drawingId">, drawing: DrawingText): Promise<Job> => {
      if (sizeOf(drawing) === 0) throw new PlotwrightError("bad-file", "The file is empty.");
      // The schema requires a drawing or its id. Here the drawing is a separate argument.
      const wanted = parseWith(newJobSchema, { ...job, drawingId: "sent" });
      const { copies, settings = {}, name, plotterId, from } = wanted;
      const id = await drawings.add(drawing);
      return queue.add({
        name,
        plotterId,
        from,
        copies,
        settings,
        drawing: { id, bytes: sizeOf(drawing) },
      });
    },
    patchJob: (id: string, patch: JobPatch): Promise<Job> =>
      queue.patch(id, parseWith(jobPatchSchema, patch)),
    actOnJob: (id: string, action: JobAction): Job | Promise<Job> => actions[action](id),
    changeJob: (id: string, change: JobChange): Promise<Job> =>
      queue.change(id, parseWith(jobChangeSchema, change)),
    movePlace: (id: string, by: MovePlace): Job => queue.movePlace(id, parseWith(movePlaceSchema, by)),
    moveJob: (id: string, beforeId: string | null): void => queue.move(id, beforeId),
    duplicateJob: (id: string): Job => queue.duplicate(id),
    removeJob: (id: string): Promise<void> => queue.remove(id),
    olderJobs: (wanted: HistoryRequest): JobPage => queue.older(wanted),
    isRunning: (id: string): boolean => queue.isRunning(id),
    jobDrawing: (id: string): Promise<DrawingText> => drawings.read(queue.drawingOf(id)),
    setQueue: (plotterId: string, settings: QueueSettings): QueueSettings =>
      queue.saveSettings(parseWith(queueSettingsSchema, settings), plotterId),
  };
};
