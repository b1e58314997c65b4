import { findsHome, machineOf } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { isHeightLost, isPositionLost, lostByHand, mayOperate, type PageState } from "../state/store.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { jobText as words } from "./text.js";
import { Icon } from "../ui/icon.js";
import "./jobs.css";

/** Whether the job has such a card, which then has the job's message. */
export const hasHoldCard = (state: PageState, job: Job): boolean =>
  job.stopped || isPositionLost(state, job) || isHeightLost(state, job);

/** After an emergency stop, or if the position or the height is lost: what happened, and what to do before the plot is resumed. */
export const HoldCard = ({ job }: { job: Job }) => {
  const isLost = usePageState((state) => isPositionLost(state, job));
  const isHeight = usePageState((state) => isHeightLost(state, job));
  const isShown = usePageState((state) => hasHoldCard(state, job));
  if (!isShown) return null;
  const title = isLost ? words.lost : isHeight ? words.lostHeight : words.stopped;
  return (
    <div
      className="hold-card"
      role="group"
      aria-label={title}
      data-kind={isLost || isHeight ? "lost" : "stopped"}
    >
      <Icon name={isLost || isHeight ? "warning" : "stop"} />
      <div>
        <strong>{title}</strong>
        {job.message !== null && <p>{job.message}</p>}
        {isLost && <p>{findsHome(machineOf(job.settings)) ? words.lostHomes : words.lostHint}</p>}
        {isHeight && <p>{words.heightHint}</p>}
        <Tick job={job} />
      </div>
    </div>
  );
};

/** The user says that what is lost is back. */
const Tick = ({ job }: { job: Job }) => {
  const store = usePageStore();
  const isOperator = usePageState(mayOperate);
  const isTicked = usePageState(({ tickedJobId }) => tickedJobId === job.id);
  const lost = usePageState((state) => lostByHand(state, job));
  if (lost === null || !isOperator) return null;
  return (
    <label className="hold-tick">
      <input
        type="checkbox"
        checked={isTicked}
        onChange={(event) => store.setState({ tickedJobId: event.target.checked ? job.id : null })}
      />
      {words.ticks[lost]}
    </label>
  );
};
