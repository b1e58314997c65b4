/**
 * The page's whole state, without React: five slices in one store. Each slice's file has its fields, their first values
 * and what is derived from them alone.
 */
import { createStore } from "zustand/vanilla";
import { findMachine, firmwareFor } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { PANELS, type PanelName, type Remembered } from "./persist.js";
import { DOCUMENT_AT_FIRST, type DocumentSlice } from "./slices/document.js";
import { PLAN_AT_FIRST, type PlanSlice } from "./slices/plan.js";
import { PLAYER_AT_FIRST, type PlayerSlice } from "./slices/player.js";
import {
  currentPlotter,
  maySubmit,
  onlySubmits,
  SERVER_AT_FIRST,
  unfinishedJob,
  type ServerSlice,
} from "./slices/server.js";
import { UI_AT_FIRST, type PageView, type UiSlice } from "./slices/ui.js";

export type * from "./slices/document.js";
export * from "./slices/plan.js";
export * from "./slices/server.js";
export * from "./slices/ui.js";

export type PageState = DocumentSlice & PlanSlice & PlayerSlice & ServerSlice & UiSlice;

export const createPageStore = ({ settings, view }: Remembered) =>
  createStore<PageState>()(() => ({
    ...DOCUMENT_AT_FIRST,
    settings,
    ...PLAN_AT_FIRST,
    ...PLAYER_AT_FIRST,
    ...SERVER_AT_FIRST,
    ...UI_AT_FIRST,
    view,
  }));

export type PageStore = ReturnType<typeof createPageStore>;

/** The firmware of the current plotter's board; null: unknown, or its controller is not the machine's. */
export const boardFirmware = (state: PageState): string | null => {
  const machine = findMachine(state.settings);
  return machine && firmwareFor(machine, currentPlotter(state)?.firmware ?? null);
};

/** What Watch shows: the unfinished job, else the last one that had the plotter. */
export const watchedJob = (state: PageState): Job | null =>
  unfinishedJob(state) ?? state.jobs.find(({ id }) => id === state.watchedId) ?? null;

/** A watcher sees only Watch. */
export const shownView = (state: PageState): PageView => (maySubmit(state) ? state.pageView : "watch");

const WATCH_PANELS: readonly PanelName[] = ["queue", "plotter"];
const withoutPlotter = (panels: readonly PanelName[]): readonly PanelName[] =>
  panels.filter((name) => name !== "plotter");
/** By view: for devices that move the plotter, and for those that only add jobs. */
const VIEW_PANELS = {
  prepare: { all: PANELS, submit: withoutPlotter(PANELS) },
  watch: { all: WATCH_PANELS, submit: withoutPlotter(WATCH_PANELS) },
};

/** The panels of the shown view. Watch has those that a running plot needs. */
export const panelsOf = (state: PageState): readonly PanelName[] =>
  VIEW_PANELS[shownView(state)][onlySubmits(state) ? "submit" : "all"];

/** The panel beside the paper or the watched sheet; null: none is open. */
export const openPanel = (state: PageState): PanelName | null => {
  const name = shownView(state) === "watch" ? state.watchPanel : state.view.panel;
  return name !== null && panelsOf(state).includes(name) ? name : null;
};
