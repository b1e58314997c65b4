/** Keyboard shortcuts of the whole page. They are ignored while the user types into a field. */
import type { Player } from "../preview/player.js";
import { historyText, shortcutsText as words } from "./text.js";
import { plotText } from "../queue/text.js";
import type { Actions } from "../state/actions.js";
import { activeJob, shownView, type PageStore } from "../state/store.js";

export interface Shortcut {
  /** As shown in the help dialog. */
  readonly keys: string;
  readonly label: string;
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

/** Shortcuts that change the laid-out drawing are ignored in Watch, which does not show it. */
export const shortcutsFor = (deps: ShortcutDeps): readonly Shortcut[] => [
  ...prepareShortcuts(deps).map((shortcut) => ({
    ...shortcut,
    run: () => {
      if (shownView(deps.store.getState()) === "prepare") shortcut.run();
    },
  })),
  ...pageShortcuts(deps),
];

const prepareShortcuts = ({ store, actions, player }: ShortcutDeps): readonly Shortcut[] => [
  { keys: "Ctrl Z", label: historyText.undo, matches: withCtrl("z", false), run: actions.undo },
  { keys: "Ctrl Shift Z", label: historyText.redo, matches: withCtrl("z", true), run: actions.redo },
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
  { keys: "Q", label: plotText.addToQueue, matches: plain("q"), run: () => void actions.queueDrawing() },
];

const pageShortcuts = ({ store, actions }: ShortcutDeps): readonly Shortcut[] => [
  {
    keys: "P",
    label: words.pause,
    matches: plain("p"),
    run: () => {
      const job = activeJob(store.getState());
      if (job) void actions.actOnJob(job.id, job.state === "paused" ? "resume" : "pause");
    },
  },
  {
    keys: "?",
    label: words.title,
    matches: (event) => event.key === "?",
    run: () => store.setState(({ openDialog }) => ({ openDialog: openDialog === "keys" ? null : "keys" })),
  },
];

export const listenForShortcuts = (shortcuts: readonly Shortcut[]): void =>
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || isTyping(event.target)) return;
    const shortcut = shortcuts.find(({ matches }) => matches(event));
    if (!shortcut) return;
    event.preventDefault();
    shortcut.run();
  });

/** Fields handle their own keys, and a focused button handles Space. */
const isTyping = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement &&
  (target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT", "BUTTON"].includes(target.tagName));
