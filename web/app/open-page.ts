/** Puts the page together: the store, its actions, the planner, the backend, and what follows their changes. */
import { createPageBackend } from "../backend/page-backend.js";
import { browserDrawings, keepDrawing, readKeptDrawing } from "../drawing/kept-drawing.js";
import { replanForBoard } from "../plotter/board-watch.js";
import { keepPage, lookForUpdate } from "../pwa/register.js";
import { showNotification, watchJobs } from "../queue/notify.js";
import { createActions } from "../state/actions.js";
import { openWatch } from "../state/open-watch.js";
import type { Page } from "../state/page-action.js";
import { readRemembered, writeRemembered, type TextStore } from "../state/persist.js";
import { applyServerEvent } from "../state/server-events.js";
import { createPageStore } from "../state/store.js";
import { saveFile } from "../ui/files/save-file.js";
import { appName, errorText } from "../ui/text.js";
import { openPlanner } from "../worker/planner.js";
import { listenForShortcuts } from "./shortcuts.js";

const EXPORTED = {
  svg: { ending: "svg", type: "image/svg+xml" },
  json: { ending: "json", type: "application/json" },
  commands: { ending: "commands.txt", type: "text/plain" },
};

/** As in the styles. */
const NARROW = "(max-width: 880px)";

const openStorage = (): TextStore | null => {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
};

export function openPage(): Page {
  const storage = openStorage();
  const store = createPageStore(readRemembered(storage));
  // There the panel covers a part of the sheet, so the page begins without one.
  if (matchMedia(NARROW).matches) {
    store.setState(({ view }) => ({ view: { ...view, panel: null }, watchPanel: null }));
  }
  const planner = openPlanner({
    onImported: (drawingKey) => actions.noteRead(drawingKey),
    onPlanned: (planned) => {
      actions.showPlan(planned);
      opening.planned(planned.drawingKey);
    },
    onExported: (format, exported) => {
      const name = store.getState().drawing?.name ?? appName;
      saveFile(`${name}.${EXPORTED[format].ending}`, exported, EXPORTED[format].type);
    },
    onExportFailed: (message) => actions.notify("error", message),
    onFault: (fault) => {
      if (!actions.revertedAfterFault(fault)) actions.showFault(fault);
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
  const page = { store, backend, actions };
  const opening = drawItselfOnOpening(page);

  const drawings = browserDrawings();
  keepRemembered(page, storage);
  keepDrawing(store, drawings, () => actions.notify("error", errorText.notKept));
  listenForShortcuts(page);
  // Not needed for the first view.
  void import("./kept-focus.js").then(({ keepFocus }) => keepFocus()).catch(() => undefined);
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
      if (isConnected || !store.getState().isUnpaired) void actions.loadServerState();
      if (isConnected) void lookForUpdate();
    },
  });
  replanForBoard(store, actions.replan);
  openWatch(store);
  followPlotter(page);
  void restoreSession(page, drawings, opening);
  return page;
}

/** Stores settings and view for the next visit. Sets the theme on the root element, where the style sheet reads it. */
function keepRemembered({ store }: Page, storage: TextStore | null): void {
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

interface Opening {
  /** The drawing has been planned. */
  planned(drawingKey: string): void;
  /** The drawing was on the paper before. */
  seen(drawingKey: string | undefined): void;
}

/** A drawing that is opened draws itself once, until the first click or key. Those of jobs may be half plotted. */
function drawItselfOnOpening({ store, actions }: Page): Opening {
  let seenKey: string | undefined;
  for (const type of ["pointerdown", "keydown", "wheel"]) {
    document.addEventListener(type, () => actions.restAtEnd(), { capture: true, passive: true });
  }
  return {
    seen: (key) => (seenKey = key),
    planned: (key) => {
      const isOpened = key !== seenKey && store.getState().drawing?.jobId === null;
      seenKey = key;
      if (isOpened && !matchMedia("(prefers-reduced-motion: reduce)").matches) actions.drawItself();
    },
  };
}

/** Model, heights, pens and presets belong to the plotter. */
function followPlotter({ store, actions }: Page): void {
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
async function restoreSession(
  { store, actions }: Page,
  drawings: ReturnType<typeof browserDrawings>,
  opening: Opening,
): Promise<void> {
  const kept = await readKeptDrawing(drawings);
  if (kept && store.getState().drawing === null) await actions.restoreDrawing(kept);
  opening.seen(store.getState().drawing?.key);
  store.setState({ isStarting: false });
  await connected(store);
  await actions.loadSamples();
  actions.takeJobSettings();
}

const connected = (store: Page["store"]): Promise<void> =>
  new Promise((resolve) => {
    const check = (): void => {
      if (store.getState().link !== "connected") return;
      stop();
      resolve();
    };
    const stop = store.subscribe(check);
    check();
  });
