/** Watch opens by itself when a plot starts, and when the page is opened while one is under way. */
import { unfinishedJob, type PageStore } from "./store.js";

/** Returns a function that stops. */
export const openWatch = (store: PageStore): (() => void) =>
  store.subscribe((state, before) => {
    if (state.jobs === before.jobs && state.plotterId === before.plotterId) return;
    const job = unfinishedJob(state);
    if (!job || job.id === unfinishedJob(before)?.id || state.sideJobIds.includes(job.id)) return;
    store.setState({ pageView: "watch", watchedId: job.id });
  });
