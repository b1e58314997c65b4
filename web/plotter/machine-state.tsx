import type { Job, Plotter } from "../../src/schema/index.js";
import { currentPlotter, unfinishedJob, type ServerLink } from "../state/store.js";
import { usePageState } from "../state/use-store.js";
import { plotterText as words } from "./text.js";
import { formatPercent } from "../ui/format.js";
import { lampOf, plotterWords } from "./machine-words.js";

/** The plotter's state in one line with a lamp, always visible. */
export const MachineState = () => {
  const link = usePageState((state) => state.link);
  const plotter = usePageState(currentPlotter);
  const job = usePageState(unfinishedJob);
  const isKnown = link === "connected" && plotter !== null;
  return (
    <p
      className="machine-state"
      data-lamp={isKnown ? lampOf(plotter, job) : link === "lost" ? "fault" : "connecting"}
    >
      <span className="lamp" aria-hidden="true" />
      <span role="status">{stateWords(link, plotter, job)}</span>
      {/* Changes several times a second, so screen readers must not announce it. */}
      {isKnown && job && <span className="machine-share">{formatPercent(job.progress)}</span>}
    </p>
  );
};

const stateWords = (link: ServerLink, plotter: Plotter | null, job: Job | null): string => {
  if (link === "lost") return words.server.lost;
  if (link === "connecting" || !plotter) return words.server.connecting;
  const state = plotterWords(plotter, job);
  if (job) return words.jobState(state, job.name);
  if (plotter.kind === "virtual") return words.virtual;
  return `${plotter.name}: ${state}`;
};
