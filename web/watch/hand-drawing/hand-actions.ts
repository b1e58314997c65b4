/** Actions on the drawing that is made by hand. They are not among those of the whole page: they are loaded with it. */
import { isPressed, performByKey, type Page, type PageAction } from "../../state/page-action.js";
import { shownView } from "../../state/store.js";
import { handDrawingOf } from "./hand-drawing.js";
import { drawText as words } from "./text.js";

export const UNDO_STROKE: PageAction = {
  id: "undo-stroke",
  label: words.undo,
  key: "Ctrl Z",
  isOffered: ({ store }) => shownView(store.getState()) === "watch",
  whyOff: (state) => {
    const drawing = handDrawingOf(state);
    const isOn = drawing?.phase === "ready" && drawing.canUndo && state.openDialog === null;
    return isOn ? null : words.nothingToUndo;
  },
  perform: ({ store }) => void handDrawingOf(store.getState())?.pen.undo(),
};

export const FINISH_DRAWING: PageAction = {
  id: "finish-drawing",
  label: (state) => (handDrawingOf(state)?.jobId === null ? words.leave : words.finish),
  whyOff: (state) => (handDrawingOf(state)?.phase === "ready" ? null : words.finishing),
  perform: ({ store }) => handDrawingOf(store.getState())?.pen.finish(),
};

/** Ctrl Z takes back a stroke, except in a field, which has its own steps back. Returns a function that stops listening. */
export const listenForUndo = (page: Page): (() => void) => {
  const listen = (event: KeyboardEvent): void => {
    if (isPressed(UNDO_STROKE, event) && !(event.target instanceof HTMLInputElement))
      performByKey(UNDO_STROKE, page);
  };
  document.addEventListener("keydown", listen);
  return () => document.removeEventListener("keydown", listen);
};
