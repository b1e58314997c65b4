/** How far a drawing has been plotted. The page shows the rest pale. */
import type { Trajectory } from "../../src/index.js";
import { PositionTimes } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { ACTIVE_STATES, type PageState } from "../state/store.js";

/** Created once for each plan, because it is used several times for each change of the page's state. */
const timesOf = new WeakMap<Trajectory, PositionTimes>();

/** The time in the plan, s; null if its job has not begun or has ended, so that the whole drawing is shown. */
export const drawnUntilS = ({ jobs, drawing, planned, live }: PageState): number | null => {
  const job = jobs.find(({ id }) => id === drawing?.jobId);
  if (!job || !planned || !ACTIVE_STATES.includes(job.state)) return null;
  return jobUntilS(job, planned.trajectory, live);
};

/** The time in its plan that a job has reached, s; null: it is done. */
export const jobUntilS = (job: Job, trajectory: Trajectory, live: PageState["live"]): number | null => {
  if (job.state === "done") return null;
  if (job.place) {
    const times = timesOf.get(trajectory) ?? new PositionTimes(trajectory);
    timesOf.set(trajectory, times);
    const atS = times.timeOf({ stroke: job.place.strokeIndex, alongMm: job.place.alongMm });
    // A plot that lost its board still has the place where it began or was resumed.
    if (atS !== null) {
      return job.state === "interrupted" ? Math.max(atS, job.progress * trajectory.totalS) : atS;
    }
  }
  // It is moving, or the page has not received a report since it was opened.
  return live?.jobId === job.id ? live.planS : job.progress * trajectory.totalS;
};
