/** Whether the drawing can be put in the queue, for the buttons of Plot and for the keyboard. */
import { isOutOfReach } from "../drawing/out-of-reach.js";
import { isOutsideUnanswered } from "../drawing/outside-paper.js";
import { mayOperate, type PageState } from "../state/store.js";

/** A drawing or its settings are being sent. */
export const isSendingJob = ({ busyAction }: PageState): boolean =>
  busyAction === "add" || busyAction === "plot" || busyAction === "save";

export const canQueue = (state: PageState): boolean =>
  state.drawing !== null &&
  (state.planned?.strokeCount ?? 0) > 0 &&
  state.fault === null &&
  state.link === "connected" &&
  state.plotters.length > 0 &&
  mayOperate(state) &&
  !isOutOfReach(state) &&
  !isOutsideUnanswered(state) &&
  !isSendingJob(state);
