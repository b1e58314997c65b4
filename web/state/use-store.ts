/** React's view of the page: one context with the store and the actions, made in main.tsx. */
import { createContext, useContext } from "react";
import { useStore } from "zustand";
import type { Actions } from "./actions.js";
import type { PageState, PageStore } from "./store.js";

export interface Page {
  readonly store: PageStore;
  readonly actions: Actions;
}

export const PageContext = createContext<Page | null>(null);

const usePage = (): Page => {
  const page = useContext(PageContext);
  if (!page) throw new Error("a panel stands outside of <App>");
  return page;
};

/** Re-renders only when what `select` picks has changed (compared by identity). */
export const usePageState = <T>(select: (state: PageState) => T): T => useStore(usePage().store, select);
export const useActions = (): Actions => usePage().actions;
export const usePageStore = (): PageStore => usePage().store;
