import type { Job, PlotWait } from "../../src/schema/index.js";
import { mayOperate } from "../state/store.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { penWaitText as words } from "./text.js";
import { JobButtons } from "./job-buttons.js";
import "./jobs.css";

/** Shown when a job waits for another pen: which pen, in its colour, and the buttons. */
export const PenWait = ({ job, wait }: { job: Job; wait: PlotWait }) => (
  <div className="pen-wait" role="group" aria-label={words.title}>
    <PenSwatch color={wait.color} />
    <div className="pen-wait-words">
      <strong>{wait.penName === null ? words.putForLayer(wait.layerName) : words.put(wait.penName)}</strong>
      {wait.penName !== null && <span>{words.layer(wait.layerName)}</span>}
      <Hint job={job} />
    </div>
    <PenButtons job={job} />
    <JobButtons job={job} />
  </div>
);

const usePenIsDown = (job: Job): boolean =>
  usePageState(({ plotters }) => plotters.find(({ id }) => id === job.plotterId)?.penUp === false);

const Hint = ({ job }: { job: Job }) => {
  const continues = usePageState(mayOperate);
  const isDown = usePenIsDown(job);
  if (isDown) return <span className="note">{words.downHint}</span>;
  return <span className="note">{continues ? words.hint : words.watcherHint}</span>;
};

/** Lower the holder, so that the new pen can be set on the paper and clamped, and lift it again. */
const PenButtons = ({ job }: { job: Job }) => {
  const { moveJobPen } = useActions();
  const isDown = usePenIsDown(job);
  const isOffered = usePageState(mayOperate);
  const isOff = !useIsConnected();
  if (!isOffered) return null;
  return (
    <div className="button-row pen-wait-moves" role="group" aria-label={words.moves}>
      {([false, true] as const).map((up) => (
        <Button
          key={String(up)}
          disabled={isOff}
          aria-pressed={up !== isDown}
          onClick={() => void moveJobPen(job.id, up)}
        >
          {up ? words.up : words.down}
        </Button>
      ))}
    </div>
  );
};

/** A picture of a pen in the colour of its ink. */
const PenSwatch = ({ color }: { color: string | null }) => (
  <svg className="pen-swatch" viewBox="0 0 24 48" aria-hidden="true">
    <path d="M6 2h12v26l-4 8h-4l-4-8z" fill={color ?? "transparent"} />
    <path d="M10.500 36h3L12 46z" />
  </svg>
);
