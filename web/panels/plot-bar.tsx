import { activeJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatCount, formatDuration, formatLength } from "../ui/format.js";

const words = text.plot;

/** What the plot will take, and the two buttons that matter. */
export const PlotBar = () => {
  const planned = usePageState((state) => state.planned);
  const isPlanning = usePageState((state) => state.isPlanning);
  return (
    <section className="card plot-bar" aria-label={words.plot}>
      <div className="plot-time">
        <span className="plot-time-value" data-stale={isPlanning || undefined}>
          {planned ? formatDuration(planned.stats.durationS) : "–"}
        </span>
        <span className="plot-time-label" role="status">
          {isPlanning ? text.drawing.planning : words.time}
        </span>
      </div>
      <Figures />
      <Buttons />
    </section>
  );
};

const Figures = () => {
  const planned = usePageState((state) => state.planned);
  if (!planned) return null;
  const { stats, strokeCount } = planned;
  const figures = [
    [words.distance, formatLength(stats.drawMm)],
    [words.travel, formatLength(stats.travelMm)],
    [words.strokes, formatCount(strokeCount)],
    [words.lifts, formatCount(stats.penLiftCount)],
  ] as const;
  return (
    <dl className="figures">
      {figures.map(([label, value]) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
};

const Buttons = () => {
  const canQueue = usePageState(
    (state) => state.drawing !== null && (state.planned?.strokeCount ?? 0) > 0 && state.fault === null,
  );
  const isLinked = usePageState((state) => state.link === "connected" && state.plotters.length > 0);
  const isActive = usePageState((state) => activeJob(state) !== null);
  const isSending = usePageState((state) => state.busyAction === "add" || state.busyAction === "plot");
  const link = usePageState((state) => state.link);
  const { plotDrawing, queueDrawing } = useActions();
  const isOff = !canQueue || !isLinked || isSending;
  return (
    <div className="plot-buttons">
      <button
        type="button"
        className="button button-primary"
        disabled={isOff || isActive}
        onClick={() => void plotDrawing()}
      >
        {words.plot}
      </button>
      <button type="button" className="button" disabled={isOff} onClick={() => void queueDrawing()}>
        {words.addToQueue}
      </button>
      {link === "lost" && <p className="note note-error">{words.needsServer}</p>}
      {isActive && isLinked && <p className="note">{words.queueBusy}</p>}
    </div>
  );
};
