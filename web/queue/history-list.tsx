import { useState } from "react";
import type { Job } from "../../src/schema/index.js";
import { mayOperate } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { queueText } from "./text.js";
import { formatDuration, formatWhen } from "../ui/format.js";
import { IconButton } from "../ui/icon-button.js";
import { JobHead } from "./job-head.js";
import { Thumb } from "../drawing/thumb.js";

const words = queueText;
const SHOWN_FIRST = 20;

/** What has been plotted, newest first, each to be had again. */
export const HistoryList = ({ jobs }: { jobs: readonly Job[] }) => {
  const [shownCount, setShownCount] = useState(SHOWN_FIRST);
  const restCount = jobs.length - shownCount;
  return (
    <>
      <ul className="job-list">
        {jobs.slice(0, shownCount).map((job) => (
          <li key={job.id}>
            <EndedJob job={job} />
          </li>
        ))}
      </ul>
      {restCount > 0 && (
        <button type="button" className="link" onClick={() => setShownCount(shownCount + SHOWN_FIRST)}>
          {words.more(restCount)}
        </button>
      )}
    </>
  );
};

const EndedJob = ({ job }: { job: Job }) => {
  const { actOnJob, removeJob } = useActions();
  const isMine = usePageState(mayOperate);
  return (
    <article className="job job-with-thumb" data-state={job.state}>
      <Thumb of="job" id={job.id} />
      <JobHead job={job} />
      <p className="job-line">
        <span>{timesOf(job)}</span>
        <span className="spacer" />
        {isMine && (
          <>
            <IconButton
              icon="again"
              label={words.againNamed(job.name)}
              onClick={() => void actOnJob(job.id, "requeue")}
            />
            <IconButton
              icon="close"
              label={queueText.removeNamed(job.name)}
              onClick={() => void removeJob(job.id)}
            />
          </>
        )}
      </p>
      {job.message && <p className={job.state === "failed" ? "note note-error" : "note"}>{job.message}</p>}
    </article>
  );
};

/** When it ended, how long it took, and what had been foretold. */
const timesOf = (job: Job): string => {
  const parts = job.endedAt === null ? [] : [formatWhen(job.endedAt)];
  parts.push(words.took(formatDuration(job.plottedS ?? job.elapsedS)));
  const expectedS = job.expectedS ?? job.stats?.durationS ?? null;
  if (job.state === "done" && expectedS !== null) parts.push(words.foretold(formatDuration(expectedS)));
  return parts.join(" · ");
};
