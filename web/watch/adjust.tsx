import { withOffs, type Job } from "../../src/schema/index.js";
import { NudgeJob } from "../plotter/pen-nudge.js";
import { jobText as words } from "../queue/text.js";
import { activeJob, mayOperate, penOf, penWait } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/choice.js";
import { formatCount, formatNumber } from "../ui/format.js";
import { changedSettings } from "./changed-settings.js";
import { watchText } from "./text.js";

const STEP_MM = 10;
const SPEED_PERCENTS: readonly number[] = [25, 50, 75, 90, 100, 110, 125, 150, 200];

/** Changes of the running plot: pen heights, speed, and where a paused plot resumes. */
export const Adjust = () => {
  const job = usePageState(activeJob);
  const canChange = usePageState((state) => mayOperate(state) && state.link === "connected");
  if (!job || !canChange) return null;
  const isWaiting = penWait(job) !== null;
  return (
    <section className="card adjust" aria-label={watchText.adjust}>
      <h2 className="card-title">{watchText.adjust}</h2>
      <NudgeJob job={job} />
      {job.state === "paused" && !isWaiting && job.place && <PlaceControls job={job} place={job.place} />}
      {!isWaiting && <LiveChanges job={job} />}
    </section>
  );
};

/** Changes where a paused plot resumes: moves the place back and forward, and sends the raised pen there. */
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
        {moves.map(([label, move]) => (
          <Button key={label} kind="small" onClick={() => void movePlace(job.id, move)}>
            {label}
          </Button>
        ))}
      </div>
      <Button kind="small" onClick={() => void actOnJob(job.id, "check-place")}>
        {words.checkPlace}
      </Button>
    </div>
  );
};

/** Changes that are possible while it plots or is paused. */
const LiveChanges = ({ job }: { job: Job }) => {
  const percents = SPEED_PERCENTS.includes(job.speedPct) ? SPEED_PERCENTS : [job.speedPct, ...SPEED_PERCENTS];
  const { changeJob } = useActions();
  return (
    <div className="place">
      <Select
        label={words.speedPct}
        hint={words.speedPctHint}
        value={String(job.speedPct)}
        options={percents.map((pct) => ({ value: String(pct), label: `${pct} %` }))}
        onChange={(pct) => void changeJob(job.id, { speedPct: Number(pct) })}
      />
      <ApplyChanges job={job} />
    </div>
  );
};

/**
 * Applies the page's pen and speed settings to the plot. Only offered where the user changed them after this page opened
 * or sent the job: on another page, such as a phone that only watches, they are those of another drawing.
 */
const ApplyChanges = ({ job }: { job: Job }) => {
  const { changeJob } = useActions();
  const settings = usePageState((state) => state.settings);
  const pen = usePageState((state) => penOf(state, job));
  const isChangedHere = usePageState(({ drawing }) => drawing?.jobId === null && drawing.sourceId === job.id);
  const changes = changedSettings({ pen, motion: job.settings.motion }, settings);
  if (!isChangedHere || changes.length === 0) return null;
  return (
    <>
      <Button
        kind="small"
        onClick={() => void changeJob(job.id, withOffs({ pen: settings.pen, motion: settings.motion }))}
      >
        {watchText.apply}
      </Button>
      <p className="note">{changes.join(", ")}</p>
    </>
  );
};
