/** Opens drawing by hand. Not among the actions of the whole page, because the first view has no button for it. */
import { HOME } from "../plotter/plotter-actions.js";
import { isForOperator, whyOff, type PageAction } from "../state/page-action.js";
import { watchText as words } from "./text.js";

export const DRAW: PageAction = {
  id: "draw",
  label: words.draw,
  words: "sketch, freehand, finger, stylus, by hand",
  isOffered: isForOperator,
  whyOff: (state) => whyOff(HOME, state),
  perform: ({ store, actions }) => {
    actions.showView("watch");
    store.setState(({ handDrawing }) => ({ handDrawing: handDrawing ?? "opening" }));
  },
};
