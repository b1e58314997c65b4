/** Whether the drawing is on the paper, and within the machine's reach. */
import { findMachine, isEmptyBox, isReached } from "../../src/internal.js";
import type { PageState } from "../state/store.js";

/** Whether a part of the drawing is out of the machine's reach. */
export const isOutOfReach = ({ planned, settings }: PageState): boolean => {
  const machine = findMachine(settings);
  return (
    machine !== null &&
    planned !== null &&
    !isEmptyBox(planned.drawnBox) &&
    !isReached(planned.drawnBox, machine)
  );
};

/** A part of the drawing is outside the paper, also if the user allowed that. */
export const isOutsidePaper = ({ planned }: PageState): boolean => Boolean(planned?.outside);

/** A part of the drawing is outside the paper, and the user has not chosen what happens to it. */
export const isOutsideUnanswered = ({ planned, settings }: PageState): boolean =>
  Boolean(planned?.outside) && settings.prepare.outside !== "allow";
