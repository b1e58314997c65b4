import { currentPlotter, type PageState } from "../../state/store.js";

/** This plotter has never plotted. */
export const isFirstPlot = (state: PageState): boolean => {
  const id = currentPlotter(state)?.id;
  const hasPlotted = state.jobs.some((job) => job.plotterId === id && job.startedAt !== null);
  return !state.view.hidesFirstPlot && state.link === "connected" && !hasPlotted;
};
