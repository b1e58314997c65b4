/** What the page shows: its views, panels, dialogs and messages to the user. */
import type { PanelName, ViewSettings } from "./persist.js";
import { shownView, type DialogName, type PageNotice, type PageStore, type PageView } from "./store.js";

const INFO_MS = 5_000;
const MAX_NOTICES = 4;

export const createUiActions = (store: PageStore, after: (delayMs: number, callback: () => void) => void) => {
  let nextId = 1;
  const dismiss = (id: number): void =>
    store.setState(({ notices }) => ({ notices: notices.filter((notice) => notice.id !== id) }));
  return {
    /** Errors stay until they are closed or an action succeeds. */
    notify: (kind: PageNotice["kind"], text: string): void => {
      const notice = { id: nextId++, kind, text };
      store.setState(({ notices }) => ({
        notices: [...notices.filter((other) => other.text !== text), notice].slice(-MAX_NOTICES),
      }));
      if (kind === "info") after(INFO_MS, () => dismiss(notice.id));
    },
    dismiss,
    /** A successful action makes earlier error messages obsolete. */
    clearErrors: (): void =>
      store.setState(({ notices }) => ({ notices: notices.filter(({ kind }) => kind !== "error") })),
    changeView: (change: Partial<ViewSettings>): void =>
      store.setState(({ view }) => ({ view: { ...view, ...change } })),
    showView: (pageView: PageView): void => store.setState({ pageView, isFullScreen: false }),
    /** Null closes the open panel. */
    showPanel: (panel: PanelName | null): void =>
      store.setState((state) =>
        shownView(state) === "watch" ? { watchPanel: panel } : { view: { ...state.view, panel } },
      ),
    openDialog: (name: DialogName): void => store.setState({ openDialog: name }),
    /** Another open dialog stays: the user may have typed into it. */
    toggleDialog: (name: DialogName): void =>
      store.setState(({ openDialog, takeOverQuestion }) => {
        if (takeOverQuestion !== null || (openDialog !== null && openDialog !== name)) return {};
        return { openDialog: openDialog === null ? name : null };
      }),
    closeDialog: (): void => store.setState({ openDialog: null }),
  };
};
