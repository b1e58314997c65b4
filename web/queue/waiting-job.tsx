import type { RefObject } from "react";
import { activeJob, mayOperate, maySubmit } from "../state/store.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { axisText } from "./axis-text.js";
import { plotText, queueText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { useShownAgain } from "../ui/fields/choice.js";
import { formatClockIn, formatCount, formatDuration } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { RowMenu } from "../ui/rows/row-menu.js";
import type { Copies } from "./copies.js";
import { waitsForPaper, type AxisRow } from "./queue-time.js";
import { JobName } from "./job-head.js";
import "../ui/rows/row-drag.css";
import { placeAfterMove, useRowDrag } from "../ui/rows/row-drag.js";
import { useNow } from "../ui/use-now.js";
import { Thumb } from "../drawing/thumb.js";

interface WaitingJobProps {
  readonly row: AxisRow;
  /** The waiting rows in their order, each identified by its first job. */
  readonly rowIds: readonly string[];
  readonly list: RefObject<HTMLUListElement | null>;
}

/** A waiting row: name, number of copies, when it starts and ends, the pens it stops for, buttons. */
export const WaitingJob = ({ row, rowIds, list }: WaitingJobProps) => {
  const isMine = usePageState(maySubmit);
  const { copies } = row;
  const [job] = copies;
  return (
    <article className="job waiting-job" data-state={job.state}>
      <Thumb of="job" id={job.id} />
      <div className="waiting-head">
        <JobName job={job} />
        {copies.length > 1 && (
          <span className="job-copies" aria-label={words.copies(copies.length)}>
            {words.times(copies.length)}
          </span>
        )}
        {isMine && <Buttons copies={copies} rowIds={rowIds} list={list} />}
      </div>
      <Times row={row} />
      <Details row={row} />
      {isMine && <PlotterChoice copies={copies} />}
    </article>
  );
};

/** "23:40–01:02 · 1 h 22 min". */
const Times = ({ row: { fromS, toS, durationS, isStartSure } }: { row: AxisRow }) => {
  const nowMs = useNow();
  const isConnected = useIsConnected();
  if (durationS === null) return <p className="note">{plotText.planning}</p>;
  const takes = formatDuration(durationS);
  if (!isConnected || fromS === null || toS === null) return <p className="axis-times">{takes}</p>;
  const [from, to] = [formatClockIn(nowMs, fromS), formatClockIn(nowMs, toS)];
  return (
    <p className="axis-times">
      {isStartSure ? (
        <span className="axis-clock">{axisText.fromTo(from, to)}</span>
      ) : (
        <span>{axisText.notBefore(from)}</span>
      )}{" "}
      · {takes}
    </p>
  );
};

/** What else is to be known before it is plotted. */
const Details = ({ row: { copies } }: { row: AxisRow }) => {
  const [job] = copies;
  const isOperator = usePageState(mayOperate);
  const plotterId = job.plotterId;
  const runsOn = usePageState((state) => state.queues[plotterId]?.runOn ?? false);
  const facts = [
    ...(copies.length > 1 && waitsForPaper(job, job, runsOn) ? [axisText.paperAfterEach] : []),
    ...(job.place === null ? [] : [words.fromStroke(formatCount(job.place.strokeIndex + 1))]),
    ...(isOperator && job.submittedBy ? [words.from(job.submittedBy.name)] : []),
    ...(job.speedPct === 100 ? [] : [words.atSpeed(job.speedPct)]),
    ...(job.message === null ? [] : [job.message]),
  ];
  // The stop before the first stroke is shown before the row.
  const stops = (job.stats?.pens?.stops ?? []).filter(({ strokeIndex }) => strokeIndex > 0);
  return (
    <>
      {facts.length > 0 && <p className="note axis-facts">{facts.join(", ")}</p>}
      {stops.length > 0 && (
        <p className="note axis-pens">
          {axisText.penStops(stops.length)}
          {stops.slice(0, SHOWN_STOPS).map(({ strokeIndex, name, color }) => (
            <span key={strokeIndex} className="axis-pen">
              <span className="swatch" style={{ background: color ?? "transparent" }} />
              {name}
            </span>
          ))}
        </p>
      )}
    </>
  );
};

const SHOWN_STOPS = 4;

interface ButtonsProps extends Pick<WaitingJobProps, "rowIds" | "list"> {
  readonly copies: Copies;
}

const Buttons = ({ copies, rowIds, list }: ButtonsProps) => {
  const [job] = copies;
  const { actOnJob, duplicateJob, moveJob, openJob, removeJob } = useActions();
  const isFree = usePageState((state) => activeJob(state) === null);
  const isOperator = usePageState(mayOperate);
  const isOff = !useIsConnected();
  const index = rowIds.indexOf(job.id);
  const moveTo = async (place: number): Promise<void> => {
    const beforeId = placeAfterMove(rowIds, job.id, place);
    if (beforeId === undefined) return;
    for (const { id } of copies) await moveJob(id, beforeId);
  };
  const removeAll = async (): Promise<void> => {
    // Backwards, because the first job identifies the row.
    for (const { id } of [...copies].reverse()) await removeJob(id);
  };
  const drag = useRowDrag(list, job.id, index, (place) => void moveTo(place));
  const { name } = job;
  // Of several copies the last is removed, because the first may be about to start.
  const last = copies.at(-1) ?? job;
  const all = words.removeAll(copies.length);
  const startNow = [
    words.startNow,
    words.startNowNamed(name),
    isOff || !isFree,
    () => void actOnJob(job.id, "start"),
  ] as const;
  const moves = [
    [words.earlier, words.earlierNamed(name), isOff || index <= 0, () => void moveTo(index - 1)],
    [words.later, words.laterNamed(name), isOff || index >= rowIds.length - 1, () => void moveTo(index + 1)],
  ] as const;
  return (
    <>
      <RowMenu
        label={words.more(name)}
        items={[
          ...(isOperator && index > 0 ? [startNow] : []),
          [words.open, words.openNamed(name), false, () => void openJob(job)],
          [words.duplicate, words.duplicateNamed(name), isOff, () => void duplicateJob(job.id)],
          ...(isOperator ? moves : []),
          [words.remove, words.removeNamed(name), isOff, () => void removeJob(last.id)],
          ...(copies.length > 1 ? [[all, all, isOff, () => void removeAll()] as const] : []),
        ]}
      />
      {isOperator && rowIds.length > 1 && (
        <Button
          kind="smallIcon"
          className="drag-handle"
          aria-label={words.drag(name)}
          title={words.dragHint}
          disabled={isOff}
          {...drag}
        >
          <Icon name="grip" />
        </Button>
      )}
    </>
  );
};

/** Chooses the plotter of the job. Not shown when there is only one. */
const PlotterChoice = ({ copies }: { copies: Copies }) => {
  const [job] = copies;
  const plotters = usePageState((state) => state.plotters);
  const { patchJob } = useActions();
  const moveAll = async (plotterId: string): Promise<void> => {
    for (const { id } of copies) await patchJob(id, { plotterId });
  };
  const choose = useShownAgain((plotterId: string) => void moveAll(plotterId));
  if (plotters.length < 2) return null;
  return (
    <select
      className="select-small"
      aria-label={words.moveToPlotter(job.name)}
      value={job.plotterId}
      onChange={(event) => choose(event.target.value)}
    >
      {plotters.map(({ id, name }) => (
        <option key={id} value={id}>
          {name}
        </option>
      ))}
    </select>
  );
};
