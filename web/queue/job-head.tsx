import type { Job } from "../../src/schema/index.js";
import { ACTIVE_STATES, maySubmit, penWait } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { queueText as words } from "./text.js";
import "./jobs.css";

/**
 * A job's name as a button: opens Watch for a running job, and the drawing for another one. Watchers can't open
 * drawings, so for them the latter is plain text.
 */
export const JobName = ({ job }: { job: Job }) => {
  const { openJob, showView } = useActions();
  const mayOpen = usePageState(maySubmit);
  const isActive = ACTIVE_STATES.includes(job.state);
  if (!mayOpen && !isActive) return <span className="job-name">{job.name}</span>;
  return (
    <button
      type="button"
      className="job-name"
      title={isActive ? words.watchNamed(job.name) : words.openNamed(job.name)}
      onClick={() => (isActive ? showView("watch") : void openJob(job))}
    >
      {job.name}
    </button>
  );
};

/** As the style sheets name it: an emergency stop does not look like a pause. */
export const stateOf = ({ state, stopped }: Job): string => (stopped ? "stopped" : state);

export const StateBadge = ({ job }: { job: Job }) => (
  <span className="badge" data-state={stateOf(job)}>
    {job.stopped ? words.stopped : penWait(job) !== null ? words.waitsForPen : words.states[job.state]}
  </span>
);

/** The progress bar of a job. */
export const Progress = ({ job }: { job: Job }) => (
  <div
    className="progress"
    role="progressbar"
    aria-label={words.progress(job.name)}
    aria-valuemin={0}
    aria-valuemax={100}
    aria-valuenow={Math.floor(job.progress * 100 + 1e-9)}
  >
    <span style={{ width: `${Math.min(1, job.progress) * 100}%` }} />
  </div>
);
