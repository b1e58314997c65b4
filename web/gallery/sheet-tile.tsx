import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import { Thumb } from "../drawing/thumb.js";
import { useSavePicture } from "../queue/done.js";
import { canGoOn, GoOnButton } from "../queue/ended-buttons.js";
import { JobName, StateBadge } from "../queue/job-head.js";
import { expectedSOf } from "../queue/queue-time.js";
import { doneText } from "../queue/axis-text.js";
import { queueText } from "../queue/text.js";
import { mayOperate, maySubmit, unfinishedJob, type PageStore } from "../state/store.js";
import {
  useActions,
  useBackend,
  useIsConnected,
  usePageState,
  usePageStore,
  usePlotterJobs,
} from "../state/use-store.js";
import { Button, IconButton } from "../ui/button.js";
import { formatDuration, formatLength, formatWhen } from "../ui/format.js";
import { RowMenu } from "../ui/rows/row-menu.js";
import { galleryText as words } from "./text.js";
import "./gallery.css";

/** How many finished plots the panel shows; the gallery has all. */
const RECENT = 6;

export const RecentSheets = () => {
  const ended = usePlotterJobs().filter((job) => ENDED_STATES.includes(job.state));
  const { openDialog } = useActions();
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">{words.title}</h2>
      <SheetGrid jobs={ended.slice(0, RECENT)} empty={words.empty} />
      {ended.length > 0 && (
        <Button kind="link" onClick={() => openDialog("gallery")}>
          {words.all}
        </Button>
      )}
    </section>
  );
};

interface SheetGridProps {
  readonly jobs: readonly Job[];
  /** In place of the grid if there are none. */
  readonly empty: string;
  onRemoved?(): void;
}

export const SheetGrid = ({ jobs, empty, onRemoved }: SheetGridProps) =>
  jobs.length === 0 ? (
    <p className="note">{empty}</p>
  ) : (
    <ul className="sheet-grid">
      {jobs.map((job) => (
        <li key={job.id}>
          <SheetTile job={job} {...(onRemoved && { onRemoved })} />
        </li>
      ))}
    </ul>
  );

interface TileProps {
  readonly job: Job;
  /** Called after the job was removed. */
  onRemoved?(): void;
}

/** A finished plot: its picture, what it drew and how long it took, and plotting it again. */
const SheetTile = ({ job, onRemoved }: TileProps) => {
  const isOperator = usePageState(mayOperate);
  const { stats } = job;
  return (
    <article className="sheet-tile" data-state={job.state}>
      <Picture job={job} />
      <JobName job={job} />
      <div className="sheet-head">
        <StateBadge job={job} />
        <TileButtons job={job} {...(onRemoved && { onRemoved })} />
      </div>
      <p className="note">
        {job.endedAt !== null && `${formatWhen(job.endedAt)} · `}
        {job.state === "done" && stats && `${words.ink(formatLength(stats.drawMm))} · `}
        {timesOf(job)}
      </p>
      {isOperator && canGoOn(job) && <GoOnButton job={job} />}
      {job.message && (
        <p className={job.state === "failed" ? "note note-error" : "note"} title={job.message}>
          {job.message}
        </p>
      )}
    </article>
  );
};

/** Shows the sheet in Watch. While a plot is under way, Watch shows that one, so the drawing is opened instead. */
const Picture = ({ job }: { job: Job }) => {
  const store = usePageStore();
  const { openJob } = useActions();
  const isBusy = usePageState((state) => unfinishedJob(state) !== null);
  const mayOpen = usePageState(maySubmit);
  if (isBusy && !mayOpen) return <Thumb of="job" id={job.id} />;
  const label = isBusy ? queueText.openNamed(job.name) : words.show(job.name);
  return (
    <button
      type="button"
      className="sheet-picture"
      aria-label={label}
      title={label}
      onClick={() => (isBusy ? void openJob(job) : showSheet(store, job))}
    >
      <Thumb of="job" id={job.id} />
    </button>
  );
};

/** An older job may not be in the page's list yet. */
const showSheet = (store: PageStore, job: Job): void =>
  store.setState(({ jobs }) => ({
    jobs: jobs.some(({ id }) => id === job.id) ? jobs : [...jobs, job],
    pageView: "watch",
    watchedId: job.id,
    openDialog: null,
  }));

const TileButtons = ({ job, onRemoved }: TileProps) => {
  const { actOnJob, keepJob, openJob, removeJob } = useActions();
  const { features } = useBackend();
  const isOperator = usePageState(mayOperate);
  const isShown = usePageState(maySubmit);
  const isOff = !useIsConnected();
  const save = useSavePicture(job);
  if (!isShown) return null;
  const { id, name } = job;
  const keep = [words.keep, words.keepNamed(name), isOff, () => void keepJob(job)] as const;
  const remove = async (): Promise<void> => {
    if ((await removeJob(id)) !== null) onRemoved?.();
  };
  const pictures = (["png", "svg"] as const).map(
    (format) =>
      [doneText.saveNamed(format), doneText.saveOf(format, name), isOff, () => void save(format)] as const,
  );
  // What was plotted stays in the history of those who look after the plotter.
  const mayRemove = isOperator || job.startedAt === null;
  return (
    <>
      <IconButton
        icon="again"
        label={queueText.againNamed(name)}
        disabled={isOff}
        onClick={() => void actOnJob(id, "requeue")}
      />
      <RowMenu
        label={queueText.more(name)}
        items={[
          [queueText.open, queueText.openNamed(name), false, () => void openJob(job)],
          ...(job.state === "done" ? pictures : []),
          ...(isOperator && features.library ? [keep] : []),
          ...(mayRemove
            ? [[queueText.remove, queueText.removeNamed(name), isOff, () => void remove()] as const]
            : []),
        ]}
      />
    </>
  );
};

/** Its duration, and the expected one. */
const timesOf = (job: Job): string => {
  const took = queueText.took(formatDuration(job.plottedS ?? job.elapsedS));
  const expectedS = expectedSOf(job);
  return job.state === "done" && expectedS !== null
    ? `${took} · ${queueText.estimated(formatDuration(expectedS))}`
    : took;
};
