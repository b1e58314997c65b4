/** Mounts the page. The only file with side effects on import. */
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { createPageBackend } from "../backend/page-backend.js";
import { App } from "./app.js";
import { Crash } from "./crash.js";
import { keepPage, lookForUpdate } from "../pwa/register.js";
import { createActions } from "../state/actions.js";
import { replanForBoard } from "../plotter/board-watch.js";
import { browserDrawings, keepDrawing, readKeptDrawing } from "../drawing/kept-drawing.js";
import { readRemembered, writeRemembered, type TextStore } from "../state/persist.js";
import { showNotification, watchJobs } from "../queue/notify.js";
import { Player } from "../preview/player.js";
import { listenForShortcuts, shortcutsFor } from "./shortcuts.js";
import { applyServerEvent } from "../state/server-events.js";
import { createPageStore } from "../state/store.js";
import { openWatch } from "../state/open-watch.js";
import { PageContext } from "../state/use-store.js";
import { appName, errorText } from "../ui/text.js";
import { ErrorBoundary } from "../ui/error-boundary.js";
import { saveFile } from "../ui/save-file.js";
import { openPlanner } from "../worker/planner.js";
import "./index.css";

const storage = ((): TextStore | null => {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
})();

const EXPORTED = {
  svg: { ending: "svg", type: "image/svg+xml" },
  json: { ending: "json", type: "application/json" },
  commands: { ending: "commands.txt", type: "text/plain" },
};

/** Reset with each new plan, because its times and positions differ. */
const NOTHING_SELECTED = { momentS: null, isPlaying: false, hover: null, noteBoxes: [] };

const remembered = readRemembered(storage);
const store = createPageStore(remembered);
const planner = openPlanner({
  onImported: (drawingKey) => actions.noteRead(drawingKey),
  onPlanned: (planned) => store.setState({ planned, isPlanning: false, fault: null, ...NOTHING_SELECTED }),
  onExported: (format, exported) => {
    const name = store.getState().drawing?.name ?? appName;
    saveFile(`${name}.${EXPORTED[format].ending}`, exported, EXPORTED[format].type);
  },
  onExportFailed: (message) => actions.notify("error", message),
  onFault: (fault) => {
    if (actions.wentBack(fault)) return;
    store.setState({ fault, isPlanning: false, planned: null, ...NOTHING_SELECTED });
  },
});
const backend = createPageBackend();
const actions = createActions({
  store,
  backend,
  planner,
  nowMs: () => performance.now(),
  after: (delayMs, callback) => void setTimeout(callback, delayMs),
});

const drawings = browserDrawings();
keepRemembered();
keepDrawing(store, drawings, () => actions.notify("error", errorText.notKept));
const player = new Player(store);
const shortcuts = shortcutsFor({ store, actions, player });
listenForShortcuts(shortcuts);
watchJobs(store, (sentence, { state }) => {
  // A waiting or interrupted job is shown on the page anyway, until the user answers.
  if (state === "done" || state === "failed") actions.notify(state === "done" ? "info" : "error", sentence);
  void showNotification(sentence);
});
keepPage(() => store.setState({ isOutdated: true }));
backend.listen({
  onEvent: (event) => store.setState((state) => applyServerEvent(state, event)),
  onLink: (isConnected) => {
    store.setState({ link: isConnected ? "connected" : "lost" });
    if (isConnected || !store.getState().isUnpaired) void actions.meet();
    if (isConnected) void lookForUpdate();
  },
});
replanForBoard(store, actions.replan);
openWatch(store);
followPlotter();
void greet();

const root = document.getElementById("root");
if (!root) throw new Error("index.html has no #root");
createRoot(root).render(
  <StrictMode>
    <ErrorBoundary fallback={(message) => <Crash message={message} />}>
      <PageContext value={{ store, backend, actions }}>
        <App player={player} shortcuts={shortcuts} />
      </PageContext>
    </ErrorBoundary>
  </StrictMode>,
);

/** Stores settings and view for the next visit. Sets the theme on the root element, where the style sheet reads it. */
function keepRemembered(): void {
  let timer: ReturnType<typeof setTimeout> | null = null;
  const showTheme = (): void => {
    document.documentElement.dataset.theme = store.getState().view.theme;
  };
  showTheme();
  store.subscribe((state, before) => {
    if (state.view.theme !== before.view.theme) showTheme();
    if (state.settings === before.settings && state.view === before.view) return;
    if (timer !== null) clearTimeout(timer);
    timer = setTimeout(write, 300);
  });
  const write = (): void => {
    timer = null;
    writeRemembered(storage, store.getState());
  };
  window.addEventListener("pagehide", () => {
    if (timer !== null) write();
  });
}

/** Model, heights, pens and presets belong to the plotter. */
function followPlotter(): void {
  store.subscribe((state, before) => {
    const { plotters, plotterId, plotterSettings, machines } = state;
    const hasChanged =
      plotters !== before.plotters ||
      plotterId !== before.plotterId ||
      plotterSettings !== before.plotterSettings ||
      machines !== before.machines;
    if (hasChanged) actions.followPlotter();
  });
}

/** Restores the last drawing, if there is one, and loads the rest once the server has answered. */
async function greet(): Promise<void> {
  const kept = await readKeptDrawing(drawings);
  if (kept && store.getState().drawing === null) actions.restoreDrawing(kept);
  store.setState({ isStarting: false });
  await connected();
  await actions.loadSamples();
  actions.takeJobSettings();
}

const connected = (): Promise<void> =>
  new Promise((resolve) => {
    const check = (): void => {
      if (store.getState().link !== "connected") return;
      stop();
      resolve();
    };
    const stop = store.subscribe(check);
    check();
  });
