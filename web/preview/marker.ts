/** Where the plotter's pen is on the paper. */
import { currentPlotter, type PageState } from "../state/store.js";
import type { Marker } from "./overlay.js";

/** Null: unknown. */
export const plotterMarker = (state: PageState): Marker | null => {
  const plotter = currentPlotter(state);
  if (state.link !== "connected" || !plotter) return null;
  const { xMm, yMm, penUp, penMoving } = plotter;
  return xMm === null || yMm === null ? null : { xMm, yMm, penDown: penUp === false && !penMoving };
};
