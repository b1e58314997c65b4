/** All actions of the page, in the order of the list of shortcuts and of the search. */
import { drawingText } from "../drawing/text.js";
import { PLOTTER_ACTIONS } from "../plotter/plotter-actions.js";
import { PREVIEW_ACTIONS } from "../preview/preview-actions.js";
import { PLOT_ACTIONS } from "../queue/plot-actions.js";
import { isForOperator, isForSubmitter, type PageAction } from "../state/page-action.js";
import { THEMES, type Theme } from "../state/persist.js";
import { shownView, type PageState, type PageView } from "../state/store.js";
import {
  aboutText,
  historyText,
  searchLabel,
  shortcutsText,
  sharingLink,
  themeText,
  viewText,
} from "./text.js";

export const UNDO: PageAction = {
  id: "undo",
  label: historyText.undo,
  words: "back, revert",
  key: "Ctrl Z",
  repeats: true,
  isForDrawing: true,
  whyOff: ({ undoStack }) => (undoStack.length > 0 ? null : historyText.nothingToUndo),
  perform: ({ actions }) => actions.undo(),
};
export const REDO: PageAction = {
  id: "redo",
  label: historyText.redo,
  key: "Ctrl Shift Z",
  repeats: true,
  isForDrawing: true,
  whyOff: ({ redoStack }) => (redoStack.length > 0 ? null : historyText.nothingToRedo),
  perform: ({ actions }) => actions.redo(),
};

const showView = (view: PageView): PageAction => ({
  id: view,
  label: viewText.show[view],
  isOffered: isForSubmitter,
  whyOff: (state) => (shownView(state) === view ? viewText.isShown : null),
  perform: ({ actions }) => actions.showView(view),
});

export const SHARING: PageAction = {
  id: "sharing",
  label: sharingLink,
  words: "network, phone, pair, link, qr code, webcam, webhook, password",
  isOffered: (page) => isForOperator(page) && page.backend.features.sharing,
  perform: ({ actions }) => actions.openDialog("sharing"),
};

const GALLERY: PageAction = {
  id: "gallery",
  label: viewText.gallery,
  words: "history, finished, done, archive, plotted, sheets",
  perform: ({ actions }) => actions.openDialog("gallery"),
};

const LIBRARY: PageAction = {
  id: "library",
  label: drawingText.library,
  words: "folders, files, stored drawings, open, save",
  isOffered: (page) => isForOperator(page) && page.backend.features.library,
  perform: ({ actions }) => actions.openDialog("library"),
};

const nextTheme = ({ view }: PageState): Theme =>
  THEMES[(THEMES.indexOf(view.theme) + 1) % THEMES.length] ?? "auto";
export const THEME: PageAction = {
  id: "theme",
  label: ({ view }) => `${themeText.label}: ${themeText[view.theme]}`,
  words: "dark mode, light mode, night, colours",
  perform: ({ store, actions }) => actions.changeView({ theme: nextTheme(store.getState()) }),
};

export const SEARCH: PageAction = {
  id: "search",
  label: searchLabel,
  key: "Ctrl K",
  worksInFields: true,
  perform: ({ actions }) => actions.toggleDialog("search"),
};
export const SHORTCUTS: PageAction = {
  id: "keys",
  label: shortcutsText.title,
  words: "help, keys, hotkeys",
  key: "?",
  perform: ({ actions }) => actions.toggleDialog("keys"),
};
const ABOUT: PageAction = {
  id: "about",
  label: aboutText.title,
  words: "version, licence, license",
  perform: ({ actions }) => actions.openDialog("about"),
};

export const PAGE_ACTIONS: readonly PageAction[] = [
  ...PLOT_ACTIONS,
  UNDO,
  REDO,
  ...PREVIEW_ACTIONS,
  ...PLOTTER_ACTIONS,
  showView("prepare"),
  showView("watch"),
  GALLERY,
  LIBRARY,
  SHARING,
  THEME,
  SEARCH,
  SHORTCUTS,
  ABOUT,
];
