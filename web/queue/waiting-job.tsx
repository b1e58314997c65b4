import type { RefObject } from "react";
import type { Job } from "../../src/schema/index.js";
import { activeJob, mayOperate } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { plotText, queueText } from "./text.js";
import { formatDuration } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { IconButton } from "../ui/icon-button.js";
import { JobHead } from "./job-head.js";
import "../ui/row-drag.css";
import { placeAfterMove, useRowDrag } from "../ui/row-drag.js";
import { Thumb } from "../drawing/thumb.js";

const words = queueText;

interface WaitingJobProps {
  readonly job: Job;
  /** The waiting jobs in their order. */
  readonly queue: readonly Job[];
  readonly list: RefObject<HTMLUListElement | null>;
}

export const WaitingJob = ({ job, queue, list }: WaitingJobProps) => {
  const isMine = usePageState(mayOperate);
  const expectedS = job.expectedS ?? job.stats?.durationS ?? null;
  return (
    <article className="job job-with-thumb" data-state={job.state}>
      <Thumb of="job" id={job.id} />
      <JobHead job={job} />
      <p className="job-line">
        <span>
          {expectedS === null ? plotText.planning : words.about(formatDuration(expectedS))}
          {job.speedPct !== 100 && `, ${words.atSpeed(job.speedPct)}`}
        </span>
        {isMine && <PlotterChoice job={job} />}
      </p>
      {job.message && <p className="note">{job.message}</p>}
      {isMine && <Buttons job={job} queue={queue} list={list} />}
    </article>
  );
};

const Buttons = ({ job, queue, list }: WaitingJobProps) => {
  const { actOnJob, duplicateJob, moveJob, removeJob } = useActions();
  const isFree = usePageState((state) => activeJob(state) === null);
  const ids = queue.map(({ id }) => id);
  const index = ids.indexOf(job.id);
  const moveTo = (place: number): void => {
    const beforeId = placeAfterMove(ids, job.id, place);
    if (beforeId !== undefined) void moveJob(job.id, beforeId);
  };
  const drag = useRowDrag(list, job.id, moveTo);
  return (
    <div className="button-row">
      <button
        type="button"
        className="button button-small"
        aria-label={queueText.startNamed(job.name)}
        disabled={!isFree}
        onClick={() => void actOnJob(job.id, "start")}
      >
        <Icon name="play" />
        {words.start}
      </button>
      <span className="spacer" />
      {ids.length > 1 && (
        <>
          <IconButton
            icon="up"
            label={words.earlier(job.name)}
            isOff={index <= 0}
            onClick={() => moveTo(index - 1)}
          />
          <IconButton
            icon="down"
            label={words.later(job.name)}
            isOff={index >= ids.length - 1}
            onClick={() => moveTo(index + 1)}
          />
        </>
      )}
      <IconButton icon="copy" label={words.duplicate(job.name)} onClick={() => void duplicateJob(job.id)} />
      <IconButton
        icon="close"
        label={queueText.removeNamed(job.name)}
        onClick={() => void removeJob(job.id)}
      />
      {ids.length > 1 && (
        <button
          type="button"
          className="button button-icon button-small drag-handle"
          aria-label={words.drag(job.name)}
          title={words.dragHint}
          onKeyDown={(event) => {
            const way = event.key === "ArrowUp" ? -1 : event.key === "ArrowDown" ? 1 : 0;
            if (way === 0) return;
            event.preventDefault();
            moveTo(index + way);
          }}
          {...drag}
        >
          <Icon name="grip" />
        </button>
      )}
    </div>
  );
};

/** Which plotter's queue it stands in; absent where there is one plotter. */
const PlotterChoice = ({ job }: { job: Job }) => {
  const plotters = usePageState((state) => state.plotters);
  const { patchJob } = useActions();
  if (plotters.length < 2) return null;
  return (
    <select
      className="select-small"
      aria-label={words.moveToPlotter(job.name)}
      value={job.plotterId}
      onChange={(event) => void patchJob(job.id, { plotterId: event.target.value })}
    >
      {plotters.map(({ id, name }) => (
        <option key={id} value={id}>
          {name}
        </option>
      ))}
    </select>
  );
};
