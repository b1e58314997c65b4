/** Drawings that were uploaded for a job that is not added yet. A drawing that no job claims in time is removed. */
import { PlotwrightError } from "../../src/index.js";
import type { DrawingStore, StoredDrawing } from "../storage.js";

const KEEP_MS = 10 * 60_000;

/** Unclaimed drawings of one device or key that may only submit jobs; beyond that, its oldest one is removed. */
const MAX_OF_SUBMITTER = 3;

interface Upload {
  readonly drawing: StoredDrawing;
  /** Who may claim it; null: an operator. */
  readonly submitterId: string | null;
  readonly timer: ReturnType<typeof setTimeout>;
}

export class UploadedDrawings {
  private readonly keepMs: number;
  private readonly uploads = new Map<string, Upload>();

  constructor(
    private readonly files: DrawingStore,
    private readonly log: (line: string) => void,
    keepMs = KEEP_MS,
  ) {
    this.keepMs = keepMs;
  }

  /** Keeps a stored drawing until it is claimed. */
  keep(drawing: StoredDrawing, submitterId: string | null = null): void {
    const timer = setTimeout(() => void this.remove(drawing.id), this.keepMs);
    this.uploads.set(drawing.id, { drawing, submitterId, timer });
    if (submitterId === null) return;
    const own = [...this.uploads].filter(([, upload]) => upload.submitterId === submitterId);
    for (const [id] of own.slice(0, -MAX_OF_SUBMITTER)) void this.remove(id);
  }

  /**
   * Hands the drawing over to the caller, who has to remove it if it is not used. Throws `not-found`, also for a drawing
   * of another submitter.
   */
  claim(id: string, submitterId: string | null = null): StoredDrawing {
    const upload = this.uploads.get(id);
    if (upload === undefined || (submitterId !== null && upload.submitterId !== submitterId)) {
      throw new PlotwrightError(
        "not-found",
        "There is no uploaded drawing with this drawingId. An upload serves one job and is kept for ten minutes: send the file again.",
      );
    }
    clearTimeout(upload.timer);
    this.uploads.delete(id);
    return upload.drawing;
  }

  /** Removes all drawings that were not claimed. */
  async close(): Promise<void> {
    await Promise.all([...this.uploads.keys()].map((id) => this.remove(id)));
  }

  private async remove(id: string): Promise<void> {
    try {
      await this.files.remove(this.claim(id).id);
    } catch (error) {
      this.log(`an uploaded drawing could not be removed: ${(error as Error).message}`);
    }
  }
}
