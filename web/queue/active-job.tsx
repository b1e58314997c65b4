import type { Job } from "../../src/schema/index.js";
import { mayOperate } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { jobText } from "./text.js";
import { Select } from "../ui/choice.js";
import { formatClockIn, formatCount, formatDuration, formatNumber, formatPercent } from "../ui/format.js";
import { useNow } from "../ui/use-now.js";
import { JobButtons } from "./job-buttons.js";
import { JobHead, Progress } from "./job-head.js";
import { NudgeJob } from "../plotter/pen-nudge.js";
import { PenWait } from "./pen-wait.js";

const words = jobText;
const STEP_MM = 10;
const SPEED_PERCENTS: readonly number[] = [25, 50, 75, 90, 100, 110, 125, 150, 200];

/** The job that has the plotter: how far it is, and what can be done with it in its state. */
export const ActiveJob = ({ job }: { job: Job }) => {
  const isMine = usePageState(mayOperate);
  const isWaiting = job.state === "paused" && job.wait !== null;
  return (
    <article className="job job-active" data-state={job.state}>
      <JobHead job={job} />
      <Progress job={job} />
      <TimeLeft job={job} />
      {job.message && !isWaiting && <p className="note">{job.message}</p>}
      {job.state === "interrupted" && <p className="note">{words.recoverHint}</p>}
      {isWaiting && job.wait ? <PenWait job={job} wait={job.wait} /> : <JobButtons job={job} />}
      {isMine && job.state !== "interrupted" && <NudgeJob job={job} />}
      {isMine && job.state === "paused" && !isWaiting && job.place && (
        <PlaceControls job={job} place={job.place} />
      )}
      {isMine && job.state !== "interrupted" && !isWaiting && <LiveChanges job={job} />}
    </article>
  );
};

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
