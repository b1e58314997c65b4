import { findsHome, machineOf } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { isPositionLost, mayOperate, type PageState } from "../state/store.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { jobText as words } from "./text.js";
import { Icon } from "../ui/icon.js";
import "./jobs.css";

/** Whether the job has such a card, which then has the job's message. */
export const hasHoldCard = (state: PageState, job: Job): boolean => job.stopped || isPositionLost(state, job);

/** After an emergency stop, or if the position is lost: what happened, and what to do before the plot is resumed. */
export const HoldCard = ({ job }: { job: Job }) => {
  const isLost = usePageState((state) => isPositionLost(state, job));
  const isShown = usePageState((state) => hasHoldCard(state, job));
  if (!isShown) return null;
  const title = isLost ? words.lost : words.stopped;
  return (
    <div className="hold-card" role="group" aria-label={title} data-kind={isLost ? "lost" : "stopped"}>
      <Icon name={isLost ? "warning" : "stop"} />
      <div>
        <strong>{title}</strong>
        {job.message !== null && <p>{job.message}</p>}
        {isLost && <Corner job={job} />}
      </div>
    </div>
  );
};

/** How the plotter gets its position back: by the user, who says so, or by itself. */
const Corner = ({ job }: { job: Job }) => {
  const store = usePageStore();
  const isOperator = usePageState(mayOperate);
  const isTicked = usePageState(({ cornerJobId }) => cornerJobId === job.id);
  if (findsHome(machineOf(job.settings))) return <p>{words.lostHomes}</p>;
  return (
    <>
      <p>{words.lostHint}</p>
      {isOperator && (
        <label className="hold-tick">
          <input
            type="checkbox"
            checked={isTicked}
            onChange={(event) => store.setState({ cornerJobId: event.target.checked ? job.id : null })}
          />
          {words.corner}
        </label>
      )}
    </>
  );
};
