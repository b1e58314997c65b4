import type { Job, PlotWait } from "../../src/schema/index.js";
import { mayOperate } from "../state/store.js";
import { usePageState } from "../state/use-store.js";
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
      <Hint />
    </div>
    <JobButtons job={job} />
  </div>
);

const Hint = () => {
  const continues = usePageState(mayOperate);
  return <span className="note">{continues ? words.hint : words.watcherHint}</span>;
};

/** A picture of a pen in the colour of its ink. */
const PenSwatch = ({ color }: { color: string | null }) => (
  <svg className="pen-swatch" viewBox="0 0 24 48" aria-hidden="true">
    <path d="M6 2h12v26l-4 8h-4l-4-8z" fill={color ?? "transparent"} />
    <path d="M10.500 36h3L12 46z" />
  </svg>
);
