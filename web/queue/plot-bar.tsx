import { isOutOfReach, isOutsidePaper, isOutsideUnanswered } from "../drawing/where-drawn.js";
import { movesText } from "../plotter/hand/text.js";
import { TRACE_FRAME } from "../plotter/plotter-actions.js";
import { plotterText } from "../plotter/text.js";
import { activeJob, currentPlotter, onlySubmits, shownView } from "../state/store.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { stateText } from "../state/text.js";
import { isEnabled } from "../state/page-action.js";
import { isSendingJob, PLOT, QUEUE, SAVE_TO_JOB } from "./plot-actions.js";
import { plotText as words } from "./text.js";
import { ActionButton } from "../ui/action-button.js";
import { Facts } from "../ui/facts.js";
import { formatCount, formatDuration, formatLength, formatPercent } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { NumberField } from "../ui/fields/number-field.js";

const OutsidePaper = lazyPart(async () => (await import("../drawing/outside-paper.js")).OutsidePaper);
const OutOfReach = lazyPart(async () => (await import("../drawing/out-of-reach.js")).OutOfReach);
const QueueStrip = lazyPart(async () => (await import("./queue-strip.js")).QueueStrip);
const HoldCard = lazyPart(async () => (await import("./hold-card.js")).HoldCard);
const JobButtons = lazyPart(async () => (await import("./job-buttons.js")).JobButtons);
const MAX_COPIES = 100;

/** The plot's time, the queue and the main buttons, under the sheet. On a phone, the running plot's replace them. */
export const PlotBar = () => {
  const isPreparing = usePageState((state) => shownView(state) === "prepare");
  const hasJob = usePageState((state) => activeJob(state) !== null);
  const drawingKey = usePageState((state) => state.drawing?.key);
  if (!isPreparing) return null;
  return (
    <section
      id="plot-bar"
      tabIndex={-1}
      className="plot-bar"
      aria-label={words.plot}
      data-active={hasJob || undefined}
    >
      <Notes />
      <PlotTime />
      <Figures />
      <QueueStrip />
      {/* What is being typed into a field belongs to the drawing before. */}
      <Buttons key={drawingKey} />
      <RunningJob />
    </section>
  );
};

const PlotTime = () => {
  const planned = usePageState((state) => state.planned);
  const isPlanning = usePageState((state) => state.isPlanning);
  return (
    <div className="plot-time">
      <span className="plot-time-label" role="status">
        {isPlanning ? words.planning : words.time}
      </span>
      <span className="plot-time-value" data-stale={isPlanning || undefined}>
        {planned ? formatDuration(planned.stats.durationS) : "–"}
      </span>
    </div>
  );
};

/** What the user should know before pressing Plot, or why it is off. */
const Notes = () => {
  const isUnreached = usePageState(isOutOfReach);
  const isOutside = usePageState(isOutsidePaper);
  const isUnanswered = usePageState(isOutsideUnanswered);
  return (
    <div className="plot-notes">
      <CutOffNote />
      {isOutside && <OutsidePaper />}
      {isUnreached && !isUnanswered && <OutOfReach />}
      <PlotNote />
    </div>
  );
};

const Figures = () => {
  const planned = usePageState((state) => state.planned);
  if (!planned) return null;
  const { stats, strokeCount } = planned;
  return (
    <Facts
      className="figures"
      rows={[
        [words.distance, formatLength(stats.drawMm)],
        [words.travel, formatLength(stats.travelMm)],
        [words.strokes, formatCount(strokeCount)],
        [words.lifts, formatCount(stats.penLiftCount)],
      ]}
    />
  );
};

const Buttons = () => {
  const store = usePageStore();
  const copies = usePageState((state) => state.copies);
  const isOff = !usePageState((state) => isEnabled(QUEUE, state));
  const isSending = usePageState(isSendingJob);
  const isSubmitting = usePageState(onlySubmits);
  return (
    <div className="plot-buttons">
      <div className="copies">
        <NumberField
          label={words.copies}
          value={copies}
          unit="×"
          min={1}
          max={MAX_COPIES}
          step={1}
          digits={0}
          disabled={isOff}
          onChange={(count) => store.setState({ copies: Math.round(count) })}
        />
      </div>
      <ActionButton
        action={TRACE_FRAME}
        kind="tool"
        icon="frame"
        hasText
        className="tool-wide"
        hint={movesText.frameHint}
      />
      <ActionButton action={SAVE_TO_JOB} className="save-to-job" />
      <ActionButton action={QUEUE} {...(isSubmitting && { kind: "primary" })} />
      <ActionButton action={PLOT} kind="primary" isBusy={isSending} />
    </div>
  );
};

/** Why "Plot" is off, or what happens after it was pressed. */
const PlotNote = () => {
  const isSending = usePageState(isSendingJob);
  const isBusy = usePageState((state) => activeJob(state) !== null);
  const isAbsent = usePageState((state) => currentPlotter(state)?.connection === "absent");
  const link = usePageState((state) => state.link);
  const hasDrawing = usePageState((state) => state.drawing !== null);
  if (link === "lost") return <p className="note note-error">{stateText.notConnected}</p>;
  if (isSending) {
    return (
      <p className="note note-working" role="status">
        {words.sending}
      </p>
    );
  }
  if (!hasDrawing) return <p className="note needs-drawing">{words.needsDrawing}</p>;
  if (link === "connecting") return <p className="note note-working">{plotterText.server.connecting}</p>;
  if (isBusy) return <p className="note">{words.queueBusy}</p>;
  return isAbsent ? <p className="note">{words.needsPlotter}</p> : null;
};

/** While a job has the plotter. On a small screen it replaces the rest of the bar. */
const RunningJob = () => {
  const job = usePageState(activeJob);
  if (!job) return null;
  return (
    <div className="plot-bar-job">
      <p>
        <strong>{job.name}</strong> {formatPercent(job.progress)}
      </p>
      <HoldCard job={job} />
      <JobButtons job={job} />
    </div>
  );
};

/** How many lines are not drawn, or only in part, and why. */
const CutOffNote = () => {
  const cutOff = usePageState((state) => state.planned?.cutOff ?? null);
  const isAtMargins = usePageState((state) => state.planned?.settings.prepare.clipToMargins ?? false);
  if (!cutOff) return null;
  const { outsideCount, partCount } = cutOff;
  const edge = isAtMargins ? words.margins : words.paper;
  return (
    <p className="note cut-off-note">
      {outsideCount > 0 && words.outside(outsideCount, formatCount(outsideCount), edge)}{" "}
      {partCount > 0 && words.cutOff(partCount, formatCount(partCount), edge)}
    </p>
  );
};
