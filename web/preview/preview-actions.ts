/** Actions on the preview and the place of the drawing. */
import { boxAround, layoutOfFrame } from "../scene/placing.js";
import { isForSubmitter, type PageAction } from "../state/page-action.js";
import { currentPlotter, type PageState } from "../state/store.js";
import { previewText, timeLineText } from "./text.js";

const needsPlan: PageAction["whyOff"] = ({ planned }) => (planned ? null : previewText.needsDrawing);

export const PLAY: PageAction = {
  id: "play",
  label: ({ isPlaying }) => (isPlaying ? timeLineText.pause : timeLineText.play),
  words: "simulate, animate, preview",
  key: "Space",
  isForDrawing: true,
  whyOff: needsPlan,
  perform: ({ actions }) => actions.togglePlaying(),
};
export const TRAVEL: PageAction = {
  id: "travel",
  label: previewText.travel,
  words: "travel moves, show or hide",
  key: "T",
  isForDrawing: true,
  perform: ({ store, actions }) => actions.changeView({ showTravel: !store.getState().view.showTravel }),
};
export const GRAPH: PageAction = {
  id: "graph",
  label: timeLineText.graph,
  words: "chart, show or hide",
  key: "G",
  isForDrawing: true,
  perform: ({ store, actions }) => actions.changeView({ showGraph: !store.getState().view.showGraph }),
};

/** Places the drawing by hand, with handles around it. A second press fits the drawing to the paper again. */
export const PLACE: PageAction = {
  id: "place",
  label: previewText.place,
  words: "move, drag, scale, resize, position",
  isForDrawing: true,
  isOffered: isForSubmitter,
  whyOff: ({ planned, drawing }) => {
    if (drawing?.sheet) return previewText.placesEach;
    return planned?.frameMm ? null : previewText.needsDrawing;
  },
  perform: ({ store, actions }) => {
    const { planned, settings } = store.getState();
    const frame = planned?.frameMm ?? null;
    const layout = settings.prepare.layout !== null || !frame ? null : layoutOfFrame(frame);
    actions.changeSettings("place by hand", (now) => ({ ...now, prepare: { ...now.prepare, layout } }));
  },
};

/** Moves the drawing: the upper left corner of its box is then where the carriage is. */
export const START_HERE: PageAction = {
  id: "start-here",
  label: previewText.startHere,
  words: "origin, corner, place at the carriage, position of the pen",
  isForDrawing: true,
  isOffered: isForSubmitter,
  whyOff: (state) => {
    if (state.drawing?.sheet) return previewText.placesEach;
    if (!state.planned?.frameMm) return previewText.needsDrawing;
    const plotter = state.link === "connected" ? currentPlotter(state) : null;
    return plotter && plotter.xMm !== null && plotter.yMm !== null ? null : previewText.needsPosition;
  },
  perform: ({ store, actions }) => {
    const state = store.getState();
    const frame = state.planned?.frameMm;
    const { xMm, yMm } = currentPlotter(state) ?? { xMm: null, yMm: null };
    if (!frame || xMm === null || yMm === null) return;
    const box = boxAround(frame);
    const layout = layoutOfFrame({
      ...frame,
      xMm: frame.xMm + xMm - box.x0,
      yMm: frame.yMm + yMm - box.y0,
    });
    actions.changeSettings("start here", (now) => ({ ...now, prepare: { ...now.prepare, layout } }));
  },
};

const needsPiece = ({ drawing, selectedPieces }: PageState): string | null =>
  drawing?.sheet?.pieces.some(({ id }) => selectedPieces.includes(id)) ? null : previewText.needsPiece;

const DUPLICATE: PageAction = {
  id: "duplicate-piece",
  label: previewText.duplicatePiece,
  words: "copy, n-up, repeat",
  key: "D",
  isForDrawing: true,
  isOffered: isForSubmitter,
  whyOff: needsPiece,
  perform: ({ actions }) => void actions.duplicatePieces(),
};

const REMOVE: PageAction = {
  id: "remove-piece",
  label: previewText.removePiece,
  words: "delete, erase",
  key: "Delete",
  isForDrawing: true,
  isOffered: isForSubmitter,
  whyOff: (state) => {
    const { drawing, selectedPieces } = state;
    const areAll = drawing?.sheet?.pieces.every(({ id }) => selectedPieces.includes(id));
    return areAll ? previewText.keepsOne : needsPiece(state);
  },
  perform: ({ actions }) => void actions.removePieces(),
};

const TURN_PAPER: PageAction = {
  id: "turn-paper",
  label: previewText.turnPaper,
  words: "landscape, portrait, rotate, orientation",
  isForDrawing: true,
  isOffered: isForSubmitter,
  perform: ({ actions }) =>
    actions.changeSettings("orientation", (now) => ({
      ...now,
      prepare: { ...now.prepare, landscape: !now.prepare.landscape },
    })),
};

/** Turns the picture of sheet and drawing, not the plot. */
export const TURN_DESK: PageAction = {
  id: "turn-desk",
  label: previewText.turnDesk,
  words: "rotate the view, compass, upright, portrait",
  perform: ({ store, actions }) => actions.changeView({ deskTurn: (store.getState().view.deskTurn + 1) % 4 }),
};

export const PREVIEW_ACTIONS: readonly PageAction[] = [
  PLAY,
  TRAVEL,
  GRAPH,
  PLACE,
  START_HERE,
  DUPLICATE,
  REMOVE,
  TURN_PAPER,
  TURN_DESK,
];
