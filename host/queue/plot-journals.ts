/** The stored journals of the plots: how far each has come. */
import type { z } from "zod";
import type { Job, JobPlace } from "../../src/schema/index.js";
import type { JournalEntry } from "../plotter/plotter-port.js";
import { journalProgressSchema, journalSchema } from "../plotter/resume-position.js";
import type { JobStore } from "../storage.js";
import type { JobList } from "./job-list.js";
import { jobPlace } from "./job-states.js";

export class PlotJournals {
  constructor(
    private readonly store: JobStore,
    private readonly jobs: JobList,
  ) {}

  of(id: string): z.infer<typeof journalSchema> | null {
    return journalSchema.safeParse(this.store.journal(id)).data ?? null;
  }

  progressOf(id: string): z.infer<typeof journalProgressSchema> | undefined {
    return journalProgressSchema.safeParse(this.store.journal(id)).data;
  }

  /** The place in the journal. Without a journal nothing has been drawn since the job's own place. */
  reachedPlace(id: string): JobPlace | null {
    const entry = this.of(id);
    return entry ? jobPlace(entry.place) : this.jobs.get(id).place;
  }

  /** Stores the progress with the place. Otherwise it would be only in memory and lost when the server is killed. */
  save(id: string, entry: Pick<JournalEntry, "place" | "received" | "run">): void {
    const { progress, elapsedS, remainingS } = this.jobs.get(id);
    this.store.saveJournal(id, { ...entry, progress, elapsedS, remainingS });
  }

  /**
   * A job that was cancelled, or that starts in the middle, has no journal until it draws. Its place is stored here:
   * otherwise it would start at the beginning after a crash, a cancel or a failure while the rest is being planned.
   */
  keepPlace({ id, place }: Pick<Job, "id" | "place">): void {
    if (place === null || this.of(id) !== null) return;
    this.save(id, { place: { stroke: place.strokeIndex, alongMm: place.alongMm } });
  }
}
