/**
 * Something that the user can do on the page, as a record. Its button, its shortcut, the list of shortcuts and the search
 * read the same record.
 */
import type { Backend } from "../backend/backend.js";
import type { Actions } from "./actions.js";
import { mayOperate, maySubmit, shownView, type PageState, type PageStore } from "./store.js";

/** What an action and a component of the page can use. */
export interface Page {
  readonly store: PageStore;
  readonly backend: Backend;
  readonly actions: Actions;
}

export interface PageAction {
  readonly id: string;
  readonly label: string | ((state: PageState) => string);
  /** Other words that people use for it, by phrases: "rotate, quarter turn". For the search. */
  readonly words?: string;
  /** As shown in the list of shortcuts: "Ctrl Shift Z", "Space", "P". */
  readonly key?: string;
  /** Runs again and again while the key is held. */
  readonly repeats?: true;
  /** The key works while the user types into a field, too. */
  readonly worksInFields?: true;
  /** Concerns the laid-out drawing, so its key is ignored where that can't be seen: in Watch, and under a dialog. */
  readonly isForDrawing?: true;
  /** Whether this page has it at all; left out: always. */
  isOffered?(page: Page): boolean;
  /** Why it can't be performed now; null: it can. Left out: it always can. */
  whyOff?(state: PageState): string | null;
  perform(page: Page): void;
}

export const labelOf = ({ label }: PageAction, state: PageState): string =>
  typeof label === "string" ? label : label(state);
export const whyOff = (action: PageAction, state: PageState): string | null => action.whyOff?.(state) ?? null;
export const isEnabled = (action: PageAction, state: PageState): boolean => whyOff(action, state) === null;
export const isOffered = (action: PageAction, page: Page): boolean => action.isOffered?.(page) ?? true;

/** For actions on the drawing and the own jobs, which a watcher does not have. */
export const isForSubmitter = ({ store }: Page): boolean => maySubmit(store.getState());

/** For actions on the plotter, and on the jobs of all. */
export const isForOperator = ({ store }: Page): boolean => mayOperate(store.getState());

type KeyPress = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

/**
 * "?" is on different keys and levels of keyboards, so Shift counts only beside Ctrl. Keyboards of Macs and tablets have
 * Backspace in place of Delete.
 */
export const isPressed = ({ key = "" }: PageAction, event: KeyPress): boolean => {
  const held = key.split(" ");
  const last = held.pop();
  const pressed = event.key === "Backspace" ? "delete" : event.key.toLowerCase();
  if (pressed !== (last === "Space" ? " " : last?.toLowerCase())) return false;
  if (!held.includes("Ctrl")) return !event.ctrlKey && !event.metaKey && (!event.altKey || last === "?");
  return (event.ctrlKey || event.metaKey) && event.shiftKey === held.includes("Shift");
};

/** Does nothing if the action is off, or concerns a drawing that can't be seen. */
export const performByKey = (action: PageAction, page: Page): void => {
  const state = page.store.getState();
  const isCovered = state.openDialog !== null || state.takeOverQuestion !== null;
  if (action.isForDrawing && (shownView(state) !== "prepare" || isCovered)) return;
  if (isOffered(action, page) && isEnabled(action, state)) action.perform(page);
};
