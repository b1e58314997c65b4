/** Keyboard shortcuts of the whole page. They are ignored while the user types into a field. */
import type { Player } from "../preview/player.js";
import { historyText, shortcutsText as words } from "./text.js";
import { canQueue } from "../queue/can-queue.js";
import { isMainActionOff, mainActionOf } from "../queue/main-action.js";
import { plotText } from "../queue/text.js";
import type { Actions } from "../state/actions.js";
import { activeJob, shownView, type PageStore } from "../state/store.js";

export interface Shortcut {
  /** As shown in the help dialog. */
  readonly keys: string;
  readonly label: string;
  /** Runs again and again while the key is held. */
  readonly repeats?: true;
  matches(event: KeyPress): boolean;
  run(): void;
}

type KeyPress = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

const plain =
  (key: string) =>
  (event: KeyPress): boolean =>
    event.key.toLowerCase() === key && !event.ctrlKey && !event.metaKey && !event.altKey;
const withCtrl =
  (key: string, shift: boolean) =>
  (event: KeyPress): boolean =>
    event.key.toLowerCase() === key && (event.ctrlKey || event.metaKey) && event.shiftKey === shift;

interface ShortcutDeps {
  readonly store: PageStore;
  readonly actions: Actions;
  readonly player: Pick<Player, "toggle">;
}

/** Shortcuts for the laid-out drawing are ignored where it can't be seen: in Watch, and under a dialog. */
export const shortcutsFor = (deps: ShortcutDeps): readonly Shortcut[] => [
  ...prepareShortcuts(deps).map((shortcut) => ({
    ...shortcut,
    run: () => {
      const state = deps.store.getState();
      const isCovered = state.openDialog !== null || state.takeOverQuestion !== null;
      if (shownView(state) === "prepare" && !isCovered) shortcut.run();
    },
  })),
  ...pageShortcuts(deps),
];

const prepareShortcuts = ({ store, actions, player }: ShortcutDeps): readonly Shortcut[] => [
  {
    keys: "Ctrl Z",
    label: historyText.undo,
    repeats: true,
    matches: withCtrl("z", false),
    run: actions.undo,
  },
  {
    keys: "Ctrl Shift Z",
    label: historyText.redo,
    repeats: true,
    matches: withCtrl("z", true),
    run: actions.redo,
  },
  { keys: "Space", label: words.play, matches: plain(" "), run: () => player.toggle() },
  {
    keys: "T",
    label: words.travel,
    matches: plain("t"),
    run: () => actions.changeView({ showTravel: !store.getState().view.showTravel }),
  },
  {
    keys: "G",
    label: words.graph,
    matches: plain("g"),
    run: () => actions.changeView({ showGraph: !store.getState().view.showGraph }),
  },
  {
    keys: "Q",
    label: plotText.addToQueue,
    matches: plain("q"),
    run: () => {
      if (canQueue(store.getState())) void actions.queueDrawing();
    },
  },
];

const pageShortcuts = ({ store, actions }: ShortcutDeps): readonly Shortcut[] => [
  {
    keys: "P",
    label: words.pause,
    matches: plain("p"),
    run: () => {
      const state = store.getState();
      const job = activeJob(state);
      const action = job && mainActionOf(state, job);
      if (action && !isMainActionOff(state, job, action)) void actions.actOnJob(job.id, action);
    },
  },
  {
    keys: "?",
    label: words.title,
    matches: (event) => event.key === "?",
    run: () => {
      const { openDialog } = store.getState();
      // Another dialog stays: the user may have typed into it.
      if (openDialog === null) store.setState({ openDialog: "keys" });
      else if (openDialog === "keys") store.setState({ openDialog: null });
    },
  },
];

export const listenForShortcuts = (shortcuts: readonly Shortcut[]): void =>
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || isForControl(event)) return;
    const shortcut = shortcuts.find(({ matches }) => matches(event));
    if (!shortcut) return;
    event.preventDefault();
    // Holding P must not pause the plot and then resume it.
    if (!event.repeat || shortcut.repeats) shortcut.run();
  });

/** Inputs that take no text. */
const PRESSED_INPUTS: readonly string[] = ["checkbox", "radio", "range", "color", "file"];

/** Text fields and lists handle every key. Of the shortcuts, buttons, switches and sliders handle only Space. */
const isForControl = ({ target, key }: KeyboardEvent): boolean => {
  if (!(target instanceof HTMLElement)) return false;
  const isPressed =
    target.tagName === "BUTTON" ||
    target.tagName === "SUMMARY" ||
    (target instanceof HTMLInputElement && PRESSED_INPUTS.includes(target.type));
  if (isPressed) return key === " ";
  return target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(target.tagName);
};
