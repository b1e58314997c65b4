import { useState } from "react";
import type { Job } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { Select } from "../ui/choice.js";
import { formatClockIn, formatCount, formatDuration, formatNumber, formatPercent } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { useNow } from "../ui/use-now.js";
import { JobHead, Progress } from "./job-head.js";

const words = text.queue;
const STEP_MM = 10;
const SPEED_PERCENTS: readonly number[] = [25, 50, 75, 90, 100, 110, 125, 150, 200];

/** The job that has the plotter: how far it is, and what can be done with it in its state. */
export const ActiveJob = ({ job }: { job: Job }) => (
  <article className="job job-active" data-state={job.state}>
    <JobHead job={job} />
    <Progress job={job} />
    <TimeLeft job={job} />
    {job.message && <p className="note">{job.message}</p>}
    {job.state === "interrupted" && <p className="note">{words.recoverHint}</p>}
    <MainButtons job={job} />
    {job.state === "paused" && job.place && <PlaceControls job={job} place={job.place} />}
    {job.state !== "interrupted" && <LiveChanges job={job} />}
  </article>
);

const TimeLeft = ({ job }: { job: Job }) => {
  const nowMs = useNow();
  return (
    <p className="job-line">
      <span className="big-figure">{formatPercent(job.progress)}</span>
      {job.remainingS !== null && (
        <span>
          {words.left(formatDuration(job.remainingS))}
          {job.state === "plotting" && `, ${words.doneAt(formatClockIn(nowMs, job.remainingS))}`}
        </span>
      )}
    </p>
  );
};

/** Cancel asks once more: hours of ink may be on the paper. */
const MainButtons = ({ job }: { job: Job }) => {
  const { actOnJob } = useActions();
  const busy = usePageState((state) => state.busyAction);
  const [isAsking, setAsking] = useState(false);
  if (isAsking) {
    return (
      <div className="ask" role="alertdialog" aria-label={words.cancel}>
        <p>{words.confirmCancel(job.name)}</p>
        <div className="button-row">
          <button
            type="button"
            className="button button-danger"
            onClick={() => void actOnJob(job.id, "cancel")}
          >
            {words.cancel}
          </button>
          <button type="button" className="button" onClick={() => setAsking(false)}>
            {words.keepPlotting}
          </button>
        </div>
      </div>
    );
  }
  const [action, label] = MAIN_ACTION[job.state] ?? MAIN_ACTION.plotting;
  return (
    <div className="button-row">
      <button
        type="button"
        className={job.state === "plotting" ? "button" : "button button-primary"}
        disabled={busy === `${action} ${job.id}`}
        onClick={() => void actOnJob(job.id, action)}
      >
        <Icon name={action === "pause" ? "pause" : "play"} />
        {label}
      </button>
      <button type="button" className="button" onClick={() => setAsking(true)}>
        {words.cancel}
      </button>
      {job.state === "plotting" && (
        <button
          type="button"
          className="button button-danger"
          title={words.stopNowHint}
          onClick={() => void actOnJob(job.id, "emergency-stop")}
        >
          {words.stopNow}
        </button>
      )}
    </div>
  );
};

const MAIN_ACTION = {
  plotting: ["pause", words.pause],
  paused: ["resume", words.resume],
  interrupted: ["recover", words.recover],
  queued: null,
  done: null,
  failed: null,
  cancelled: null,
} as const;

/** Where a held plot goes on: it can be moved back and on, and looked at with the pen up. */
const PlaceControls = ({ job, place }: { job: Job; place: NonNullable<Job["place"]> }) => {
  const { movePlace, actOnJob } = useActions();
  const moves = [
    [words.strokeBack, { strokes: -1 }],
    [words.strokeOn, { strokes: 1 }],
    [words.mmBack, { mm: -STEP_MM }],
    [words.mmOn, { mm: STEP_MM }],
  ] as const;
  return (
    <div className="place" role="group" aria-label={words.placeMoves}>
      <p className="note">
        {words.place(formatCount(place.strokeIndex + 1), formatNumber(place.alongMm, 1))}
      </p>
      <div className="button-grid">
        {moves.map(([label, way]) => (
          <button
            key={label}
            type="button"
            className="button button-small"
            onClick={() => void movePlace(job.id, way)}
          >
            {label}
          </button>
        ))}
      </div>
      <button
        type="button"
        className="button button-small"
        onClick={() => void actOnJob(job.id, "check-place")}
      >
        {words.checkPlace}
      </button>
    </div>
  );
};

/** What can be changed while it plots or is held. */
const LiveChanges = ({ job }: { job: Job }) => {
  const percents = SPEED_PERCENTS.includes(job.speedPct) ? SPEED_PERCENTS : [job.speedPct, ...SPEED_PERCENTS];
  const { changeJob } = useActions();
  const settings = usePageState((state) => state.settings);
  return (
    <div className="place">
      <Select
        label={words.speedPct}
        value={String(job.speedPct)}
        options={percents.map((pct) => ({ value: String(pct), label: `${pct} %` }))}
        onChange={(pct) => void changeJob(job.id, { speedPct: Number(pct) })}
      />
      <p className="note">{words.speedPctHint}</p>
      <button
        type="button"
        className="button button-small"
        onClick={() => void changeJob(job.id, { pen: settings.pen, motion: settings.motion })}
      >
        {words.applyHeights}
      </button>
    </div>
  );
};
