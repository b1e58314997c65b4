import { useRef, useState } from "react";
import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import { rowsOf } from "./copies.js";
import { queueAxis, type AxisRow, type QueueAxis, type QueueBreak } from "./queue-time.js";
import { ACTIVE_STATES, activeJob, currentPlotter, mayOperate, onlySubmits } from "../state/store.js";
import { useActions, useIsConnected, usePageState, usePlotterJobs } from "../state/use-store.js";
import { axisText } from "./axis-text.js";
import { queueText as words, notifyText } from "./text.js";
import { Segments } from "../ui/fields/choice.js";
import { formatClockIn, formatDuration, formatWhen } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { lazyPart } from "../ui/lazy-part.js";
import { useNow } from "../ui/use-now.js";
import { Button } from "../ui/button.js";
import "./axis.css";

const RunningJob = lazyPart(async () => (await import("./running-job.js")).RunningJob);
const WaitingJob = lazyPart(async () => (await import("./waiting-job.js")).WaitingJob);

/** The plots of a plotter along an axis of time: when each starts and ends, and where a person must act. */
export const QueuePanel = () => {
  const all = usePlotterJobs();
  const jobs = all.filter((job) => !ENDED_STATES.includes(job.state));
  const list = useRef<HTMLUListElement>(null);
  const plotterId = usePageState((state) => currentPlotter(state)?.id ?? "");
  const runsOn = usePageState((state) => state.queues[plotterId]?.runOn ?? false);
  const seesAll = !usePageState(onlySubmits);
  const active = jobs.filter((job) => ACTIVE_STATES.includes(job.state));
  const axis = queueAxis(active, rowsOf(jobs.filter((job) => job.state === "queued")), { runsOn, seesAll });
  const rowIds = axis.rows.map(({ copies }) => copies[0].id);
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">
        {words.title}
        {jobs.length > 0 && <Total count={jobs.length} axis={axis} />}
      </h2>
      {jobs.length === 0 && <Empty ended={all} />}
      <StartQueue axis={axis} isActive={active.length > 0} />
      <ul className="job-list axis" ref={list}>
        {active.map((job) => (
          <li key={job.id} className="axis-row" data-now>
            <RunningJob job={job} />
          </li>
        ))}
        {axis.rows.map((row) => (
          <li key={row.copies[0].id} className="axis-row" data-row={row.copies[0].id}>
            <Breaks row={row} />
            <WaitingJob row={row} rowIds={rowIds} list={list} />
          </li>
        ))}
      </ul>
      {jobs.length > 0 && <End axis={axis} isMoving={active.some(({ state }) => state === "plotting")} />}
      <BetweenJobs />
      <NotifyButton />
    </section>
  );
};

const Total = ({ count, axis }: { count: number; axis: QueueAxis }) => (
  <span className="note">
    {axis.isTotalKnown
      ? words.total(count, formatDuration(axis.totalS))
      : words.totalAtLeast(count, formatDuration(axis.totalS))}
  </span>
);

/** Starts the first plot; the others follow by themselves, or after new paper. */
const StartQueue = ({ axis, isActive }: { axis: QueueAxis; isActive: boolean }) => {
  const { actOnJob } = useActions();
  const isOperator = usePageState(mayOperate);
  const isFree = usePageState((state) => activeJob(state) === null);
  const isOff = !useIsConnected();
  const [first] = axis.rows;
  if (first === undefined || !isOperator || !isFree) return null;
  const [job] = first.copies;
  return (
    <div className="axis-start">
      <Button
        kind="primary"
        disabled={isOff}
        aria-label={words.startNamed(job.name)}
        onClick={() => void actOnJob(job.id, "start")}
      >
        <Icon name="play" />
        {words.start}
      </Button>
      {!isActive && axis.endS !== null && <span className="note">{axisText.ifNow}</span>}
    </div>
  );
};

/** What a person has to do before a row. */
const Breaks = ({ row }: { row: AxisRow }) => (
  <>
    {row.breaks.map((one) => (
      <p key={one.kind} className="axis-break">
        <BreakIcon one={one} />
        {one.kind === "paper" && axisText.paper}
        {one.kind === "place" && axisText.place}
        {one.kind === "pen" && (one.isStop ? axisText.pen(one.name) : axisText.penUnasked(one.name))}
      </p>
    ))}
  </>
);

const BreakIcon = ({ one }: { one: QueueBreak }) =>
  one.kind === "pen" ? (
    <span className="swatch" style={{ background: one.color ?? "transparent" }} />
  ) : (
    <Icon name={one.kind === "paper" ? "paper" : "pause"} />
  );

/** The end of the axis. */
const End = ({ axis, isMoving }: { axis: QueueAxis; isMoving: boolean }) => {
  const nowMs = useNow();
  const isConnected = useIsConnected();
  const { endS, isEndSure } = axis;
  const isKnown = isConnected && endS !== null && (isMoving || axis.rows.length > 0);
  if (!isKnown) return <p className="axis-end note">{axisText.endUnknown}</p>;
  const clock = formatClockIn(nowMs, endS);
  return <p className="axis-end">{isEndSure ? axisText.end(clock) : axisText.endAtEarliest(clock)}</p>;
};

/** Shown for an empty queue. Names the last plot too, because the gallery may not be visible. */
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
