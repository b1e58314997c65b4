import type { Job } from "../../src/schema/index.js";
import { activeJob, mayOperate, maySubmit } from "../state/store.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { queueText as words } from "./text.js";
import { Button } from "../ui/button.js";

/** Buttons of a waiting or ended job: start it, resume it, or plot it again. */
export const EndedButtons = ({ job }: { job: Job }) => {
  const { actOnJob } = useActions();
  const isOperator = usePageState(mayOperate);
  const isShown = usePageState(maySubmit);
  const isOff = !useIsConnected();
  const isFree = usePageState((state) => activeJob(state) === null);
  if (!isShown) return null;
  if (job.state === "queued") {
    return isOperator ? (
      <Button
        kind="primary"
        disabled={isOff || !isFree}
        aria-label={words.startNamed(job.name)}
        onClick={() => void actOnJob(job.id, "start")}
      >
        {words.start}
      </Button>
    ) : null;
  }
  return (
    <div className="button-row ended-buttons">
      {isOperator && canGoOn(job) && <GoOnButton job={job} />}
      <Button
        disabled={isOff}
        aria-label={words.againNamed(job.name)}
        onClick={() => void actOnJob(job.id, "requeue")}
      >
        {words.again}
      </Button>
    </div>
  );
};

export const GoOnButton = ({ job }: { job: Job }) => {
  const { actOnJob } = useActions();
  const isOff = !useIsConnected();
  const isFree = usePageState((state) => activeJob(state) === null);
  return (
    <Button
      disabled={isOff || !isFree}
      aria-label={words.goOnNamed(job.name)}
      onClick={() => void actOnJob(job.id, "recover")}
    >
      {words.goOn}
    </Button>
  );
};

/** Whether a cancelled job was partly drawn, and its place is known. */
export const canGoOn = ({ state, place, progress }: Job): boolean =>
  state === "cancelled" && place !== null && progress > 0;
