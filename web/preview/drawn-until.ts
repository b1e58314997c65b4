/** How far the drawing on the paper has been plotted, as far as it is known: on the page what follows is shown pale. */
import type { Trajectory } from "../../src/index.js";
import { PlaceTimes } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { ACTIVE_STATES, type PageState } from "../state/store.js";

/** Made once for each plan: this is asked several times for each change of the page's state. */
const timesOf = new WeakMap<Trajectory, PlaceTimes>();

/** The moment of the plan, s; null when its job has not begun or has ended, and the whole drawing is to be shown. */
export const drawnUntilS = ({ jobs, drawing, planned, live }: PageState): number | null => {
  const job = jobs.find(({ id }) => id === drawing?.jobId);
  if (!job || !planned || !ACTIVE_STATES.includes(job.state)) return null;
  return jobUntilS(job, planned.trajectory, live);
};

/** The moment of its plan that a job has reached, s; null when it is done. */
export const jobUntilS = (job: Job, trajectory: Trajectory, live: PageState["live"]): number | null => {
  if (job.state === "done") return null;
  if (job.place) {
    const times = timesOf.get(trajectory) ?? new PlaceTimes(trajectory);
    timesOf.set(trajectory, times);
    const atS = times.timeOf({ stroke: job.place.strokeIndex, alongMm: job.place.alongMm });
    if (atS !== null) return atS;
  }
  // It is moving; or nothing has been heard of it since the page was opened.
  return live?.jobId === job.id ? live.planS : job.progress * trajectory.totalS;
};
