import { useEffect, useState } from "react";
import { isLiveJob, withOffs, type Job, type MovePlace, type PlotSettings } from "../../src/schema/index.js";
import { KeepHeights, NudgeJob } from "../plotter/hand/pen-nudge.js";
import { jobText as words } from "../queue/text.js";
import { activeJob, mayOperate, needsTick, penOf, penWait, type PageState } from "../state/store.js";
import { useActions, useBackend, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { formatCount, formatNumber } from "../ui/format.js";
import { watchText } from "./text.js";
import {
  AXIS_TABLE,
  DRAW_TABLE,
  DROP_RATE,
  OVERLAP_TABLE,
  PEN_TABLE,
  TRAVEL_TABLE,
  type Setting,
  isSameJson,
} from "../../src/internal.js";

const STEP_MM = 10;
const STROKE_BACK: MovePlace = { strokes: -1 };
const MOVES = [
  [words.strokeBack, STROKE_BACK],
  [words.strokeOn, { strokes: 1 }],
  [words.mmBack, { mm: -STEP_MM }],
  [words.mmOn, { mm: STEP_MM }],
] as const;
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
      <KeepHeights job={job} />
      {job.state === "paused" && !isWaiting && !isLiveJob(job) && job.place && (
        <PlaceControls job={job} place={job.place} />
      )}
      {!isWaiting && <LiveChanges job={job} />}
    </section>
  );
};

/** Changes where a paused plot resumes: moves the place back and forward, and sends the raised pen there. */
const PlaceControls = ({ job, place }: { job: Job; place: NonNullable<Job["place"]> }) => {
  const { movePlace, actOnJob } = useActions();
  const marking = usePlaceMark(job.id, place);
  const isLost = usePageState((state) => needsTick(state, job));
  return (
    <div className="place" role="group" aria-label={words.placeMoves}>
      <p className="note">
        {words.place(formatCount(place.strokeIndex + 1), formatNumber(place.alongMm, 1))} {words.placeMark}
      </p>
      <div className="button-grid">
        {MOVES.map(([label, move]) => (
          <Button key={label} kind="small" {...marking(move)} onClick={() => void movePlace(job.id, move)}>
            {label}
          </Button>
        ))}
      </div>
      <Button
        kind="small"
        disabled={isLost}
        title={isLost ? words.tickFirst : undefined}
        {...marking(HERE)}
        onClick={() => void actOnJob(job.id, "check-place")}
      >
        {words.checkPlace}
      </Button>
    </div>
  );
};

/** A move that stays where it is. */
const HERE: MovePlace = {};

/**
 * For a button: while it is pointed at or has the focus, the sheet shows where it leads. Otherwise it shows where one
 * stroke back leads: a finger points at nothing before it presses.
 */
const usePlaceMark = (jobId: string, { strokeIndex, alongMm }: NonNullable<Job["place"]>) => {
  const { jobs } = useBackend();
  const store = usePageStore();
  const [by, setBy] = useState(STROKE_BACK);
  useEffect(() => {
    let isCurrent = true;
    const show = (placeMark: PageState["placeMark"]): void => {
      if (isCurrent) store.setState({ placeMark });
    };
    jobs.placeAfter(jobId, by).then(
      ({ xMm, yMm }) => show({ xMm, yMm }),
      // It goes on meanwhile, or the server is gone.
      () => show(null),
    );
    return () => {
      isCurrent = false;
    };
  }, [jobs, store, jobId, by, strokeIndex, alongMm]);
  useEffect(() => () => store.setState({ placeMark: null }), [store]);
  const end = (): void => setBy(STROKE_BACK);
  return (move: MovePlace) => ({
    onPointerEnter: () => setBy(move),
    onFocus: () => setBy(move),
    onPointerLeave: end,
    onBlur: end,
  });
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

type Settings = Pick<PlotSettings, "pen" | "motion">;
type Rows = Readonly<Record<string, Setting>>;

const PEN_ROWS: Rows = { ...PEN_TABLE, ...OVERLAP_TABLE, dropPctPerS: DROP_RATE };

/** The settings of `now` that `before` does not have: "Height down 28 %". Each is named once. */
export const changedSettings = (before: Settings, now: Settings): readonly string[] => {
  const { draw: drawBefore, travel: travelBefore, ...motionBefore } = before.motion;
  const { draw, travel, ...motion } = now.motion;
  return [
    ...new Set([
      ...changed(before.pen, now.pen, PEN_ROWS),
      ...changed(drawBefore, draw, DRAW_TABLE).map(watchText.penDown),
      ...changed(travelBefore, travel, TRAVEL_TABLE).map(watchText.penUp),
      ...changed(motionBefore, motion, AXIS_TABLE),
    ]),
  ];
};

const changed = <T extends object>(before: T, now: T, rows: Rows): readonly string[] => {
  const keys = [...new Set([...Object.keys(before), ...Object.keys(now)])] as (keyof T & string)[];
  // A setting that is left out is the same as null.
  return keys
    .filter((key) => !isSameJson(before[key] ?? null, now[key] ?? null))
    .map((key) => inWords(rows[key], now[key]));
};

const inWords = (row: Setting | undefined, value: unknown): string => {
  if (row === undefined) return watchText.otherChange;
  return row.kind === "number" && typeof value === "number"
    ? `${row.label} ${formatNumber(value, row.digits)} ${row.unit}`
    : row.label;
};
