import { currentPlotter, maySubmit, shownView, unfinishedJob, type ServerLink } from "../state/store.js";
import type { Theme } from "../state/persist.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ActionButton } from "../ui/action-button.js";
import { appName } from "../ui/text.js";
import { REDO, SEARCH, SHORTCUTS, SHARING, THEME, UNDO } from "./page-actions.js";
import { viewText } from "./text.js";
import { plotterText as words } from "../plotter/text.js";
import type { IconName } from "../ui/icon.js";
import type { Job, Plotter } from "../../src/schema/index.js";
import { formatPercent } from "../ui/format.js";
import { lampOf, plotterWords } from "../plotter/machine-words.js";

const THEME_ICON: Record<Theme, IconName> = { auto: "auto", light: "sun", dark: "moon" };

export const TopBar = () => {
  const isPreparing = usePageState((state) => shownView(state) === "prepare");
  return (
    <header className="top-bar">
      <h1 className="wordmark" aria-label={appName}>
        <Mark />
        <span>{appName}</span>
      </h1>
      <ViewSwitch />
      <PlotterSwitch />
      <MachineState />
      <div className="top-tools">
        <ActionButton action={SEARCH} kind="tool" icon="search" />
        {isPreparing && <ActionButton action={UNDO} kind="tool" icon="undo" />}
        {isPreparing && <ActionButton action={REDO} kind="tool" icon="redo" />}
        <ActionButton action={SHARING} kind="tool" icon="share" />
        <ThemeButton />
        <ActionButton action={SHORTCUTS} kind="tool" icon="help" />
      </div>
    </header>
  );
};

/** Switches between Prepare and Watch. Not shown to a watcher, who has only Watch. */
const ViewSwitch = () => {
  const view = usePageState((state) => state.pageView);
  const isShown = usePageState(maySubmit);
  const { showView } = useActions();
  if (!isShown) return null;
  return (
    <div className="view-switch" role="group" aria-label={viewText.label}>
      {(["prepare", "watch"] as const).map((name) => (
        <button key={name} type="button" aria-pressed={view === name} onClick={() => showView(name)}>
          {viewText[name]}
        </button>
      ))}
    </div>
  );
};

/** The sign of plotwright. */
export const Mark = () => (
  <svg className="mark" viewBox="0 0 32 32" aria-hidden="true">
    <path d="M5 24c4.5-16 8-16 10-6.5S21 22.500 25.500 8.500" />
    <circle cx="26" cy="7" r="3" />
  </svg>
);

/** Chooses the plotter that the page shows and sends to. Not shown when there is only one. */
const PlotterSwitch = () => {
  const plotters = usePageState((state) => state.plotters);
  const current = usePageState(currentPlotter);
  const { choosePlotter } = useActions();
  if (plotters.length < 2 || !current) return null;
  return (
    <select
      className="plotter-switch"
      aria-label={words.which}
      value={current.id}
      onChange={(event) => choosePlotter(event.target.value)}
    >
      {plotters.map(({ id, name }) => (
        <option key={id} value={id}>
          {name}
        </option>
      ))}
    </select>
  );
};

const ThemeButton = () => {
  const theme = usePageState((state) => state.view.theme);
  return <ActionButton action={THEME} kind="tool" icon={THEME_ICON[theme]} />;
};

/** The plotter's state in one line with a lamp, always visible. */
const MachineState = () => {
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
