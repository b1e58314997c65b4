import type { RefObject } from "react";
import { activeJob, mayOperate, maySubmit } from "../state/store.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { plotText, queueText as words } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { formatCount, formatDuration } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { RowMenu } from "../ui/rows/row-menu.js";
import type { Copies } from "./copies.js";
import { expectedSOf } from "./queue-time.js";
import { JobName } from "./job-head.js";
import "../ui/rows/row-drag.css";
import { placeAfterMove, useRowDrag } from "../ui/rows/row-drag.js";
import { Thumb } from "../drawing/thumb.js";

interface WaitingJobProps {
  readonly copies: Copies;
  /** The waiting rows in their order, each identified by its first job. */
  readonly rowIds: readonly string[];
  readonly list: RefObject<HTMLUListElement | null>;
}

/** A waiting row: name, number of copies, duration, buttons. */
export const WaitingJob = ({ copies, rowIds, list }: WaitingJobProps) => {
  const isMine = usePageState(maySubmit);
  const isOperator = usePageState(mayOperate);
  const [job] = copies;
  const expectedS = expectedSOf(job);
  return (
    <article className="job" data-state={job.state}>
      <div className="job-row">
        <Thumb of="job" id={job.id} />
        <div className="job-words">
          <JobName job={job} />
          <span className="note">
            {expectedS === null ? plotText.planning : formatDuration(expectedS)}
            {job.place !== null && `, ${words.fromStroke(formatCount(job.place.strokeIndex + 1))}`}
            {isOperator && job.submittedBy && `, ${words.from(job.submittedBy.name)}`}
            {job.speedPct !== 100 && `, ${words.atSpeed(job.speedPct)}`}
          </span>
        </div>
        {copies.length > 1 && (
          <span className="job-copies" aria-label={words.copies(copies.length)}>
            {words.times(copies.length)}
          </span>
        )}
        {isMine && <Buttons copies={copies} rowIds={rowIds} list={list} />}
      </div>
      {isMine && <PlotterChoice copies={copies} />}
      {job.message && <p className="note">{job.message}</p>}
    </article>
  );
};

const Buttons = ({ copies, rowIds, list }: WaitingJobProps) => {
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
  const moves = [
    [words.earlier, words.earlierNamed(name), isOff || index <= 0, () => void moveTo(index - 1)],
    [words.later, words.laterNamed(name), isOff || index >= rowIds.length - 1, () => void moveTo(index + 1)],
  ] as const;
  return (
    <>
      {isOperator && (
        <IconButton
          icon="play"
          label={words.startNamed(name)}
          disabled={isOff || !isFree}
          onClick={() => void actOnJob(job.id, "start")}
        />
      )}
      <RowMenu
        label={words.more(name)}
        items={[
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
  if (plotters.length < 2) return null;
  const moveAll = async (plotterId: string): Promise<void> => {
    for (const { id } of copies) await patchJob(id, { plotterId });
  };
  return (
    <select
      className="select-small"
      aria-label={words.moveToPlotter(job.name)}
      value={job.plotterId}
      onChange={(event) => void moveAll(event.target.value)}
    >
      {plotters.map(({ id, name }) => (
        <option key={id} value={id}>
          {name}
        </option>
      ))}
    </select>
  );
};
