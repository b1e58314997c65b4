import { useRef, useState } from "react";
import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import { rowsOf } from "./copies.js";
import { queueTime } from "./queue-time.js";
import { ACTIVE_STATES, currentPlotter, mayOperate } from "../state/store.js";
import {
  useActions,
  useIsConnected,
  useOlderJobs,
  usePageState,
  usePlotterJobs,
} from "../state/use-store.js";
import { queueText as words, notifyText } from "./text.js";
import { Segments } from "../ui/fields/choice.js";
import { formatClockIn, formatDuration, formatWhen } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { useNow } from "../ui/use-now.js";
import { Button } from "../ui/button.js";

const RunningJob = lazyPart(async () => (await import("./running-job.js")).RunningJob);
const WaitingJob = lazyPart(async () => (await import("./waiting-job.js")).WaitingJob);
const HistoryList = lazyPart(async () => (await import("./history-list.js")).HistoryList);

export const QueuePanel = () => {
  const all = usePlotterJobs();
  const jobs = all.filter((job) => !ENDED_STATES.includes(job.state));
  const list = useRef<HTMLUListElement>(null);
  const active = jobs.filter((job) => ACTIVE_STATES.includes(job.state));
  const rows = rowsOf(jobs.filter((job) => job.state === "queued"));
  const rowIds = rows.map(([{ id }]) => id);
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">
        {words.title}
        {jobs.length > 0 && <Totals jobs={jobs} />}
      </h2>
      {jobs.length === 0 && <Empty ended={all} />}
      <ul className="job-list" ref={list}>
        {active.map((job) => (
          <li key={job.id}>
            <RunningJob job={job} />
          </li>
        ))}
        {rows.map((copies) => (
          <li key={copies[0].id} data-row={copies[0].id}>
            <WaitingJob copies={copies} rowIds={rowIds} list={list} />
          </li>
        ))}
      </ul>
      <BetweenJobs />
      <NotifyButton />
    </section>
  );
};

/** Shown for an empty queue. Names the last plot too, because the history may not be visible. */
const Empty = ({ ended }: { ended: readonly Job[] }) => {
  const last = ended.reduce<Job | null>(
    (latest, job) => ((job.endedAt ?? "") > (latest?.endedAt ?? "") ? job : latest),
    null,
  );
  const when = last?.endedAt && formatWhen(last.endedAt);
  return (
    <p className="note">
      {words.empty} {last && when && words.last(last.name, words.states[last.state], when)}
    </p>
  );
};

/** The number of jobs, their time, and when they will be done, if that is known. */
const Totals = ({ jobs }: { jobs: readonly Job[] }) => {
  const nowMs = useNow();
  const plotterId = usePageState((state) => currentPlotter(state)?.id ?? "");
  const runsOn = usePageState((state) => state.queues[plotterId]?.runOn ?? false);
  const isConnected = useIsConnected();
  const { totalS, isRunning } = queueTime(jobs, runsOn);
  const total = words.total(jobs.length, formatDuration(totalS));
  return (
    <span className="note">
      {isRunning && isConnected ? words.totalDoneAt(total, formatClockIn(nowMs, totalS)) : total}
    </span>
  );
};

/** Sets whether the queue waits for new paper between plots. */
const BetweenJobs = () => {
  const plotterId = usePageState((state) => currentPlotter(state)?.id ?? "");
  const queue = usePageState((state) => state.queues[plotterId]);
  const isMine = usePageState(mayOperate);
  const { setQueue } = useActions();
  if (!queue || !isMine) return null;
  return (
    <Segments
      label={words.between}
      isInline
      value={queue.runOn ? "run" : "wait"}
      options={[
        { value: "wait", label: words.wait },
        { value: "run", label: words.runOn },
      ]}
      onChange={(value) => void setQueue({ runOn: value === "run" })}
    />
  );
};

export const HistoryPanel = () => {
  const jobs = usePlotterJobs().filter((job) => ENDED_STATES.includes(job.state));
  const isEmpty = useOlderJobs() === null && jobs.length === 0;
  return (
    <section className="card" aria-label={words.history}>
      <h2 className="card-title">{words.history}</h2>
      {isEmpty ? <p className="note">{words.historyEmpty}</p> : <HistoryList jobs={jobs} />}
    </section>
  );
};

/** Asks for permission to show notifications. Hidden if the browser does not support notifications. */
const NotifyButton = () => {
  const { notify } = useActions();
  const [permission, setPermission] = useState(() => window.Notification?.permission ?? "denied");
  if (!window.Notification || !window.isSecureContext) return null;
  if (permission === "granted") return <p className="note">{notifyText.asked}</p>;
  const ask = async (): Promise<void> => {
    const answer = await Notification.requestPermission();
    setPermission(answer);
    if (answer === "denied") notify("error", notifyText.denied);
  };
  return (
    <Button kind="link" className="notify-link" onClick={() => void ask()}>
      {notifyText.ask}
    </Button>
  );
};
