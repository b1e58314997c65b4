import type { Job } from "../../src/schema/index.js";
import { DoneButtons, DoneFigures, KeepChanges } from "../queue/done.js";
import { EndedButtons } from "../queue/ended-buttons.js";
import { hasHoldCard, HoldCard } from "../queue/hold-card.js";
import { JobButtons } from "../queue/job-buttons.js";
import { Progress, StateBadge } from "../queue/job-head.js";
import { PenWait } from "../queue/pen-wait.js";
import { expectedSOf } from "../queue/queue-time.js";
import { jobText, queueText } from "../queue/text.js";
import { ACTIVE_STATES, penWait } from "../state/store.js";
import { useIsConnected, usePageState } from "../state/use-store.js";
import { Icon } from "../ui/icon.js";
import { formatClockIn, formatDuration, formatPercent } from "../ui/format.js";
import { useNow } from "../ui/use-now.js";
import { ActionButton } from "../ui/action-button.js";
import { DRAW } from "./draw-action.js";
import { layerNow } from "./watch-look.js";
import { watchText as words } from "./text.js";

/** The plot's progress, readable from across the room, and its buttons. */
export const StatusCard = ({ job }: { job: Job }) => {
  const isActive = ACTIVE_STATES.includes(job.state);
  const wait = penWait(job);
  return (
    <>
      <div id="plot-status" tabIndex={-1} className="status-words">
        <p className="status-name">
          <strong>{job.name}</strong>
          <StateBadge job={job} />
        </p>
        <Figures job={job} />
        {isActive && wait === null && <LayerLine job={job} />}
      </div>
      <div className="status-actions">
        {isActive && (wait ? <PenWait job={job} wait={wait} /> : <JobButtons job={job} />)}
        {!isActive && (
          <div className="button-row status-ended">
            {job.state === "done" ? <DoneButtons job={job} /> : <EndedButtons job={job} />}
            <DrawButton />
          </div>
        )}
      </div>
      <div className="status-below">
        {job.state !== "queued" && job.state !== "done" && <Progress job={job} />}
        <HoldCard job={job} />
        {job.state === "done" && <KeepChanges job={job} />}
        <Message job={job} isWaiting={wait !== null} />
      </div>
    </>
  );
};

/** Opens drawing by hand. */
export const DrawButton = () => <ActionButton action={DRAW} hint={words.drawHint} />;

const Figures = ({ job }: { job: Job }) => {
  const nowMs = useNow();
  const isConnected = useIsConnected();
  const share = formatPercent(job.progress);
  if (!isConnected) {
    return (
      <p className="status-figures">
        <span className="status-large">{words.lastSeen(share)}</span>
        {job.state === "plotting" && <span>{words.lastSeenHint}</span>}
      </p>
    );
  }
  if (job.state === "queued") {
    const expectedS = expectedSOf(job);
    return (
      <p className="status-figures">
        {expectedS !== null && <span>{queueText.estimated(formatDuration(expectedS))}</span>}
      </p>
    );
  }
  if (job.state === "done") return <DoneFigures job={job} />;
  if (!ACTIVE_STATES.includes(job.state)) {
    return (
      <p className="status-figures">
        <span className="status-large">{share}</span>
        <span>{queueText.took(formatDuration(job.plottedS ?? job.elapsedS))}</span>
      </p>
    );
  }
  return (
    <p className="status-figures">
      {job.remainingS !== null && (
        <span>
          <span className="status-large">{formatDuration(job.remainingS)}</span> {words.left}
        </span>
      )}
      <span className="status-share">{share}</span>
      {job.remainingS !== null && job.state === "plotting" && (
        <span>{jobText.doneAt(formatClockIn(nowMs, job.remainingS))}</span>
      )}
    </p>
  );
};

/** The current layer and pen. */
const LayerLine = ({ job }: { job: Job }) => {
  const planned = usePageState((state) => state.watchPlan?.planned ?? null);
  const live = usePageState((state) => state.live);
  const layer = layerNow(job, planned, live);
  if (!layer) return null;
  const { number, count, name, penName, color } = layer;
  return (
    <p className="status-layer">
      <span className="status-ink" style={{ background: color ?? "transparent" }} aria-hidden="true" />
      {count > 1 ? words.layer(number, count, name) : name}
      {penName !== null && penName !== name && ` · ${words.pen(penName)}`}
    </p>
  );
};

const Message = ({ job, isWaiting }: { job: Job; isWaiting: boolean }) => {
  const isBroken = job.state === "interrupted";
  const isInCard = usePageState((state) => hasHoldCard(state, job));
  if (isInCard || isWaiting || (job.message === null && !isBroken)) return null;
  if (isBroken) {
    return (
      <div className="hold-card">
        <Icon name="warning" />
        <p>
          {job.message} {jobText.recoverHint}
        </p>
      </div>
    );
  }
  return <p className={job.state === "failed" ? "note note-error" : "note"}>{job.message}</p>;
};
