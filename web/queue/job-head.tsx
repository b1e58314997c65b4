import type { Job } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";
import { queueText } from "./text.js";
import "./jobs.css";

const words = queueText;

/** A job's name, which lays it on the paper, and its state. */
export const JobHead = ({ job }: { job: Job }) => {
  const { openJob } = useActions();
  return (
    <header className="job-head">
      <button
        type="button"
        className="job-name"
        title={words.openNamed(job.name)}
        onClick={() => void openJob(job)}
      >
        {job.name}
      </button>
      <span className="badge" data-state={job.state}>
        {job.wait !== null && job.state === "paused" ? words.waitsForPen : words.states[job.state]}
      </span>
    </header>
  );
};

/** How much of a job is done. */
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
