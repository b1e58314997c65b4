/** Actions on the plotter: moves by hand, and its dialogs. */
import { tilesOf } from "../../src/internal.js";
import type { HandMove, BoxMm } from "../../src/schema/index.js";
import { isForOperator, type Page, type PageAction } from "../state/page-action.js";
import {
  activeJob,
  currentPlotter,
  isReady,
  onlySubmits,
  type DialogName,
  type PageState,
} from "../state/store.js";
import { stateText } from "../state/text.js";
import { isUsed } from "../state/used-settings.js";
import { saveFile } from "../ui/files/save-file.js";
import { movesText } from "./hand/text.js";
import { penText, plotterText, whyNoMoveText as why } from "./text.js";
import type { Trajectory } from "../../src/index.js";

const whyNoMove = (state: PageState): string => {
  if (state.link !== "connected") return stateText.notConnected;
  if (activeJob(state) !== null) return movesText.heldOff;
  const connection = currentPlotter(state)?.connection ?? "absent";
  return connection === "idle" ? why.busy : why[connection];
};

const whyNotReady = (state: PageState): string | null => (isReady(state) ? null : whyNoMove(state));

/** Whether moves by hand are disabled: during a plot, and without a plotter. A next move can be asked for during one. */
export const areMovesOff = (state: PageState): boolean => {
  const connection = currentPlotter(state)?.connection;
  return activeJob(state) !== null || (connection !== "idle" && connection !== "busy");
};

const move = (id: string, label: string, words: string, what: HandMove): PageAction => ({
  id,
  label,
  words,
  isOffered: isForOperator,
  whyOff: (state) => (areMovesOff(state) ? whyNoMove(state) : null),
  perform: ({ actions }) => void actions.moveByHand(what),
});

export const HOME: PageAction = {
  ...move("home", penText.home, "go home, origin, zero, return to start", { kind: "home" }),
  whyOff: whyNotReady,
};
export const TEST_LINE: PageAction = {
  ...move("test-line", penText.testLine, "try the pen", { kind: "test-line" }),
  whyOff: whyNotReady,
};
export const MOTORS_OFF: PageAction = {
  id: "motors-off",
  label: penText.motorsOff,
  words: "release the carriage, disable motors, unlock, move by hand",
  isOffered: isForOperator,
  whyOff: whyNotReady,
  perform: ({ actions }) => void actions.motorsOff(),
};
export const isMovingByHand = (state: PageState): boolean =>
  state.link === "connected" && currentPlotter(state)?.activity === "moving";
/** A watcher may stop a move, too. */
export const STOP_MOVE: PageAction = {
  id: "stop-move",
  label: penText.stop,
  words: "halt, abort the move",
  isOffered: ({ store }) => !onlySubmits(store.getState()),
  whyOff: (state) => {
    if (isMovingByHand(state)) return null;
    return state.link === "connected" ? why.still : stateText.notConnected;
  },
  perform: ({ actions }) => void actions.stopMove(),
};
export const SET_HOME = move("set-home", movesText.setHome, "zero, origin", { kind: "set-home" });
export const CYCLE_PEN = move("cycle-pen", movesText.cyclePen, "pen down and up, servo test", {
  kind: "cycle-pen",
});
export const TEST_PATCH = move("test-patch", movesText.testPatch, "test plot, sample, calibrate", {
  kind: "test-patch",
});

export const TRACE_FRAME: PageAction = {
  ...move("frame", movesText.frame, "bounds, outline, check the paper", { kind: "home" }),
  whyOff: (state) => {
    if (areMovesOff(state)) return whyNoMove(state);
    if (tilesOf(state.settings.prepare).length > 1) return why.oneSheet;
    return state.planned && state.planned.strokeCount > 0 ? null : why.nothingDrawn;
  },
  perform: ({ store, actions }) => {
    const { planned } = store.getState();
    const boxMm = planned && boxOfDrawn(planned.trajectory);
    if (boxMm) void actions.moveByHand({ kind: "frame", boxMm });
  },
};

/** A plotter that the page itself opens the port of. */
const mayConnect = ({ store, backend: { features } }: Page): boolean => {
  const state = store.getState();
  const plotter = currentPlotter(state);
  const isSought = plotter?.kind === "virtual" || plotter?.connection === "absent";
  return features.asksForPort && features.whyNoPort === null && isSought;
};
export const CONNECT: PageAction = {
  id: "connect",
  label: plotterText.connect,
  words: "usb, serial port, axidraw",
  isOffered: (page) => isForOperator(page) && mayConnect(page),
  perform: ({ store, actions }) => {
    const plotter = currentPlotter(store.getState());
    if (plotter) void actions.connectPlotter(plotter.id);
  },
};

const dialog = (name: DialogName, label: string, words: string): PageAction => ({
  id: name,
  label,
  words,
  isOffered: isForOperator,
  perform: ({ actions }) => actions.openDialog(name),
});
export const SET_UP = dialog("wizard", plotterText.setUp, "wizard, servo, calibrate, new machine, direction");
export const MACHINES_DIALOG = dialog(
  "machines",
  plotterText.profiles,
  "model, profile, custom machine, size",
);
export const RINGING: PageAction = {
  ...dialog("ringing", plotterText.ringing, "resonance, vibration, wobble, input shaper"),
  isOffered: (page) => isForOperator(page) && isUsed(page.store.getState(), "motion.shaper"),
};
export const CONSOLE = dialog("console", plotterText.console, "commands, terminal, ebb, serial");

export const SAVE_LOG: PageAction = {
  id: "log",
  label: plotterText.log,
  words: "debug, report a problem",
  isOffered: ({ store }) => !onlySubmits(store.getState()) && currentPlotter(store.getState()) !== null,
  perform: ({ store, backend, actions }) => {
    const plotter = currentPlotter(store.getState());
    if (!plotter) return;
    void actions
      .attempt("log", () => backend.plotters.log(plotter.id))
      .then((log) => {
        if (log !== null) saveFile(`plotwright-${plotter.id}.log`, log, "text/plain");
      });
  },
};

export const PLOTTER_ACTIONS: readonly PageAction[] = [
  HOME,
  MOTORS_OFF,
  STOP_MOVE,
  TEST_LINE,
  SET_HOME,
  CYCLE_PEN,
  TRACE_FRAME,
  TEST_PATCH,
  CONNECT,
  SET_UP,
  MACHINES_DIALOG,
  RINGING,
  CONSOLE,
  SAVE_LOG,
];

/**
 * The box around the ends of all blocks with the pen down. Exact for straight lines; for curves within the tolerance of
 * their flattening. A run ends where the next one begins. Null if there is nothing to draw.
 */
export const boxOfDrawn = ({ runs, x, y, blockCount, endX, endY }: Trajectory): BoxMm | null => {
  let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
  const take = (px: number, py: number): void => {
    minX = Math.min(minX, px);
    maxX = Math.max(maxX, px);
    minY = Math.min(minY, py);
    maxY = Math.max(maxY, py);
  };
  for (let r = 0; r < runs.count; r++) {
    if (runs.stroke[r] < 0) continue;
    for (let b = runs.firstBlock[r]; b <= runs.firstBlock[r + 1]; b++) {
      if (b < blockCount) take(x[b], y[b]);
      else take(endX, endY);
    }
  }
  return minX > maxX ? null : { xMm: minX, yMm: minY, widthMm: maxX - minX, heightMm: maxY - minY };
};
