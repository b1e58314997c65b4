import { DrawnSize } from "../drawing/drawn-size.js";
import { Notices } from "../ui/notices.js";
import { PlotBar } from "../queue/plot-bar.js";
import { PANEL_ID, Rail } from "./rail.js";
import { Strips } from "./strips.js";
import { TopBar } from "./top-bar.js";
import { Preview } from "../preview/preview.js";
import type { PanelName } from "../state/persist.js";
import { openPanel, shownView } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { drawingText } from "../drawing/text.js";
import { railText, skipText } from "./text.js";
import { DropZone } from "../ui/files/drop-zone.js";
import { IconButton } from "../ui/button.js";
import { lazyPart } from "../ui/lazy-part.js";
import { PAGE_ACTIONS } from "./page-actions.js";

const EmptyPaper = lazyPart(async () => (await import("../drawing/empty-paper.js")).EmptyPaper);
const Watch = lazyPart(async () => (await import("../watch/watch.js")).Watch);
/** What is in each panel, loaded when it is first opened. */
const DrawingPanel = lazyPart(async () => (await import("../drawing/drawing.js")).DrawingPanel);
const PaperPanel = lazyPart(async () => (await import("../drawing/paper.js")).PaperPanel);
const LayersAndPens = lazyPart(async () => (await import("./panels.js")).LayersAndPens);
const LinesPanel = lazyPart(async () => (await import("../drawing/lines.js")).LinesPanel);
const SpeedAndPresets = lazyPart(async () => (await import("./panels.js")).SpeedAndPresets);
const PlotterAndSetUp = lazyPart(async () => (await import("./panels.js")).PlotterAndSetUp);
const QueueAndSheets = lazyPart(async () => (await import("./panels.js")).QueueAndSheets);

const OpenPanel = ({ name }: { name: PanelName }) => {
  switch (name) {
    case "drawing":
      return <DrawingPanel />;
    case "paper":
      return <PaperPanel />;
    case "layers":
      return <LayersAndPens />;
    case "lines":
      return <LinesPanel />;
    case "speed":
      return <SpeedAndPresets />;
    case "plotter":
      return <PlotterAndSetUp />;
    case "queue":
      return <QueueAndSheets />;
  }
};
const Pairing = lazyPart(async () => (await import("./pairing.js")).Pairing);
const Camera = lazyPart(async () => (await import("../sharing/camera.js")).Camera);

/** Targets of the skip link: the button that starts or stops a plot, else the part of the page with it. */
const PLOT = [".plot-buttons .button-primary:enabled", "#plot-bar"];
const WATCH = [".status-actions button:enabled", "#plot-status"];

const FIRST_DROP_HINT = [drawingText.dropHere];
const DROP_HINTS = [drawingText.dropReplace, drawingText.dropAdd];

/** Arranges the page: the sheet, the rail with one open panel beside it, and the bar with Plot under it. */
export const App = () => {
  const { openDropped, openPasted, showPanel } = useActions();
  const hasDrawing = usePageState((state) => state.drawing !== null);
  const isEmpty = usePageState(
    (state) => state.drawing === null && !state.isStarting && state.link !== "connecting",
  );
  const isUnpaired = usePageState((state) => state.isUnpaired);
  const view = usePageState(shownView);
  const panel = usePageState(openPanel);
  const isFull = usePageState((state) => state.isFullScreen);
  const isWatching = view === "watch";
  const hasCamera = usePageState((state) => state.view.cameraUrl !== "");
  if (isUnpaired) return <Pairing />;
  return (
    <DropZone hints={hasDrawing ? DROP_HINTS : FIRST_DROP_HINT} onFiles={openDropped} onText={openPasted}>
      <div className="app" data-view={view} data-full={isFull || undefined}>
        <SkipLink isWatching={isWatching} />
        <TopBar />
        <Rail />
        {isFull && hasCamera && (
          <aside className="panel" aria-label={railText.camera}>
            <Camera />
          </aside>
        )}
        {!isFull && panel && (
          <aside id={PANEL_ID} className="panel" aria-label={railText.panel(railText.panels[panel])}>
            <IconButton
              kind="tool"
              icon="close"
              label={railText.close}
              className="panel-close"
              onClick={() => showPanel(null)}
            />
            <OpenPanel name={panel} />
          </aside>
        )}
        <main className="centre">
          <div className="strips">
            <Strips />
          </div>
          {isWatching && <Watch />}
          <div className="paper-area">
            <Preview />
            <DrawnSize />
            {isEmpty && <EmptyPaper />}
            {!isWatching && <Notices />}
          </div>
        </main>
        <PlotBar />
      </div>
      <Dialogs />
    </DropZone>
  );
};

/** For keyboard users: jumps over the header and the settings to the buttons that start or stop a plot. */
const SkipLink = ({ isWatching }: { isWatching: boolean }) => {
  const targets = isWatching ? WATCH : PLOT;
  return (
    <a
      className="skip-link"
      href={targets[1]}
      onClick={(event) => {
        event.preventDefault();
        targets
          .map((target) => document.querySelector<HTMLElement>(target))
          .find(Boolean)
          ?.focus();
      }}
    >
      {isWatching ? skipText.toWatch : skipText.toPlot}
    </a>
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
  gallery: lazyPart(async () => (await import("../gallery/gallery.js")).Gallery),
  library: lazyPart(async () => (await import("../gallery/library.js")).Library),
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
