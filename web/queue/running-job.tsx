import { isLiveJob, type Job } from "../../src/schema/index.js";
import { penWait, shownView } from "../state/store.js";
import { useIsConnected, usePageState } from "../state/use-store.js";
import { jobText, queueText } from "./text.js";
import { formatClockIn, formatDuration, formatPercent } from "../ui/format.js";
import { useNow } from "../ui/use-now.js";
import { Thumb } from "../drawing/thumb.js";
import { HoldCard } from "./hold-card.js";
import { JobButtons } from "./job-buttons.js";
import { JobName, Progress, StateBadge, stateOf } from "./job-head.js";
import { stopsLeft } from "./queue-time.js";

/**
 * The job that has the plotter, first in the queue. In Watch its buttons are on the status card, and while it waits for a
 * pen they are over the paper.
 */
export const RunningJob = ({ job }: { job: Job }) => {
  const isWatched = usePageState((state) => shownView(state) === "watch");
  const hasButtons = !isWatched && penWait(job) === null;
  return (
    <article className="job job-active" data-state={stateOf(job)}>
      <div className="job-row">
        {/* The picture of a drawing that still grows is not the one of the whole. */}
        <Thumb of="job" id={job.id} changedAt={isLiveJob(job) ? "growing" : ""} />
        <JobName job={job} />
        <StateBadge job={job} />
      </div>
      <Progress job={job} />
      <TimeLeft job={job} />
      {!isWatched && <HoldCard job={job} />}
      {hasButtons && <JobButtons job={job} />}
    </article>
  );
};

/** A plot that waits for pens may end later. */
const doneWords = (job: Job) => (stopsLeft(job) > 0 ? jobText.doneAtEarliest : jobText.doneAt);

const TimeLeft = ({ job }: { job: Job }) => {
  const nowMs = useNow();
  const isConnected = useIsConnected();
  const share = formatPercent(job.progress);
  if (!isConnected) return <p className="job-line">{queueText.lastSeen(share)}</p>;
  return (
    <p className="job-line">
      <span className="job-share">{share}</span>
      {job.remainingS !== null && (
        <span>
          {jobText.left(formatDuration(job.remainingS))}
          {job.state === "plotting" && `, ${doneWords(job)(formatClockIn(nowMs, job.remainingS))}`}
        </span>
      )}
    </p>
  );
};
