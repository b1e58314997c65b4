/** The page's own messages to the user. Errors stay until they are closed or an action succeeds. */
import type { Notice, PageStore } from "./store.js";

const INFO_MS = 5_000;
const MAX_NOTICES = 4;

export const createNotices = (store: PageStore, after: (delayMs: number, callback: () => void) => void) => {
  let nextId = 1;
  const dismiss = (id: number): void =>
    store.setState(({ notices }) => ({ notices: notices.filter((notice) => notice.id !== id) }));
  return {
    notify: (kind: Notice["kind"], text: string): void => {
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
  };
};
