/** Keyboard shortcuts of the whole page: the keys of its actions. */
import { isPressed, performByKey, type Page, type PageAction } from "../state/page-action.js";
import { PAGE_ACTIONS } from "./page-actions.js";

export const ACTIONS_WITH_KEYS = PAGE_ACTIONS.filter(({ key }) => key !== undefined);

export const listenForShortcuts = (page: Page): void =>
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented) return;
    const action = ACTIONS_WITH_KEYS.find((one) => isPressed(one, event));
    if (!action || isForControl(event, action)) return;
    event.preventDefault();
    // Holding P must not pause the plot and then resume it.
    if (!event.repeat || action.repeats) performByKey(action, page);
  });

/** Inputs that take no text. */
const PRESSED_INPUTS: readonly string[] = ["checkbox", "radio", "range", "color", "file"];

/** Text fields and lists handle almost every key. Of the shortcuts, buttons, switches and sliders handle only Space. */
const isForControl = ({ target, key }: KeyboardEvent, { worksInFields }: PageAction): boolean => {
  if (worksInFields || !(target instanceof HTMLElement)) return false;
  const isPressedBySpace =
    target.tagName === "BUTTON" ||
    target.tagName === "SUMMARY" ||
    (target instanceof HTMLInputElement && PRESSED_INPUTS.includes(target.type));
  if (isPressedBySpace) return key === " ";
  return target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(target.tagName);
};
