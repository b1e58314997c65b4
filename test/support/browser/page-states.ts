/** Every visible state of the page, and how a user gets there: for screenshots and accessibility checks. */
import { DRAWING_STATES } from "./page-states/drawing-states.js";
import type { PageState } from "./page-states/page-state.js";
import { PLOT_STATES } from "./page-states/plot-states.js";
import { PLOTTER_STATES } from "./page-states/plotter-states.js";
import { SHARING_STATES } from "./page-states/sharing-states.js";

/** In the order of their numbers: those that share a page begin with the first visit. */
export const PAGE_STATES: readonly PageState[] = [
  ...DRAWING_STATES,
  ...PLOT_STATES,
  ...PLOTTER_STATES,
  ...SHARING_STATES,
].sort((one, other) => one.name.localeCompare(other.name));
