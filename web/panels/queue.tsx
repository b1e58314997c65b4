import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import { ACTIVE_STATES, activeJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatDuration } from "../ui/format.js";
import { Segments } from "../ui/choice.js";
import { Icon, type IconName } from "../ui/icon.js";
import { ActiveJob } from "./active-job.js";
import { JobHead } from "./job-head.js";
import { NotifyButton } from "./notify-button.js";

const words = text.queue;
const SHOWN_HISTORY = 20;

export const QueuePanel = () => {
  const jobs = usePageState((state) => state.jobs);
  const open = jobs.filter((job) => !ENDED_STATES.includes(job.state));
  const totalS = open.reduce((sum, job) => sum + (job.remainingS ?? job.stats?.durationS ?? 0), 0);
  const waiting = open.filter((job) => job.state === "queued");
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">
        {words.title}
        {open.length > 1 && <span className="note">{words.total(formatDuration(totalS))}</span>}
      </h2>
      {open.length === 0 && <p className="note">{words.empty}</p>}
      <ul className="job-list">
        {open.map((job) => (
          <li key={job.id}>
            {ACTIVE_STATES.includes(job.state) ? (
              <ActiveJob job={job} />
            ) : (
              <WaitingJob job={job} queue={waiting} />
            )}
          </li>
        ))}
      </ul>
      <BetweenJobs />
      <NotifyButton />
    </section>
  );
};

/** Whether the queue stops for somebody to change the paper. */
const BetweenJobs = () => {
  const queue = usePageState((state) => state.queue);
  const { setQueue } = useActions();
  if (!queue) return null;
  return (
    <Segments
      label={words.between}
      value={queue.runOn ? "run" : "wait"}
      options={[
        { value: "wait", label: words.wait },
        { value: "run", label: words.runOn },
      ]}
      onChange={(value) => void setQueue({ runOn: value === "run" })}
    />
  );
};

const WaitingJob = ({ job, queue }: { job: Job; queue: readonly Job[] }) => {
  const { actOnJob, duplicateJob, moveJob, removeJob } = useActions();
  const isFree = usePageState((state) => activeJob(state) === null);
  const index = queue.indexOf(job);
  const before = (place: number): string | null => queue[place]?.id ?? null;
  return (
    <article className="job" data-state={job.state}>
      <JobHead job={job} />
      <p className="job-line">
        <span>{job.stats ? words.about(formatDuration(job.stats.durationS)) : words.planning}</span>
      </p>
      {job.message && <p className="note">{job.message}</p>}
      <div className="button-row">
        <button
          type="button"
          className="button button-small"
          aria-label={words.startNamed(job.name)}
          disabled={!isFree}
          onClick={() => void actOnJob(job.id, "start")}
        >
          <Icon name="play" />
          {words.start}
        </button>
        <span className="spacer" />
        <IconButton
          icon="up"
          label={words.earlier(job.name)}
          isOff={index <= 0}
          onClick={() => void moveJob(job.id, before(index - 1))}
        />
        <IconButton
          icon="down"
          label={words.later(job.name)}
          isOff={index >= queue.length - 1}
          onClick={() => void moveJob(job.id, before(index + 2))}
        />
        <IconButton icon="copy" label={words.duplicate(job.name)} onClick={() => void duplicateJob(job.id)} />
        <IconButton icon="close" label={words.removeNamed(job.name)} onClick={() => void removeJob(job.id)} />
      </div>
    </article>
  );
};

export const HistoryPanel = () => {
  const jobs = usePageState((state) => state.jobs).filter((job) => ENDED_STATES.includes(job.state));
  const { actOnJob, removeJob } = useActions();
  return (
    <section className="card" aria-label={words.history}>
      <h2 className="card-title">{words.history}</h2>
      {jobs.length === 0 && <p className="note">{words.historyEmpty}</p>}
      <ul className="job-list">
        {jobs.slice(0, SHOWN_HISTORY).map((job) => (
          <li key={job.id}>
            <article className="job" data-state={job.state}>
              <JobHead job={job} />
              <p className="job-line">
                <span>{words.took(formatDuration(job.elapsedS))}</span>
                <span className="spacer" />
                <IconButton
                  icon="again"
                  label={words.againNamed(job.name)}
                  onClick={() => void actOnJob(job.id, "requeue")}
                />
                <IconButton
                  icon="close"
                  label={words.removeNamed(job.name)}
                  onClick={() => void removeJob(job.id)}
                />
              </p>
              {job.message && (
                <p className={job.state === "failed" ? "note note-error" : "note"}>{job.message}</p>
              )}
            </article>
          </li>
        ))}
      </ul>
    </section>
  );
};

interface IconButtonProps {
  readonly icon: IconName;
  readonly label: string;
  readonly isOff?: boolean;
  onClick(): void;
}

const IconButton = ({ icon, label, isOff, onClick }: IconButtonProps) => (
  <button
    type="button"
    className="button button-icon button-small"
    aria-label={label}
    title={label}
    disabled={isOff}
    onClick={onClick}
  >
    <Icon name={icon} />
  </button>
);
