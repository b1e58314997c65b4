/** Opens the panel of a field and gives the field the focus. */
import type { Page } from "../state/page-action.js";
import { NO_LEGEND, type Field, type FieldLocation } from "./fields.js";

/** A panel that is opened for the first time may be loaded first. */
const WAIT_MS = 10_000;
const SHOWN_MS = 2_000;

/** Opens its panel, or the panel of the control that makes it appear. */
export function goToField({ store, actions }: Page, field: Field): void {
  const state = store.getState();
  const place = field.instead?.(state) ?? field.place;
  const { name, groups } = place.panel;
  const { openGroups } = state.view;
  actions.showView("prepare");
  actions.showPanel(name);
  actions.changeView({ openGroups: [...openGroups, ...groups.filter((id) => !openGroups.includes(id))] });
  const endMs = performance.now() + WAIT_MS;
  const before = document.activeElement;
  const look = (): void => {
    const now = document.activeElement;
    // Meanwhile the user has gone elsewhere. With the panel before, its focus is gone.
    if (now !== before && now !== document.body) return;
    const control = controlAt(place);
    if (control) show(control);
    else if (performance.now() < endMs) requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

function show(control: HTMLElement): void {
  const field = control.closest(".field, .switch, fieldset, .group-top") ?? control;
  field.scrollIntoView({ block: "center" });
  control.focus({ preventScroll: true });
  if (control instanceof HTMLInputElement && control.type === "text") control.select();
  const marked = { backgroundColor: "var(--accent-soft)", boxShadow: "0 0 0 6px var(--accent-soft)" };
  field.animate([marked, {}], { duration: SHOWN_MS, easing: "ease-out" });
}

const textOf = (element: Element | null | undefined): string => element?.textContent.trim() ?? "";

function controlAt({ panel: { groups }, control, legend }: FieldLocation): HTMLElement | null {
  const id = groups.at(-1);
  const root =
    id === undefined ? document.querySelector(".pen-at-hand") : document.getElementById(`group-${id}`);
  if (!root) return null;
  if (control === null)
    return root.parentElement?.querySelector<HTMLElement>(".group-head, .panel-title") ?? null;
  // The label of a field or switch, the name of a row of choices, or the legend around one.
  for (const named of root.querySelectorAll<HTMLElement>("label, legend, .segments-field [id$='-label']")) {
    if (textOf(named) !== control || named.offsetParent === null) continue;
    const around = textOf(named.closest("fieldset")?.querySelector("legend"));
    if (legend !== undefined && around !== (legend === NO_LEGEND ? "" : legend)) continue;
    const found =
      named instanceof HTMLLabelElement ? named.control : choiceIn(named.closest("fieldset, [role=group]"));
    if (found) return found;
  }
  return null;
}

/** Of radio buttons, the chosen one. */
const choiceIn = (group: Element | null): HTMLElement | null =>
  group?.querySelector<HTMLElement>("input:checked:enabled") ??
  group?.querySelector<HTMLElement>("input:enabled") ??
  null;
