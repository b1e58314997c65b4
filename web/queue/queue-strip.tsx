import { ACTIVE_STATES, currentPlotter, onlySubmits } from "../state/store.js";
import { useActions, usePageState, usePlotterJobs } from "../state/use-store.js";
import { formatClockIn, formatDuration } from "../ui/format.js";
import { useNow } from "../ui/use-now.js";
import { axisText } from "./axis-text.js";
import { rowsOf } from "./copies.js";
import { queueAxis } from "./queue-time.js";
import { plotText as words } from "./text.js";

/** The plots that wait, in their order, with their times as far as these are known. Opens the queue. */
export const QueueStrip = () => {
  const nowMs = useNow();
  const jobs = usePlotterJobs();
  const plotterId = usePageState((state) => currentPlotter(state)?.id ?? "");
  const runsOn = usePageState((state) => state.queues[plotterId]?.runOn ?? false);
  const seesAll = !usePageState(onlySubmits);
  const { showPanel } = useActions();
  const waiting = jobs.filter(({ state }) => state === "queued");
  if (waiting.length === 0) return null;
  const active = jobs.filter(({ state }) => ACTIVE_STATES.includes(state));
  const { rows } = queueAxis(active, rowsOf(waiting), { runsOn, seesAll });
  const totalS = rows.reduce((all, { durationS }) => all + (durationS ?? 0), 0);
  const names = rows.map(({ copies: [{ name }], fromS, toS, isStartSure }) =>
    fromS === null || toS === null || !isStartSure
      ? name
      : `${name} ${axisText.fromTo(formatClockIn(nowMs, fromS), formatClockIn(nowMs, toS))}`,
  );
  return (
    <button type="button" className="queue-strip" onClick={() => showPanel("queue")}>
      <span className="plot-time-label">{words.queued(waiting.length, formatDuration(totalS))}</span>
      <span className="queue-names">{names.join(" · ")}</span>
    </button>
  );
};
