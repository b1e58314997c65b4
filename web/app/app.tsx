import { DrawingPanel } from "../drawing/drawing.js";
import { DrawnSize } from "../drawing/drawn-size.js";
import { LayersPanel } from "../layers/layers.js";
import { LinesPanel } from "../drawing/lines.js";
import { MachinePanel, MachineSetUp, PresetsPanel } from "../plotter/machine.js";
import { MotionPanel } from "../motion/motion.js";
import { Notices } from "../ui/notices.js";
import { PaperPanel } from "../drawing/paper.js";
import { PenPanel, PensPanel } from "../pens/pens.js";
import { PlotBar } from "../queue/plot-bar.js";
import { HistoryPanel, QueuePanel } from "../queue/queue.js";
import { Strips } from "./strips.js";
import { TopBar } from "./top-bar.js";
import { Preview } from "../preview/preview.js";
import { TimeLine } from "../preview/time-line.js";
import { shownView, TABS, unfinishedJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { drawingText } from "../drawing/text.js";
import { skipText, tabsText } from "./text.js";
import { DropZone } from "../ui/files/drop-zone.js";
import { lazyPart } from "../ui/lazy-part.js";
import { PAGE_ACTIONS } from "./page-actions.js";

const EmptyPaper = lazyPart(async () => (await import("../drawing/empty-paper.js")).EmptyPaper);
const Watch = lazyPart(async () => (await import("../watch/watch.js")).Watch);
const Adjust = lazyPart(async () => (await import("../watch/adjust.js")).Adjust);
const Pairing = lazyPart(async () => (await import("./pairing.js")).Pairing);
const Camera = lazyPart(async () => (await import("../sharing/camera.js")).Camera);

/** Targets of the skip link. */
const PLOT_ID = "plot-bar";
const WATCH_ID = "plot-status";

/** Arranges the panels. On a narrow screen the side columns become tabs under the paper. */
export const App = () => {
  const tab = usePageState((state) => state.tab);
  const { openFile, openPasted } = useActions();
  const hasCamera = usePageState((state) => state.view.cameraUrl !== "");
  const isEmpty = usePageState(
    (state) => state.drawing === null && !state.isStarting && state.link !== "connecting",
  );
  const isUnpaired = usePageState((state) => state.isUnpaired);
  const view = usePageState(shownView);
  const isFull = usePageState((state) => state.isFullScreen);
  const isWatching = view === "watch";
  const hasJob = usePageState((state) => unfinishedJob(state) !== null);
  const machine = (
    <div className="tab-machine">
      {!isWatching && hasCamera && <Camera />}
      <MachinePanel />
    </div>
  );
  if (isUnpaired) return <Pairing />;
  return (
    <DropZone hint={drawingText.dropHere} onFile={openFile} onText={openPasted}>
      <div className="app" data-tab={tab} data-view={view} data-full={isFull || undefined}>
        <SkipLink isWatching={isWatching} />
        <TopBar />
        <main className="centre">
          <Strips />
          {isWatching && <Watch />}
          <div className="paper-area">
            <Preview />
            <DrawnSize />
            {isEmpty && <EmptyPaper />}
            {!isWatching && <Notices />}
          </div>
          {!isWatching && <TimeLine />}
        </main>
        <Tabs />
        <aside className="column column-setup" aria-label={tabsText.setup}>
          <DrawingPanel />
          <PaperPanel />
          <LayersPanel>
            <PensPanel />
          </LayersPanel>
          <LinesPanel />
          <MotionPanel />
          <PresetsPanel />
        </aside>
        <aside className="column column-run" aria-label={tabsText.queue}>
          <PlotBar />
          {isWatching && hasCamera && <Camera />}
          {isWatching && <Adjust />}
          {/* Before a plot the plotter's panel comes first, during one the queue. */}
          {!hasJob && machine}
          <div className="tab-queue">
            <QueuePanel />
          </div>
          {hasJob && machine}
          <div className="tab-machine">
            <MachineSetUp>
              <PenPanel />
            </MachineSetUp>
          </div>
          <div className="tab-queue">
            <HistoryPanel />
          </div>
        </aside>
      </div>
      <Dialogs />
    </DropZone>
  );
};

/** For keyboard users: jumps over the header and the settings to the buttons that start or stop a plot. */
const SkipLink = ({ isWatching }: { isWatching: boolean }) => {
  const target = isWatching ? WATCH_ID : PLOT_ID;
  return (
    <a
      className="skip-link"
      href={`#${target}`}
      onClick={(event) => {
        event.preventDefault();
        document.getElementById(target)?.focus();
      }}
    >
      {isWatching ? skipText.toWatch : skipText.toPlot}
    </a>
  );
};

const Tabs = () => {
  const tab = usePageState((state) => state.tab);
  const { showTab } = useActions();
  return (
    <nav className="tabs" aria-label={tabsText.label}>
      {TABS.map((name) => (
        <button
          key={name}
          type="button"
          aria-current={name === tab ? "page" : undefined}
          onClick={() => showTab(name)}
        >
          {tabsText[name]}
        </button>
      ))}
    </nav>
  );
};

const TakeOver = lazyPart(async () => (await import("./take-over.js")).TakeOver);
const Search = lazyPart(async () => (await import("../search/search.js")).Search);
const DIALOGS = {
  keys: lazyPart(async () => (await import("./help.js")).HelpSheet),
  about: lazyPart(async () => (await import("./help.js")).AboutDialog),
  wizard: lazyPart(async () => (await import("../plotter/wizard/wizard.js")).Wizard),
  machines: lazyPart(async () => (await import("../plotter/machines/machines-dialog.js")).MachinesDialog),
  console: lazyPart(async () => (await import("../plotter/console/console.js")).Console),
  ringing: lazyPart(async () => (await import("../ringing/ringing.js")).RingingDialog),
  sharing: lazyPart(async () => (await import("../sharing/sharing-dialog.js")).SharingDialog),
} as const;

/** The open dialog, if any. The question is shown over it, so that what was typed into the dialog is kept. */
const Dialogs = () => {
  const question = usePageState((state) => state.takeOverQuestion);
  return (
    <>
      <OpenDialog />
      {question && <TakeOver question={question} />}
    </>
  );
};

const OpenDialog = () => {
  const name = usePageState((state) => state.openDialog);
  if (name === null) return null;
  if (name === "search") return <Search actions={PAGE_ACTIONS} />;
  const Named = DIALOGS[name];
  return <Named />;
};
