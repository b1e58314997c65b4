/** Opens Watch when a plot starts, and when the page is opened during one. */
import { unfinishedJob, type PageStore } from "./store.js";

export const openWatch = (store: PageStore): void => {
  store.subscribe((state, before) => {
    if (state.jobs === before.jobs && state.plotterId === before.plotterId) return;
    const job = unfinishedJob(state);
    if (!job || job.id === unfinishedJob(before)?.id || state.utilityJobIds.includes(job.id)) return;
    store.setState({ pageView: "watch", watchedId: job.id });
  });
};
