import { useState } from "react";
import type { Job } from "../../src/schema/index.js";
import { penWait } from "../state/store.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { isLocked, isMainActionOff, mainActionOf } from "./plot-actions.js";
import { jobText as words, queueText } from "./text.js";
import { Button } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import "./jobs.css";

/**
 * Pause, resume, cancel, stop: the buttons for a job in its present state. Cancel asks for confirmation, because a
 * plot may have taken hours. Watchers may only stop a plot.
 */
export const JobButtons = ({ job }: { job: Job }) => {
  const [isAsking, setAsking] = useState(false);
  // Without a connection the server would not receive the request, so the buttons are disabled.
  const isOff = !useIsConnected();
  const isAsked = isAsking && !isOff;
  const buttons = (
    <div className="button-row job-buttons">
      <MainButton job={job} isAsked={isAsked} />
      <Button disabled={isOff || isAsked} onClick={() => setAsking(true)}>
        {queueText.cancel}
      </Button>
      {job.state === "plotting" && <StopButton job={job} isOff={isOff} />}
    </div>
  );
  if (!isAsked) return buttons;
  // The question lies beside the buttons, over the sheet, so that nothing moves and the plot can still be stopped at once.
  return (
    <div className="job-asking">
      {buttons}
      <AskToCancel job={job} onKeep={() => setAsking(false)} />
    </div>
  );
};

const MainButton = ({ job, isAsked }: { job: Job; isAsked: boolean }) => {
  const { actOnJob } = useActions();
  const action = usePageState((state) => mainActionOf(state, job));
  const isOff = usePageState((state) => action !== null && isMainActionOff(state, job, action));
  const isWaitingForTick = usePageState((state) => action !== null && isLocked(state, job, action));
  if (action === null) return null;
  return (
    <Button
      title={isWaitingForTick ? words.tickFirst : undefined}
      kind={job.state === "plotting" ? "plain" : "primary"}
      disabled={isOff || isAsked}
      onClick={() => void actOnJob(job.id, action)}
    >
      <Icon name={action === "pause" ? "pause" : "play"} />
      {penWait(job) !== null ? words.continue : words[action]}
    </Button>
  );
};

const StopButton = ({ job, isOff }: { job: Job; isOff: boolean }) => {
  const { actOnJob } = useActions();
  const takesMs = usePageState(
    ({ plotters }) => plotters.find(({ id }) => id === job.plotterId)?.emergencyStopMs ?? null,
  );
  return (
    <Button
      kind="danger"
      disabled={isOff}
      title={words.stopNowHint(takesMs)}
      onClick={() => void actOnJob(job.id, "emergency-stop")}
    >
      {words.stopNow}
    </Button>
  );
};

const AskToCancel = ({ job, onKeep }: { job: Job; onKeep(): void }) => {
  const { actOnJob } = useActions();
  return (
    <div className="ask" role="alertdialog" aria-label={queueText.cancel}>
      <p>{words.confirmCancel(job.name)}</p>
      <div className="button-row">
        <Button kind="danger" onClick={() => void actOnJob(job.id, "cancel")}>
          {words.cancelPlot}
        </Button>
        {/* Has the focus, so that a key pressed twice does not cancel the plot. */}
        <Button autoFocus onClick={onKeep}>
          {words.keepPlotting}
        </Button>
      </div>
    </div>
  );
};
