import { useState } from "react";
import type { Job } from "../../src/schema/index.js";
import { mayOperate, maySubmit } from "../state/store.js";
import { useActions, useIsConnected, useOlderJobs, usePageState } from "../state/use-store.js";
import { queueText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { formatDuration, formatWhen } from "../ui/format.js";
import { RowMenu } from "../ui/rows/row-menu.js";
import { canGoOn, EndedButtons } from "./ended-buttons.js";
import { JobName, StateBadge } from "./job-head.js";
import { expectedSOf } from "./queue-time.js";
import { Thumb } from "../drawing/thumb.js";

const SHOWN_FIRST = 20;

/** Ended jobs, newest first. Each can be plotted again. */
export const HistoryList = ({ jobs }: { jobs: readonly Job[] }) => {
  const [shownCount, setShownCount] = useState(SHOWN_FIRST);
  const restCount = jobs.length - shownCount;
  const fetchOlder = useOlderJobs();
  const showMore = (): void => {
    if (restCount < SHOWN_FIRST) fetchOlder?.();
    setShownCount(shownCount + SHOWN_FIRST);
  };
  return (
    <>
      <ul className="job-list">
        {jobs.slice(0, shownCount).map((job) => (
          <li key={job.id}>
            <EndedJob job={job} />
          </li>
        ))}
      </ul>
      {(restCount > 0 || fetchOlder !== null) && (
        <Button kind="link" onClick={showMore}>
          {restCount >= SHOWN_FIRST || fetchOlder === null ? words.showMore(restCount) : words.showOlder}
        </Button>
      )}
    </>
  );
};

const EndedJob = ({ job }: { job: Job }) => {
  const { actOnJob, openJob, removeJob } = useActions();
  const isOperator = usePageState(mayOperate);
  const hasMenu = usePageState(maySubmit);
  const isOff = !useIsConnected();
  const { name } = job;
  const again = [words.again, words.againNamed(name), isOff, () => void actOnJob(job.id, "requeue")] as const;
  const open = [words.open, words.openNamed(name), false, () => void openJob(job)] as const;
  const remove = [words.remove, words.removeNamed(name), isOff, () => void removeJob(job.id)] as const;
  // What was plotted stays in the history of those who look after the plotter.
  const mayRemove = isOperator || job.startedAt === null;
  const items = [...(isOperator && canGoOn(job) ? [] : [again]), open, ...(mayRemove ? [remove] : [])];
  return (
    <article className="job" data-state={job.state}>
      <div className="job-row">
        <Thumb of="job" id={job.id} />
        <div className="job-words">
          <JobName job={job} />
          <span className="note">{timesOf(job)}</span>
        </div>
        <StateBadge job={job} />
        {hasMenu && <RowMenu label={words.more(name)} items={items} />}
      </div>
      {isOperator && canGoOn(job) && <EndedButtons job={job} />}
      {job.message && <p className={job.state === "failed" ? "note note-error" : "note"}>{job.message}</p>}
    </article>
  );
};

/** When it ended, its duration, and the expected duration. */
const timesOf = (job: Job): string => {
  const parts = job.endedAt === null ? [] : [formatWhen(job.endedAt)];
  parts.push(words.took(formatDuration(job.plottedS ?? job.elapsedS)));
  const expectedS = expectedSOf(job);
  if (job.state === "done" && expectedS !== null) parts.push(words.estimated(formatDuration(expectedS)));
  return parts.join(" · ");
};
