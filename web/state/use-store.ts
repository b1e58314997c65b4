/** React's access to the page: one context with the store and the actions, created in app/open-page.ts. */
import { createContext, useContext } from "react";
import { useStore } from "zustand";
import type { Job } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import type { Actions } from "./actions.js";
import type { Page } from "./page-action.js";
import { currentPlotter, type PageState, type PageStore } from "./store.js";

export const PageContext = createContext<Page | null>(null);

export const usePage = (): Page => {
  const page = useContext(PageContext);
  if (!page) throw new Error("a panel is used outside of <PageContext>");
  return page;
};

/** Re-renders only when the result of `select` has changed (compared by identity). */
export const usePageState = <T>(select: (state: PageState) => T): T => useStore(usePage().store, select);
export const useActions = (): Actions => usePage().actions;
export const useBackend = (): Backend => usePage().backend;
export const usePageStore = (): PageStore => usePage().store;

/** Without a connection the page shows the last known state, and its requests do not arrive. */
export const useIsConnected = (): boolean => usePageState((state) => state.link === "connected");

/** The plotter whose jobs the page lists; "": the jobs of all plotters, because there is only one. */
export const useListedPlotter = (): string =>
  usePageState((state) => (state.plotters.length > 1 ? (currentPlotter(state)?.id ?? "") : ""));

/** The current plotter's jobs: the queue in its order, then the history, newest first. */
export const usePlotterJobs = (): readonly Job[] => {
  const jobs = usePageState((state) => state.jobs);
  const plotterId = useListedPlotter();
  return plotterId === "" ? jobs : jobs.filter((job) => job.plotterId === plotterId);
};
